#include "base/lab_table.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include "base/folder.hpp"
#include "base/shown_text.hpp"

namespace freestand {
namespace {

using Cells = std::vector<std::string>;

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Blanks: runs of them count as one. What stands in quotes is one cell. Behind a separator at the end stands an empty one.
Cells cells_of(const std::string& line, char separator) {
  Cells cells;
  std::string cell;
  bool quoted = false;
  const auto end_cell = [&] {
    if (separator != ' ' || !without_blanks(cell).empty()) cells.push_back(without_blanks(cell));
    cell.clear();
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && (quoted || (without_blanks(cell).empty() && line.find('"', i + 1) != std::string::npos)))
      quoted = !quoted;
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

// What stands for a number that is not there: "", "--", "NaN".
bool is_mark(std::string cell) {
  for (char& c : cell) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return cell == "nan" || cell == "inf" || cell == "-inf" || cell == "null" || cell == "na" || cell == "n/a" ||
         std::ranges::none_of(cell, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80); });
}

struct Line {
  int number;
  std::string text;
};

std::vector<Line> lines_of(const std::filesystem::path& file) {
  std::ifstream stream = open_to_read(file, Exit::data);
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

// Of this line and those behind it, as far as they are looked at.
struct Usual {
  bool as_many = false;       // at least half have as many cells as it, but for an empty one at the end
  bool none_behind = false;   // the last cell of all that have as many is empty
  std::vector<bool> numbers;  // which of its cells are numbers in at least half

  Usual(const std::vector<Line>& lines, std::size_t from, const Way& way) {
    constexpr std::size_t looked_at = 12;
    const std::size_t end = std::min(lines.size(), from + looked_at);
    std::vector<Cells> all;
    for (std::size_t i = from; i < end; ++i) all.push_back(cells_of(lines[i].text, way.separator));
    const std::size_t count = all.front().size();
    const auto in_half = [&](const auto& is) {
      return 2 * static_cast<std::size_t>(std::ranges::count_if(all, is)) >= all.size();
    };
    as_many = in_half([&](const Cells& cells) {
      return cells.size() == count || (cells.size() == count + 1 && cells.back().empty()) ||
             (cells.size() + 1 == count && all.front().back().empty());
    });
    none_behind = std::ranges::all_of(all, [&](const Cells& c) { return c.size() != count || c.back().empty(); });
    for (std::size_t k = 0; k < count; ++k)
      numbers.push_back(
          in_half([&](const Cells& cells) { return k < cells.size() && number(cells[k], way.decimal_comma); }));
  }
};

struct Beginning {
  std::size_t line;  // the first of the numbers
  Way way;
  Usual usual;
};

// Does the line begin the table? Most of the lines behind it have numbers in two columns and more, and it has numbers, or marks in their place,
// there. Names, units and titles have words; so may it, if two of its cells are such numbers and the line above, as long, has none.
std::optional<Usual> begins(const std::vector<Line>& lines, std::size_t i, const Way& way) {
  const Cells here = cells_of(lines[i].text, way.separator);
  const auto is_number = [&](const std::string& cell) { return number(cell, way.decimal_comma).has_value(); };
  if (here.size() < 2 || std::ranges::none_of(here, is_number)) return {};
  Usual usual(lines, i, way);
  if (!usual.as_many || std::ranges::count(usual.numbers, true) < 2) return {};
  std::size_t found = 0, words = 0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    if (!usual.numbers[k]) continue;
    found += is_number(here[k]);
    words += !is_number(here[k]) && !is_mark(here[k]);
  }
  if (words > 0) {
    const Cells above = i > 0 ? cells_of(lines[i - 1].text, way.separator) : Cells{};
    if (found < 2 || above.size() != here.size() || std::ranges::any_of(above, is_number)) return {};
  }
  return usual;
}

// A way that makes numbers or marks of all cells is preferred: "0,00 1,0" is no line of commas.
std::optional<Beginning> beginning_of(const std::vector<Line>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const bool all_of_it : {true, false})
      for (const Way& way : ways) {
        const Cells here = cells_of(lines[i].text, way.separator);
        const bool whole = std::ranges::all_of(
            here, [&](const std::string& cell) { return number(cell, way.decimal_comma) || is_mark(cell); });
        if (all_of_it && !whole) continue;
        if (auto usual = begins(lines, i, way)) return Beginning{i, way, *usual};
      }
  return {};
}

}  // namespace

std::size_t LabTable::column(const std::string& name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

LabTable read_lab_table(const std::filesystem::path& file, const std::string& a_column) {
  const std::vector<Line> lines = lines_of(file);
  const std::optional<Beginning> begins = beginning_of(lines);
  if (!begins) throw Error(file.string() + " holds no table of numbers: export it as text with columns", Exit::data);
  const Way& way = begins->way;
  // A separator at the end of every line makes no column, unless one is named there.
  std::size_t count = begins->usual.numbers.size();
  const auto raw = [&](std::size_t so_many) {
    return so_many <= begins->line ? cells_of(lines[begins->line - so_many].text, way.separator) : Cells{};
  };
  const auto names_the_last = [&](const Cells& cells) { return cells.size() == count && !cells.back().empty(); };
  if (begins->usual.none_behind && !names_the_last(raw(1)) && !names_the_last(raw(2))) --count;
  const auto cells_in = [&](const std::string& text) {
    Cells cells = cells_of(text, way.separator);
    if (cells.size() == count + 1 && cells.back().empty()) cells.pop_back();
    return cells;
  };
  const auto above = [&](std::size_t so_many) {
    return so_many <= begins->line ? cells_in(lines[begins->line - so_many].text) : Cells{};
  };
  LabTable table;
  table.file = file;
  // The names stand right above, or with a line of units between; which of the two the column tells that is looked for.
  Cells names = above(1), units = above(2);
  const auto fits = [&](const Cells& cells) { return cells.size() == count; };
  const auto tells = [&](const Cells& cells) {
    return fits(cells) && std::ranges::find(cells, a_column) != cells.end();
  };
  if (fits(units) && (tells(units) || !tells(names)))
    std::swap(names, units);
  else
    units.clear();
  if (!fits(names)) {
    names.clear();
    for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i + 1));
  }
  if (fits(units)) table.units = units;
  table.columns = names;
  table.values.resize(count);
  table.flaws.resize(count);
  for (std::size_t i = begins->line; i < lines.size(); ++i) {
    const Cells cells = cells_in(lines[i].text);
    const std::string place = file.string() + ":" + std::to_string(lines[i].number) + ": ";
    if (cells.size() != count)
      throw Error(place + std::to_string(cells.size()) + " cells where the table has " + std::to_string(count) +
                      " columns: complete or remove the line",
                  Exit::data);
    for (std::size_t k = 0; k < count; ++k) {
      const auto value = number(cells[k], way.decimal_comma);
      const bool known = value && std::isfinite(*value);
      if (!known && table.flaws[k].empty())
        table.flaws[k] =
            place +
            (cells[k].empty() ? "nothing stands in column " + shown(table.columns[k])
                              : shown(cells[k]) + " in column " + shown(table.columns[k]) + " is no finite number") +
            ": correct it, or cut the file there";
      if (known && table.with_comma.empty() && cells[k].find(',') != std::string::npos) table.with_comma = cells[k];
      table.values[k].push_back(known ? *value : std::numeric_limits<double>::quiet_NaN());
    }
    table.lines.push_back(lines[i].number);
  }
  return table;
}

}  // namespace freestand
