#include "measurement/data/test_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/key_names.hpp"
#include "base/shown_text.hpp"
#include "measurement/data/floor_readings.hpp"
#include "motion/record_text.hpp"

namespace freestand::measurement {
namespace {

using motion::RecordText;

const std::vector<std::string> needed_columns = {"time_s", "floor_acceleration_mps2"},
                               one_needed = {"slip_m", "rotation_rad"};
const std::vector<std::string> known_columns = {
    "time_s",       "floor_acceleration_mps2", "floor_vertical_acceleration_mps2", "slip_m",
    "rotation_rad", "block_acceleration_mps2"};

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  std::vector<std::size_t> lines;  // of each row

  const std::vector<double>& needed(const std::string& name) const { return values.at(place(name)); }  // by check_names
  const std::vector<double>* find(const std::string& name) const {
    return place(name) == names.size() ? nullptr : &values[place(name)];
  }

 private:
  std::size_t place(const std::string& name) const {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
};

std::size_t header_line(const RecordText& text) {
  std::size_t line = 0;
  while (line < text.size() && (motion::trim(text.line(line)).empty() || text.line(line)[0] == '#')) ++line;
  return line;
}

// As table programs and loggers write it.
bool is_gap(std::string_view cell) {
  const std::string word = motion::lower_case(cell);
  return word.empty() || word == "nan" || word == "na" || word == "n/a" || word == "#n/a" || word == "null" ||
         word.find_first_not_of('-') == std::string::npos;
}

void read_row(const RecordText& text, std::size_t line, Columns& columns) {
  const auto row = motion::cells(text.line(line));
  if (row.size() != columns.names.size())
    text.fail(line, fmt::format("{} columns (the header has {}): correct the line{}", row.size(), columns.names.size(),
                                row.size() > columns.names.size() ? "; numbers have points, not commas" : ""));
  for (std::size_t column = 0; column < row.size(); ++column) {
    const std::string_view cell = row[column];
    if (!holds(known_columns, columns.names[column])) continue;
    const std::string& name = columns.names[column];
    if (is_gap(cell))
      text.fail(line, fmt::format("{} is {} (a gap cannot be compared with anything): cut the test there, or fill the "
                                  "gap where the signal allows it",
                                  name, cell.empty() ? "empty" : shown(cell)));
    columns.values[column].push_back(text.number(line, cell));
  }
  columns.lines.push_back(line);
}

// What the header's line looks like, where it cannot be one: other separators, or numbers.
void check_header(const RecordText& text, std::size_t header) {
  const std::string_view line = text.line(header);
  const auto has = [&](char c) { return line.find(c) != std::string_view::npos; };
  if (!has(',') && (has(';') || has('\t')))
    text.fail(header,
              fmt::format("the columns are parted by {} (a test's csv has commas between its columns, and points "
                          "in its numbers): write it out again so",
                          has(';') ? "semicolons" : "tabs"));
  if (line.find_first_not_of("0123456789+-.,eE \t") == std::string_view::npos)
    text.fail(header, fmt::format("no names of columns (the first line holds numbers): write {},slip_m above them",
                                  fmt::join(needed_columns, ",")));
}

// A channel under another name or in another unit would be left out of every comparison, or read as what it is not.
void check_names(const RecordText& text, std::size_t header, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string &name = names[i], as_shown = shown(name);
    if (name.empty())
      text.fail(header, fmt::format("column {} has no name (a comma too many?): name it, or remove it", i + 1));
    if (std::find(names.begin(), names.begin() + static_cast<long>(i), name) != names.begin() + static_cast<long>(i))
      text.fail(header, fmt::format("column {} stands twice (which one is it?): remove or rename one", as_shown));
    if (holds(known_columns, name)) continue;
    for (const std::string& known : known_columns) {
      if (holds(names, known) || without_unit(name) != without_unit(known)) continue;
      if (without_unit(name) == name)
        text.fail(header,
                  fmt::format("column {} has no unit (every column carries its own): write {}", as_shown, known));
      text.fail(header, fmt::format("column {} has another unit (freestand reads SI, here {}): convert it and write {}",
                                    as_shown, unit_of(known), known));
    }
    const std::string near = nearest(name, known_columns);
    if (!near.empty() && !holds(names, near))
      text.fail(header, fmt::format("unknown column {} (did you mean {}?): correct the name, or remove the column",
                                    as_shown, near));
  }
  for (const std::string& needed : needed_columns)
    if (!holds(names, needed))
      text.fail(header, fmt::format("no column {} (the columns are {}): add it, or correct the name", needed,
                                    shown(motion::trim(text.line(header)), 200)));
  if (std::none_of(one_needed.begin(), one_needed.end(), [&](const auto& name) { return holds(names, name); }))
    text.fail(header, fmt::format("no column {} (the columns are {}): add one, or correct the name",
                                  fmt::join(one_needed, " and none "), shown(motion::trim(text.line(header)), 200)));
}

Columns read_columns(const RecordText& text) {
  Columns columns;
  const std::size_t header = header_line(text);
  check_header(text, header);
  for (const auto name : motion::cells(text.line(header))) columns.names.emplace_back(name);
  check_names(text, header, columns.names);
  columns.values.resize(columns.names.size());
  for (std::size_t line = header + 1; line < text.size(); ++line)
    if (!motion::trim(text.line(line)).empty()) read_row(text, line, columns);
  if (columns.lines.size() < 10)
    text.fail(fmt::format("{} rows (a history needs at least 10): check the file", columns.lines.size()));
  return columns;
}

// The step, after looking for a jump that is a gap rather than a clock that runs unevenly.
double constant_step(const RecordText& text, const Columns& columns) {
  const std::vector<double>& t = columns.needed("time_s");
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
  const double middle = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (middle > 0 && steps[i] <= 0)
      text.fail(columns.lines[i + 1],
                fmt::format("time {} after {:.6g} s (a row too many, or out of order): correct the rows",
                            steps[i] < 0 ? "goes back" : "stands still", t[i]));
    if (middle > 0 && steps[i] > 1.5 * middle)
      text.fail(
          columns.lines[i + 1],
          fmt::format("time jumps by {:.6g} s (the step is {:.6g} s, so samples are missing): cut the test there, "
                      "or fill the gap where the signal allows it",
                      steps[i], middle));
  }
  return text.even_step(t, columns.lines);
}

