#include "study/specimen_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "base/csv_table.hpp"
#include "base/shown_text.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using Cells = std::vector<std::string>;

// Where a column's cells go in an entry: "block.width_m" for width_m.
const std::map<std::string, std::string>& places() {
  static const std::map<std::string, std::string> all = [] {
    std::map<std::string, std::string> made;
    for (const char* name : {"id", "class", "description", "source", "floor", "friction"}) made[name] = name;
    for (const char* name : {"width_m", "height_m", "slenderness_rad", "size_m", "mass_kg", "centre_height_m",
                             "gyration_radius_m", "inertia_kgm2"})
      made[name] = std::string("block.") + name;
    for (const char* name : {"mu", "mu_k", "mu_s", "static_ratio"}) made[name] = std::string("friction.") + name;
    for (const char* name : {"source", "id", "intensity", "demand", "capacity", "median", "dispersion"})
      made[std::string("reference_") + name] = std::string("reference.") + name;
    return made;
  }();
  return all;
}

bool is_dotted(const std::string& column) {
  const std::size_t dot = column.find('.');
  return dot != std::string::npos && dot > 0 && dot + 1 < column.size();
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string quoted(const std::string& text) {
  YAML::Emitter out;
  out << YAML::DoubleQuoted << text;
  return out.c_str();
}

// Text of a mapping with every key on line `line`, as the parser counts.
YAML::Node on_line(int line, const std::string& flow) {
  return YAML::Load(std::string(static_cast<std::size_t>(line - 1), '\n') + flow);
}

// Columns that are not known are told as keys of a mapping are: with their unit, or what was probably meant.
void check_header(const Cells& header, int line, Problems& problems) {
  constexpr std::size_t longest_key = 1000;  // quoted, YAML reads keys of 1024 characters
  for (const std::string& column : header)
    if (quoted(column).size() > longest_key) {
      problems.add(line, fmt::format("a column's name has {} characters (no column is called so): is this a table with "
                                     "commas between its columns?",
                                     column.size()));
      return;
    }
  std::string flow;
  for (const std::string& column : header)
    if (!is_dotted(column)) flow += fmt::format("{}{}: 1", flow.empty() ? "" : ", ", quoted(column));
  Section section(on_line(line, "{" + flow + "}"), "the columns", line, problems);
  for (const auto& [name, place] : places()) section.find(name);
  section.finish();
  for (std::size_t i = 0; i < header.size(); ++i)
    if (is_dotted(header[i]) && std::count(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(i), header[i]))
      problems.add(line, fmt::format("column {} stands twice (which one counts?): remove one", shown(header[i])));
  if (std::find(header.begin(), header.end(), "id") == header.end())
    problems.add(line, "column id is missing (each row is an entry of that name): add it");
}

// The cells of a row, by the mapping that they stand in; "" for the entry itself. An effect's parameters stand in a mapping of
// its name.
std::string entry_text(const Cells& header, const Cells& cells) {
  std::map<std::string, std::string> parts;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (cells[i].empty()) continue;
    const auto known = places().find(header[i]);
    const std::string place = known == places().end() ? header[i] : known->second;
    const std::size_t dot = place.rfind('.');
    const std::string in = dot == std::string::npos ? "" : place.substr(0, dot);
    const std::string key = dot == std::string::npos ? place : place.substr(dot + 1);
    const std::string value = cells[i].front() == '{' ? cells[i] : quoted(cells[i]);
    std::string& text = parts[in];
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", quoted(key), value);
  }
  std::string flow = parts[""], effects;
  for (const auto& [in, text] : parts) {
    if (in.empty()) continue;
    if (in.starts_with("effects."))
      effects += fmt::format("{}{{name: {}, {}}}", effects.empty() ? "" : ", ", quoted(in.substr(8)), text);
    else
      flow += fmt::format("{}{}: {{{}}}", flow.empty() ? "" : ", ", quoted(in), text);
  }
  if (!effects.empty()) flow += fmt::format("{}effects: [{}]", flow.empty() ? "" : ", ", effects);
  return "{" + flow + "}";
}

void read_row(const Cells& header, const std::string& text, int line, std::vector<SpecimenRow>& rows,
              Problems& problems) {
  const auto found = csv_cells(text);
  if (!found) {
    problems.add(line, "a quote is not closed (a cell in quotes ends on its line): close it");
    return;
  }
  const Cells& cells = *found;
  if (cells.size() != header.size()) {
    problems.add(line,
                 fmt::format("the row has {} cells, the header {} (a distribution with commas wants quotes around it): "
                             "correct it",
                             cells.size(), header.size()));
    return;
  }
  try {
    rows.push_back({line, YAML::Load(entry_text(header, cells))});
  } catch (const YAML::Exception& error) {
    problems.add(line, fmt::format("a cell of the row is no number and no distribution ({}): correct it",
                                   shown(error.msg, 200)));
  }
}

}  // namespace

std::vector<SpecimenRow> read_specimen_table(const std::filesystem::path& file, Problems& problems) {
  std::istringstream stream(read_text(file));
  std::vector<SpecimenRow> rows;
  Cells header;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (line == 1 && text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    if (trimmed(text).empty() || trimmed(text).front() == '#') continue;
    if (!header.empty()) {
      read_row(header, text, line, rows, problems);
      continue;
    }
    header = csv_cells(text).value_or(Cells{text});
    if (header.size() == 1 && text.find_first_of(";\t") != std::string::npos) {
      problems.add(line,
                   "the header has one column (they are parted by commas here): write commas in place of ; and tabs");
      return {};
    }
    const std::size_t before = problems.count();
    check_header(header, line, problems);
    if (problems.count() != before) return {};
  }
  if (rows.empty() && problems.empty())
    problems.add(0, "the table has no rows (below a header, one row an entry): add some");
  return rows;
}

}  // namespace freestand::study
