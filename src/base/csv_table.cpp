#include "base/csv_table.hpp"

#include <algorithm>
#include <freestand/error.hpp>
#include <fstream>

#include "base/folder.hpp"
#include "base/shown_text.hpp"

namespace freestand {
namespace {

std::string trimmed(std::string text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

bool says_nothing(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r,");
  return first == std::string::npos || line[first] == '#';
}

// Lines that say something; -1 for the number where there are no more.
int next_line(std::ifstream& stream, int line, std::string& text) {
  while (std::getline(stream, text)) {
    ++line;
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    if (!says_nothing(text)) return line;
  }
  return -1;
}

bool semicolons(const std::vector<std::string>& columns) {
  return columns.size() == 1 && columns.front().find(';') != std::string::npos;
}

std::string wrong_header(const std::vector<std::string>& columns) {
  if (semicolons(columns))
    return "cells are parted by semicolons (commas part them here, and decimals have points): replace them";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].empty())
      return "column " + std::to_string(i + 1) + " has no name (every column says what it holds): name it";
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i), columns[i]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(i))
      return "column " + shown(columns[i]) + " stands twice (which one counts?): remove one";
  }
  return "";
}

}  // namespace

std::optional<std::vector<std::string>> csv_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false, was_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"' && (quoted || trimmed(cells.back()).empty())) {
      if (!quoted) cells.back().clear();  // blanks before it
      quoted = !quoted;
      was_quoted = true;
    } else if (c == ',' && !quoted) {
      if (!was_quoted) cells.back() = trimmed(cells.back());
      cells.emplace_back();
      was_quoted = false;
    } else if (!(was_quoted && !quoted)) {  // what stands behind a closing quote is blank
      cells.back() += c;
    }
  }
  if (!was_quoted) cells.back() = trimmed(cells.back());
  return quoted ? std::nullopt : std::optional(cells);
}

std::size_t CsvTable::column(const std::string& name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

std::string CsvTable::at(const Row& row) const { return file.string() + ":" + std::to_string(row.line) + ": "; }

std::vector<std::string> csv_columns(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(16384, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.find('\0') != std::string::npos) return {};
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (!says_nothing(line)) return csv_cells(line).value_or(std::vector<std::string>{});
    begin = end + 1;
  }
  return {};
}

CsvTable read_csv_table(const std::filesystem::path& file) {
  std::ifstream stream = open_to_read(file, Exit::data);
  CsvTable table{file, {}, {}};
  std::string text, problems;
  const auto wrong = [&](int line, const std::string& what) {
    if (!problems.empty()) problems += '\n';
    problems.append(table.at({line, {}})).append(what);
  };
  for (int line = next_line(stream, 0, text); line > 0; line = next_line(stream, line, text)) {
    const auto cells = csv_cells(text);
    if (text.find('\0') != std::string::npos)
      throw Error(table.at({line, {}}) + "no text but a binary file (it holds a zero byte): give the table as csv",
                  Exit::data);
    if (!cells) {
      wrong(line, "a quote does not end on its line (where does the cell end?): close it");
    } else if (table.columns.empty()) {
      table.columns = *cells;
      if (const std::string why = wrong_header(*cells); !why.empty()) wrong(line, why);
      if (semicolons(*cells)) break;  // every row would be wrong by the same
    } else if (cells->size() != table.columns.size()) {
      wrong(line, std::to_string(cells->size()) + " cells (the header has " + std::to_string(table.columns.size()) +
                      "): correct the line; what holds a comma stands in quotes");
    } else {
      table.rows.push_back({line, *cells});
    }
  }
  if (!problems.empty()) throw Error(problems, Exit::data);
  if (table.rows.empty())
    throw Error(file.string() + " has no rows (a table has a header and rows): fill it", Exit::data);
  return table;
}

}  // namespace freestand
