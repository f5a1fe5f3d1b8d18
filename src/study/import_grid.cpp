#include "study/import_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "measurement/data/floor_readings.hpp"
#include "measurement/noise/third_differences.hpp"

namespace freestand::study {
namespace {

// So near to it that all readings stand on the grid.
bool is_whole(double ratio, std::size_t readings) {
  return std::abs(ratio - std::round(ratio)) * static_cast<double>(readings) < 0.05;
}
// That of a reading of the response, where these stand on the grid; else as early as both run.
double first_instant(const File& floor, const Series& times, double steps_a_reading) {
  const double both = std::max(floor.time.front(), times.front());
  if (!is_whole(steps_a_reading, times.size())) return both;
  const auto first = std::ranges::find_if(times, [&](double time) { return time >= both; });
  return first == times.end() ? both : *first;
}

}  // namespace

double step_of(const Laboratory& laboratory, const File& floor, const File& response) {
  return laboratory.sampling_dt_s > 0 ? laboratory.sampling_dt_s : std::min(floor.step_s, response.step_s);
}

TestOfLab on_one_clock(const Laboratory& laboratory, const LabTest& lab, const File& floor, const File& response,
                       double clock_s) {
  Series times = response.time;
  for (double& time : times) time -= clock_s;
  const double step_s = step_of(laboratory, floor, response),
               start = first_instant(floor, times, response.step_s / step_s);
  const double end = std::min(floor.time.back(), times.back());
  const double steps = std::floor((end - start) / step_s * (1 + 1e-9) + 1e-6);
  if (!(steps >= 10))
    throw Error(
        fmt::format("{}: floor and response have no time in common ({} runs from {:.4g} to {:.4g} s, {} from {:.4g} to "
                    "{:.4g} s{}): {} clock_s, by how much the response is stamped late",
                    lab.id, lab.floor.path.string(), floor.time.front(), floor.time.back(), lab.response.path.string(),
                    response.time.front(), response.time.back(),
                    lab.clock_s ? fmt::format(", less clock_s of {:.4g} s", *lab.clock_s) : "",
                    lab.clock_s ? "correct" : "give"),
        Exit::data);
  const auto count = static_cast<std::size_t>(steps) + 1;
  const auto of = [&](const File& file, const Series& time, const std::optional<LabColumn>& column) {
    return column ? at_times(file, time, *column, start, step_s, count) : Series{};
  };
  TestOfLab t;
  t.start_s = start;
  const auto of_floor = [&](const std::optional<LabColumn>& column) {
    return column ? floor_at_times(floor, *column, start, step_s, count) : Series{};
  };
  t.floor = of_floor(lab.acceleration);
  t.vertical = of_floor(lab.vertical);
  t.test.id = lab.id;
  t.test.role = lab.role;
  t.test.dt_s = step_s;
  const double steps_a_reading = std::round(response.step_s / step_s);
  if (is_whole(response.step_s / step_s, times.size()) && steps_a_reading <= measurement::most_steps_a_reading)
    t.test.steps_a_reading = std::max(1, static_cast<int>(steps_a_reading));
  t.test.slip_m = of(response, times, lab.slip);
  t.test.rotation_rad = of(response, times, lab.rotation);
  t.test.block_acceleration_mps2 = of(response, times, lab.block_acceleration);
  measurement::read_floor(t.test, {lab.id, step_s, t.floor});
  return t;
}

double noise_of(const File& file, const std::optional<LabColumn>& column, double given) {
  return given > 0 || !column ? given : measurement::sensor_noise(channel(file.table, *column));
}

}  // namespace freestand::study
