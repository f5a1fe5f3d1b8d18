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
// Times the usual step; a missing row makes it two.
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

// The last digit of the clock that is not always 0: 0.001 where it is read to milliseconds.
double digit_of(const Series& time) {
  for (int digits = 0; digits < 9; ++digits) {
    const double scale = std::pow(10, digits);
    if (std::ranges::all_of(time, [&](double t) { return std::abs(t * scale - std::round(t * scale)) < 1e-4; }))
      return 1 / scale;
  }
  return 0;
}

// Longer than the usual step, by more than the clock's last digit makes it: rows are missing.
bool lacks_rows(double step, double usual, double digit) {
  return step > longest_step * usual && step > usual + 0.999 * digit;
}

// The usual step, of a clock that is read to some digits or jitters: the mean one, missing rows left out, in as few digits as that is known to.
double usual_step(const Series& time, double digit) {
  double mean = (time.back() - time.front()) / static_cast<double>(time.size() - 1), off = 0, count = 0;
  for (double before = 0; mean != before;) {
    before = mean;
    double sum = 0, place = 0;  // place: the clock against that step
    off = count = 0;
    for (std::size_t i = 1; i < time.size(); ++i) {
      const double step = time[i] - time[i - 1];
      if (lacks_rows(step, before, digit)) continue;
      sum += step, ++count;
      off = std::max(off, std::abs(place += step - before));
    }
    mean = sum / count;
  }
  for (const double a_second : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    const double rounded = std::round(mean * a_second) / a_second;
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
  File file{read_lab_table(lab.path, lab.time.name), {}};
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
  file.digit_s = digit_of(file.time);
  file.step_s = usual_step(file.time, file.digit_s);
  for (std::size_t row = 1; row < file.time.size(); ++row)
    if (const double step = file.time[row] - file.time[row - 1];
        lacks_rows(step - file.step_s, file.step_s, file.digit_s))
      throw Error(fmt::format("{}:{}: {:.4g} s are missing before this line (the usual step is {:.4g} s; what happened "
                              "then is not known): cut the file there, or complete it",
                              lab.path.string(), file.table.lines[row], step - file.step_s, file.step_s),
                  Exit::data);
  return file;
}

bool is_behind_gap(const File& file, std::size_t row) {
  return row > 0 && lacks_rows(file.time[row] - file.time[row - 1], file.step_s, file.digit_s);
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
