#include "study/import_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/shown_text.hpp"
#include "measurement/data/floor_readings.hpp"

namespace freestand::study {
namespace {

// Of a step: clocks are read to some microseconds.
constexpr double same_instant = 1e-3;
// Times the usual step. A missing row makes it two; a clock of whole milliseconds, of steps of one and a half, makes two of one and a half.
constexpr double longest_step = 1.6;

Series curve_at(const File& file, Series places, const LabColumn& column, bool smooth, double start, double step_s,
                std::size_t count) {
  for (double& place : places) place -= start;
  const Series values = channel(file.table, column);
  Series curve = measurement::curve_through(places, values, smooth, step_s, count);
  // What was read at just these times comes as it was read: a sum of shares of it would differ in its last digit, and a sensor's steps show
  // no more.
  for (std::size_t row = 0; row < places.size(); ++row) {
    const double at = std::round(places[row] / step_s);
    if (at >= 0 && at < static_cast<double>(count) && std::abs(places[row] - at * step_s) <= same_instant * step_s)
      curve[static_cast<std::size_t>(at)] = values[row];
  }
  return curve;
}

// The usual step, of a clock that is read to some digits or jitters: the mean one, missing rows left out, in as few digits as that is known to.
double usual_step(const Series& time) {
  Series steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  Series sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
  const double middle = sorted[sorted.size() / 2];
  double sum = 0, count = 0;
  for (const double step : steps)
    if (step <= longest_step * middle) sum += step, ++count;
  const double mean = sum / count;
  double off = 0, place = 0;  // the clock against that step
  for (const double step : steps) {
    if (step > longest_step * middle) continue;
    place += step - mean;
    off = std::max(off, std::abs(place));
  }
  for (const double digit : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double rounded = std::round(mean / digit) * digit;
    if (rounded > 0 && std::abs(rounded - mean) <= 2 * off / count + 1e-9 * mean) return rounded;
  }
  return mean;
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
  if (!table.flaws[place].empty()) throw Error(table.flaws[place], Exit::data);
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
  file.step_s = usual_step(file.time);
  for (std::size_t row = 1; row < file.time.size(); ++row)
    if (const double step = file.time[row] - file.time[row - 1]; step > (1 + longest_step) * file.step_s)
      throw Error(
          fmt::format(
              "{}:{}: {:.4g} s are missing before this line (the usual step is {:.4g} s; what happened then is not "
              "known): cut the file there, or complete it",
              lab.path.string(), file.table.lines[row], step - file.step_s, file.step_s),
          Exit::data);
  return file;
}

bool is_behind_gap(const File& file, std::size_t row) {
  return row > 0 && file.time[row] - file.time[row - 1] > longest_step * file.step_s;
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
