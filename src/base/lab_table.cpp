#include "base/lab_table.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "base/shown_text.hpp"

namespace freestand {
namespace {

using Cells = std::vector<std::string>;

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Blanks: runs of them count as one. What stands in quotes is one cell.
Cells cells_of(const std::string& line, char separator) {
  Cells cells;
  std::string cell;
  bool quoted = false;
  const auto end_cell = [&] {
    if (separator != ' ' || !without_blanks(cell).empty()) cells.push_back(without_blanks(cell));
    cell.clear();
  };
  for (const char c : line) {
    if (c == '"' && (quoted || without_blanks(cell).empty())) quoted = !quoted;
    const bool ends = !quoted && (separator == ' ' ? c == ' ' || c == '\t' || c == '\r' : c == separator);
    if (ends)
      end_cell();
    else
      cell += c;
  }
  end_cell();
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

struct Way {
  char separator;
  bool decimal_comma;
};
// The first that makes numbers of a line wins: "1,5;2,5" is no line of commas, and "1,5 2,5" none either.
constexpr Way ways[] = {{';', true}, {'\t', true}, {',', false}, {' ', true}};

// Which cells of a line are numbers.
std::vector<bool> numbers_in(const Cells& cells, bool decimal_comma) {
  std::vector<bool> found;
  for (const std::string& cell : cells) found.push_back(number(cell, decimal_comma).has_value());
  return found;
}

// "(mm)", "[m/s^2]", "s", or nothing: of a line of units, not of names.
bool is_unit(const std::string& cell) {
  if (cell.empty() || cell == "-" || (cell.front() == '(' && cell.back() == ')') ||
      (cell.front() == '[' && cell.back() == ']'))
    return true;
  constexpr std::string_view units[] = {
      "s",     "sec",    "ms",  "us",  "min",  "hz",  "g",      "mg",      "gal",  "m",     "mm",    "cm",
      "um",    "in",     "ft",  "rad", "mrad", "deg", "degree", "degrees", "m/s2", "m/s^2", "cm/s2", "cm/s^2",
      "mm/s2", "mm/s^2", "m/s", "v",   "mv",   "c",   "kg",     "n",       "kn",   "%",     "1"};
  std::string lower;
  for (const char c : cell) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::find(units, lower) != std::end(units);
}

struct Line {
  int number;
  std::string text;
};

std::vector<Line> lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw Error(file.string() + " cannot be read (no such file, or no permission): check the path", Exit::data);
  std::vector<Line> lines;
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    if (text.find('\0') != std::string::npos)
      throw Error(file.string() + " is no text (it holds bytes that are none): export the table as text", Exit::data);
    if (!without_blanks(text).empty()) lines.push_back({number, std::move(text)});
  }
  return lines;
}

struct Beginning {
  std::size_t line;  // the first of the numbers
  Way way;
};

// A line begins the table if it and the next one have as many cells, two and more of which are numbers in both, or one in the first and two in
// the next: names, units and titles hold none where numbers stand below, and a first row may lack some.
std::optional<Beginning> beginning_of(const std::vector<Line>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const Way& way : ways) {
      const Cells here = cells_of(lines[i].text, way.separator);
      if (here.size() < 2) continue;
      const std::vector<bool> numbers = numbers_in(here, way.decimal_comma);
      const auto count = std::ranges::count(numbers, true);
      if (count == static_cast<long>(here.size())) return Beginning{i, way};
      if (count == 0 || i + 1 == lines.size()) continue;
      const Cells next = cells_of(lines[i + 1].text, way.separator);
      if (next.size() != here.size()) continue;
      const std::vector<bool> below = numbers_in(next, way.decimal_comma);
      bool within = std::ranges::count(below, true) >= 2;
      for (std::size_t k = 0; k < here.size(); ++k) within = within && (!numbers[k] || below[k]);
      if (within) return Beginning{i, way};
    }
  return {};
}

}  // namespace

std::size_t LabTable::column(const std::string& name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

LabTable read_lab_table(const std::filesystem::path& file) {
  const std::vector<Line> lines = lines_of(file);
  const std::optional<Beginning> begins = beginning_of(lines);
  if (!begins) throw Error(file.string() + " holds no table of numbers: export it as text with columns", Exit::data);
  const auto& [first, way] = *begins;
  LabTable table;
  table.file = file;
  const auto cells_at = [&, &at = first](std::size_t above) {
    return above <= at ? cells_of(lines[at - above].text, way.separator) : Cells{};
  };
  // A separator at the end of every line makes no column.
  std::size_t count = cells_at(0).size();
  bool none_behind = true;
  for (std::size_t i = first; i < lines.size() && none_behind; ++i) {
    const Cells cells = cells_of(lines[i].text, way.separator);
    none_behind = cells.size() < count || cells[count - 1].empty();
  }
  Cells names = cells_at(1), units;
  const bool named_behind = names.size() == count && !names.back().empty();
  if (none_behind && count > 1 && !named_behind) --count;
  const auto cut = [&](Cells& cells) {
    if (cells.size() == count + 1 && cells.back().empty()) cells.pop_back();
  };
  cut(names);
  // The names stand right above, or with a line of units between.
  const auto units_in = 2 * std::ranges::count_if(names, is_unit);
  if (Cells above = cells_at(2); names.size() == count && units_in > static_cast<long>(count)) {
    cut(above);
    if (above.size() == count) units = std::exchange(names, above);
  }
  if (names.size() != count) {
    names.clear();
    for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i + 1));
  }
  table.columns = names;
  table.units = units;
  table.values.resize(count);
  table.flaws.resize(count);
  for (std::size_t i = first; i < lines.size(); ++i) {
    Cells cells = cells_of(lines[i].text, way.separator);
    cut(cells);
    const std::string place = file.string() + ":" + std::to_string(lines[i].number) + ": ";
    if (cells.size() != count)
      throw Error(place + std::to_string(cells.size()) + " cells where the table has " + std::to_string(count) +
                      " columns: complete or remove the line",
                  Exit::data);
    for (std::size_t k = 0; k < count; ++k) {
      const auto value = number(cells[k], way.decimal_comma);
      const bool known = value && std::isfinite(*value);
      if (!known && table.flaws[k].empty())
        table.flaws[k] = place + shown(cells[k]) + " in column " + shown(table.columns[k]) +
                         " is no finite number: correct it, or cut the file there";
      if (known && table.with_comma.empty() && cells[k].find(',') != std::string::npos) table.with_comma = cells[k];
      table.values[k].push_back(known ? *value : std::numeric_limits<double>::quiet_NaN());
    }
    table.lines.push_back(lines[i].number);
  }
  return table;
}

}  // namespace freestand
