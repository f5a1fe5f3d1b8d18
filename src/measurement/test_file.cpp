#include "measurement/test_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motion/record_text.hpp"

namespace freestand::measurement {
namespace {

using motion::RecordText;

struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  std::vector<std::size_t> lines;  // of each row

  const std::vector<double>* find(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? nullptr : &values[static_cast<std::size_t>(found - names.begin())];
  }
};

std::size_t header_line(const RecordText& text) {
  std::size_t line = 0;
  while (line < text.size() && (motion::trim(text.line(line)).empty() || text.line(line)[0] == '#')) ++line;
  return line;
}

void read_row(const RecordText& text, std::size_t line, Columns& columns) {
  std::string_view rest = text.line(line);
  std::size_t column = 0;
  for (bool more = true; more; ++column) {
    const std::size_t comma = rest.find(',');
    const std::string_view cell = motion::trim(rest.substr(0, comma));
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
    if (column >= columns.names.size()) continue;
    const std::string& name = columns.names[column];
    if (cell.empty())
      text.fail(line, fmt::format("{} is empty (a gap cannot be compared with anything): cut the test there, or fill "
                                  "the gap where the signal allows it",
                                  name));
    const double value = text.number(line, cell);
    if (!std::isfinite(value))
      text.fail(line, fmt::format("{} is {} (a gap cannot be compared with anything): cut the test there, or fill the "
                                  "gap where the signal allows it",
                                  name, cell));
    columns.values[column].push_back(value);
  }
  if (column != columns.names.size())
    text.fail(line, fmt::format("{} columns (the header has {}): correct the line", column, columns.names.size()));
  columns.lines.push_back(line);
}

Columns read_columns(const RecordText& text) {
  Columns columns;
  const std::size_t header = header_line(text);
  for (const auto name : motion::split(text.line(header), ",")) columns.names.emplace_back(motion::trim(name));
  columns.values.resize(columns.names.size());
  for (std::size_t line = header + 1; line < text.size(); ++line)
    if (!motion::trim(text.line(line)).empty()) read_row(text, line, columns);
  for (const char* needed : {"time_s", "floor_acceleration_mps2", "slip_m"})
    if (!columns.find(needed))
      text.fail(header, fmt::format("no column {} (the columns are {}): add it, or correct the name", needed,
                                    motion::trim(text.line(header))));
  if (columns.lines.size() < 10)
    text.fail(fmt::format("{} rows (a history needs at least 10): check the file", columns.lines.size()));
  return columns;
}

// The step, after looking for a jump that is a gap rather than a clock that runs unevenly.
double constant_step(const RecordText& text, const Columns& columns) {
  const std::vector<double>& t = *columns.find("time_s");
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
  const double middle = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (middle > 0 && steps[i] > 1.5 * middle)
      text.fail(
          columns.lines[i + 1],
          fmt::format("time jumps by {:.6g} s (the step is {:.6g} s, so samples are missing): cut the test there, "
                      "or fill the gap where the signal allows it",
                      steps[i], middle));
  return text.even_step(t, columns.lines);
}

}  // namespace

void read_test_file(const std::filesystem::path& path, double dt_s, Test& test) {
  const RecordText text(path);
  const Columns columns = read_columns(text);
  const double step = constant_step(text, columns);
  if (dt_s > 0 && std::abs(step - dt_s) > 0.01 * dt_s)
    text.fail(fmt::format("the step is {:.6g} s (the data set states sampling_dt_s: {:.6g}): correct one of them", step,
                          dt_s));
  const auto* vertical = columns.find("floor_vertical_acceleration_mps2");
  test.motion = piecewise_linear(path.string(), step, *columns.find("floor_acceleration_mps2"),
                                 vertical ? *vertical : std::vector<double>{});
  test.dt_s = step;
  test.source = path.string();
  test.slip_m = *columns.find("slip_m");
  if (const auto* rotation = columns.find("rotation_rad")) test.rotation_rad = *rotation;
  if (const auto* block = columns.find("block_acceleration_mps2")) test.block_acceleration_mps2 = *block;
}

}  // namespace freestand::measurement
