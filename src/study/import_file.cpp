#include "study/import_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>

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
    if (std::ranges::all_of(time, [&](double t) {
          const double rounding = std::max(1e-4, 4 * std::numeric_limits<double>::epsilon() * std::abs(t) * scale);
          return std::abs(t * scale - std::round(t * scale)) < rounding;
        }))
      return 1 / scale;
  }
  return 0;
}

// Longer than the usual step, by more than the clock's last digit makes it: rows are missing.
bool lacks_rows(double step, const Clock& clock) {
  return step > longest_step * clock.step_s && step > clock.step_s + 0.999 * clock.digit_s;
}

struct Evenness {
  double mean = 0, off = 0, count = 0;  // off: by which the clock strays from even steps of that mean
};
// Missing rows are left out, as seen with these steps at first.
Evenness evenness(const Series& time, Clock clock) {
  Evenness found{clock.step_s};
  double before = 0;
  for (int again = 0; again < 20 && found.mean != before; ++again) {
    before = clock.step_s = found.mean;
    double sum = 0, place = 0, least = 0, most = 0;
    found.count = 0;
    for (std::size_t i = 1; i < time.size(); ++i) {
      const double step = time[i] - time[i - 1];
      if (lacks_rows(step, clock)) continue;
      sum += step, ++found.count;
      place += step - before;
      least = std::min(least, place), most = std::max(most, place);
    }
    found.mean = sum / found.count;
    found.off = most - least;
  }
  return found;
}

// The usual step, of a clock that is read to some digits or jitters: the mean one, in as few digits as that is known to. The last digit makes a
// step longer only where it is all that does.
Clock clock_of(const Series& time) {
  Series steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  const auto middle = steps.begin() + static_cast<long>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  Clock clock{(time.back() - time.front()) / static_cast<double>(time.size() - 1), digit_of(time)};
  Evenness even = evenness(time, clock);
  if (even.off > 1.01 * clock.digit_s) clock = {*middle, 0}, even = evenness(time, clock);
  clock.step_s = even.mean;
  for (const double a_second : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    const double rounded = std::round(even.mean * a_second) / a_second;
    if (rounded > 0 && std::abs(rounded - even.mean) <= 2 * even.off / even.count + 1e-9 * even.mean) {
      clock.step_s = rounded;
      break;
    }
  }
  return clock;
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
  File file;
  file.table = read_lab_table(lab.path, lab.time.name);
  file.time = channel(file.table, lab.time);
  for (std::size_t i = 1; i < file.time.size(); ++i)
    if (file.time[i] <= file.time[i - 1])
      throw Error(fmt::format("{}:{}: time does not rise (column {}): correct it, or cut the file there",
                              lab.path.string(), file.table.lines[i], shown(lab.time.name)),
                  Exit::data);
  if (file.time.size() < 11)
    throw Error(fmt::format("{} holds {} rows (a history needs ten and more): give the whole of it", lab.path.string(),
                            file.time.size()),
                Exit::data);
  static_cast<Clock&>(file) = clock_of(file.time);
  for (std::size_t row = 1; row < file.time.size(); ++row)
    if (const double step = file.time[row] - file.time[row - 1]; lacks_rows(step - file.step_s, file))
      throw Error(fmt::format("{}:{}: {:.4g} s are missing before this line (the usual step is {:.4g} s; what happened "
                              "then is not known): cut the file there, or complete it",
                              lab.path.string(), file.table.lines[row], step - file.step_s, file.step_s),
                  Exit::data);
  return file;
}

bool is_behind_gap(const File& file, std::size_t row) {
  return row > 0 && lacks_rows(file.time[row] - file.time[row - 1], file);
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