// Is one column another one with a factor and an offset? Two sensors have two noises; what is written to six digits and
// more is a copy where nothing else is left. A table may be told to move upwards as it moves sideways, in another size.
bool is_copy(const std::vector<double>& a, const std::vector<double>& b, bool any_factor) {
  const auto n = static_cast<double>(a.size());
  const double of_a = std::accumulate(a.begin(), a.end(), 0.0) / n, of_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0, bb = 0, most = 0, left = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - of_a) * (b[i] - of_b);
    bb += (b[i] - of_b) * (b[i] - of_b);
    most = std::max(most, std::abs(a[i] - of_a));
  }
  if (!(bb > 0) || !(most > 0)) return false;  // a sensor that is dead, and told of elsewhere
  const double factor = any_factor ? ab / bb : 1;
  for (std::size_t i = 0; i < a.size(); ++i) left = std::max(left, std::abs(a[i] - of_a - factor * (b[i] - of_b)));
  return left < 1e-5 * most;
}

void check_copies(const RecordText& text, const Columns& columns) {
  for (std::size_t i = 2; i < known_columns.size(); ++i)
    for (std::size_t k = 1; k < i; ++k) {
      const auto *a = columns.find(known_columns[i]), *b = columns.find(known_columns[k]);
      const bool floor = known_columns[i] == "floor_vertical_acceleration_mps2";
      if (a && b && is_copy(*a, *b, !floor))
        text.fail(
            header_line(text),
            fmt::format("column {} is a copy of {} (two sensors never read the same): put what its own sensor read "
                        "in its place, or remove it",
                        known_columns[i], known_columns[k]));
    }
}

}  // namespace

void read_test_file(const std::filesystem::path& path, double dt_s, Test& test) {
  const RecordText text(path);
  const Columns columns = read_columns(text);
  const double step = constant_step(text, columns);
  check_copies(text, columns);
  if (dt_s > 0 && std::abs(step - dt_s) > 0.01 * dt_s)
    text.fail(
        fmt::format("the step is {:.6g} s (the data set states sampling_dt_s: {:.6g}): correct one of them, or leave "
                    "sampling_dt_s out where tests differ",
                    step, dt_s));
  const auto* vertical = columns.find("floor_vertical_acceleration_mps2");
  read_floor(test, {path.string(), step, columns.needed("floor_acceleration_mps2"),
                    vertical ? *vertical : std::vector<double>{}});
  test.dt_s = step;
  test.source = path.string();
  if (const auto* slip = columns.find("slip_m")) test.slip_m = *slip;
  if (const auto* rotation = columns.find("rotation_rad")) test.rotation_rad = *rotation;
  if (const auto* block = columns.find("block_acceleration_mps2")) test.block_acceleration_mps2 = *block;
  for (const std::string& name : columns.names)
    if (!holds(known_columns, name)) test.unused_columns.push_back(name);
}

}  // namespace freestand::measurement
