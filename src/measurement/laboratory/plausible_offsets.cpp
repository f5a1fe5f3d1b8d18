#include "measurement/laboratory/plausible_offsets.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/data/floor_readings.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/data/smooth.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/noise/third_differences.hpp"

namespace freestand::measurement {
namespace {

constexpr std::size_t most = 200;  // samples before the shaking

// A mean, and its standard error by the means of ten parts, which slow noise moves as much as it moves the whole.
struct Mean {
  double value = 0, error = 0;
};

Mean mean_of(std::span<const double> samples) {
  constexpr std::size_t parts = 10;
  const std::size_t each = samples.size() / parts;
  Mean mean;
  double square = 0;
  for (std::size_t p = 0; p < parts; ++p) {
    double part = 0;
    for (const double s : samples.subspan(p * each, each)) part += s / static_cast<double>(each);
    mean.value += part / parts;
    square += part * part / parts;
  }
  mean.error = std::sqrt(std::max(0.0, square - mean.value * mean.value) / (parts - 1));
  return mean;
}

// What a slip cannot be farther than, and a rotation than that over half the height: contact takes the block's velocity towards the
// floor's, so that they differ at most as the floor's velocities so far do among themselves. Twice that, since springs and slopes join
// in; and of the first half second of the motion alone, since later a wrong unit does the same.
bool outruns_floor(const Test& test, const std::vector<double>& samples, double offset, double noise, Channel channel) {
  constexpr double times = 2, surely = 8, looked_at_s = 0.5;
  const double arm = channel == Channel::slip ? 1 : 0.5 * test.specimen.height_m.value_or(2);
  double speed = 0, lowest = 0, highest = 0, reach = 0, moving_s = 0;
  for (std::size_t k = 0; k < samples.size() && moving_s < looked_at_s; ++k) {
    speed += test.dt_s * floor_acceleration_mps2(test, k);
    lowest = std::min(lowest, speed);
    highest = std::max(highest, speed);
    reach += test.dt_s * (highest - lowest);
    const double moved = arm * (std::abs(samples[k] - offset) - surely * noise);
    if (moved > times * reach) return true;
    if (moved > 0 || moving_s > 0) moving_s += test.dt_s;
  }
  return false;
}

}  // namespace

double start_offset(const Bench& bench, std::size_t i, Channel channel) {
  const Test& test = bench.test(i);
  const auto& samples = history(test, channel);
  if (samples.empty() || bench.noise(channel) <= 0) return 0;
  const double noise = std::max(bench.noise(channel), sensor_noise(samples));
  const double arm = channel == Channel::slip ? 1 : 0.5 * test.specimen.height_m.value_or(2);
  double speed = 0, moved = 0, sum = 0;
  std::size_t n = 0;
  for (; n < std::min(most, samples.size()) && moved < 0.5 * bench.noise(channel) * arm; ++n) {
    sum += samples[n];
    speed += test.dt_s * std::abs(floor_acceleration_mps2(test, n));
    moved += test.dt_s * speed;
  }
  if (moved == 0) return 0;
  const auto count = static_cast<double>(std::max<std::size_t>(n, 1));
  const double mean = sum / count;
  return std::abs(mean) > noise * std::max(1.0, 5 / std::sqrt(count)) + 0.5 * noise ? mean : 0;
}

bool moves_before_floor(const Bench& bench, std::size_t i, Channel channel) {
  constexpr double half_window_s = 0.03, surely = 8, floor_noises = 5;  // deviations: once in 1e15 and 1e6 samples
  const Test& test = bench.test(i);
  const auto& samples = history(test, channel);
  if (samples.empty() || bench.noise(channel) <= 0 || test.motion.degree != 1) return false;
  const double noise = std::max(bench.noise(channel), sensor_noise(samples));
  const double least = surely * noise * rate_noise(test.dt_s, half_window_s);
  const Smooth motion = smooth(samples, test.dt_s, half_window_s);
  const auto shakes = [&](std::size_t k) {
    return std::abs(floor_acceleration_mps2(test, k)) > floor_noises * bench.floor_noise_mps2(i);
  };
  std::size_t begins = 0;
  while (begins < samples.size() && !shakes(begins)) ++begins;
  if (begins == samples.size()) return false;  // a dead floor, which is told of elsewhere
  // A window that sees a motion may end where it begins.
  for (std::size_t k = 0; k + 2 * motion.half < begins; ++k)
    if (std::abs(motion.firm_rate(k)) > least) return true;
  return outruns_floor(test, samples, start_offset(bench, i, channel), noise, channel);
}

double floor_offset_mps2(const std::vector<double>& floor) {
  constexpr double surely =
      5;  // standard errors of ten means: once in 2 million pairs that are off zero to the same side
  const std::size_t n = std::max<std::size_t>(floor.size() / 20, 10);
  if (floor.size() < 4 * n) return 0;
  const Mean before = mean_of({floor.data(), n}), after = mean_of({floor.data() + floor.size() - n, n});
  const auto is_off = [&](const Mean& mean) { return std::abs(mean.value) > surely * mean.error; };
  const double less = std::min(std::abs(before.value), std::abs(after.value)),
               more = std::max(std::abs(before.value), std::abs(after.value));
  const bool steady = is_off(before) && is_off(after) && before.value * after.value > 0 && less > 0.5 * more;
  return steady ? 0.5 * (before.value + after.value) : 0;
}

std::optional<Dataset> without_floor_offsets(const Dataset& data) {
  Dataset other = data;
  bool any = false;
  for (Test& test : other.tests) {
    if (!test.pulse.empty() || test.motion.degree != 1) continue;
    FloorReadings floor = readings_of(test);
    const double offset = floor_offset_mps2(floor.horizontal_mps2);
    if (offset == 0) continue;
    any = true;
    for (double& a : floor.horizontal_mps2) a -= offset;
    read_floor(test, floor);
  }
  return any ? std::optional(other) : std::nullopt;
}

}  // namespace freestand::measurement
