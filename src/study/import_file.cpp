#include "study/import_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"
#include "measurement/data/floor_readings.hpp"

namespace freestand::study {
namespace {

Series curve_at(const File& file, Series places, const LabColumn& column, bool smooth, double start, double step_s,
                std::size_t count) {
  for (double& place : places) place -= start;
  return measurement::curve_through(places, channel(file.table, column), smooth, step_s, count);
}

}  // namespace

Series channel(const LabTable& table, const LabColumn& column) {
  const std::size_t place = table.column(column.name);
  if (place == table.columns.size()) {
    std::string names;
    for (const std::string& name : table.columns) names += (names.empty() ? "" : ", ") + shown(name);
    throw Error(fmt::format("{} has no column {} (its columns are {}): correct the name", table.file.string(),
                            shown(column.name), names),
                Exit::data);
  }
  if (std::count(table.columns.begin(), table.columns.end(), column.name) > 1)
    throw Error(fmt::format("{} has two columns {} (it is not told which is meant): give one another name",
                            table.file.string(), shown(column.name)),
                Exit::data);
  Series values = table.values[place];
  for (double& value : values) value *= column.factor;
  return values;
}

File read_file(const LabFile& lab) {
  File file{read_lab_table(lab.path), {}, 0};
  file.time = channel(file.table, lab.time);
  Series steps;
  for (std::size_t i = 1; i < file.time.size(); ++i) {
    steps.push_back(file.time[i] - file.time[i - 1]);
    if (steps.back() <= 0)
      throw Error(fmt::format("{}:{}: time does not rise (column {}): correct it, or cut the file there",
                              lab.path.string(), file.table.lines[i], shown(lab.time.name)),
                  Exit::data);
  }
  if (steps.size() < 10)
    throw Error(fmt::format("{} holds {} rows (a history needs ten and more): give the whole of it", lab.path.string(),
                            file.time.size()),
                Exit::data);
  std::nth_element(steps.begin(), steps.begin() + static_cast<long>(steps.size() / 2), steps.end());
  file.step_s = steps[steps.size() / 2];
  return file;
}

bool is_behind_gap(const File& file, std::size_t row) {
  return row > 0 && file.time[row] - file.time[row - 1] > 1.5 * file.step_s;
}

Series at_times(const File& file, const Series& time, const LabColumn& column, double start, double step_s,
                std::size_t count) {
  return curve_at(file, time, column, false, start, step_s, count);
}

Series floor_at_times(const File& floor, const LabColumn& column, double start, double step_s, std::size_t count) {
  bool smooth = measurement::is_smooth(floor.step_s);
  for (std::size_t row = 0; row < floor.time.size(); ++row) smooth = smooth && !is_behind_gap(floor, row);
  return curve_at(floor, floor.time, column, smooth, start, step_s, count);
}

}  // namespace freestand::study
