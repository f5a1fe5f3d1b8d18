#include "base/lab_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>
#include <fstream>
#include <optional>

#include "base/shown_text.hpp"

namespace freestand {
namespace {

using Cells = std::vector<std::string>;

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Blanks: runs of them count as one.
Cells cells_of(const std::string& line, char separator) {
  Cells cells;
  std::string cell;
  const auto end_cell = [&] {
    if (separator != ' ' || !without_blanks(cell).empty()) cells.push_back(without_blanks(cell));
    cell.clear();
  };
  for (const char c : line) {
    const bool ends = separator == ' ' ? c == ' ' || c == '\t' || c == '\r' : c == separator;
    if (ends)
      end_cell();
    else
      cell += c;
  }
  end_cell();
  // A separator at the end of every line makes no column.
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

std::optional<double> number(std::string cell, bool decimal_comma) {
  if (decimal_comma) std::replace(cell.begin(), cell.end(), ',', '.');
  if (cell.starts_with('+')) cell.erase(0, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || cell.empty()) return {};
  return value;
}

bool all_numbers(const Cells& cells, bool decimal_comma) {
  return !cells.empty() && std::all_of(cells.begin(), cells.end(), [&](const std::string& cell) {
    return number(cell, decimal_comma).has_value();
  });
}

struct Way {
  char separator;
  bool decimal_comma;
};
// The first that makes numbers of a line wins: "1,5;2,5" is no line of commas, and "1,5 2,5" none either.
constexpr Way ways[] = {{';', true}, {'\t', true}, {',', false}, {' ', true}};

}  // namespace

std::size_t LabTable::column(const std::string& name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

LabTable read_lab_table(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw Error(file.string() + " cannot be read (no such file, or no permission): check the path", Exit::data);
  LabTable table;
  table.file = file;
  std::optional<Way> way;
  std::string line, before, above;  // the last lines of words
  for (int number_of_line = 1; std::getline(stream, line); ++number_of_line) {
    if (number_of_line == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (line.find('\0') != std::string::npos)
      throw Error(file.string() + " is no text (it holds bytes that are none): export the table as text", Exit::data);
    if (without_blanks(line).empty()) continue;
    for (const Way& w : ways) {
      if (way) break;
      const Cells cells = cells_of(line, w.separator);
      if (cells.size() < 2 || !all_numbers(cells, w.decimal_comma)) continue;
      way = w;
      // The names stand right above, or with a line of units between.
      Cells names = cells_of(above, w.separator);
      if (names.size() == cells.size())
        table.units = cells_of(before, w.separator);
      else
        names = cells_of(before, w.separator);
      if (names.size() != cells.size()) {
        names.clear();
        for (std::size_t i = 0; i < cells.size(); ++i) names.push_back(std::to_string(i + 1));
      }
      if (table.units.size() != names.size()) table.units.clear();
      table.columns = names;
      table.values.resize(cells.size());
    }
    if (!way) {
      above = before;
      before = line;
      continue;
    }
    const Cells cells = cells_of(line, way->separator);
    const std::string place = file.string() + ":" + std::to_string(number_of_line) + ": ";
    if (cells.size() != table.columns.size())
      throw Error(place + std::to_string(cells.size()) + " cells where the table has " +
                      std::to_string(table.columns.size()) + " columns: complete or remove the line",
                  Exit::data);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number(cells[i], way->decimal_comma);
      if (!value || !std::isfinite(*value))
        throw Error(place + shown(cells[i]) + " in column " + shown(table.columns[i]) +
                        " is no finite number: correct it, or cut the file there",
                    Exit::data);
      table.values[i].push_back(*value);
    }
    table.lines.push_back(number_of_line);
  }
  if (!way) throw Error(file.string() + " holds no table of numbers: export it as text with columns", Exit::data);
  return table;
}

}  // namespace freestand
