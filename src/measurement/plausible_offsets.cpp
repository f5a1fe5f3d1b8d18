#include "measurement/plausible_offsets.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/plausible.hpp"

namespace freestand::measurement {
namespace {

constexpr std::size_t most = 200;  // samples before the shaking

struct Part {
  double mean = 0, scatter = 0;
};

Part part_of(std::span<const double> samples) {
  const auto n = static_cast<double>(samples.size());
  Part p;
  for (const double s : samples) p.mean += s / n;
  for (const double s : samples) p.scatter += (s - p.mean) * (s - p.mean) / n;
  p.scatter = std::sqrt(p.scatter);
  return p;
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
    speed += test.dt_s * std::abs(horizontal_acceleration(test.shaking(), static_cast<double>(n) * test.dt_s));
    moved += test.dt_s * speed;
  }
  if (moved == 0) return 0;
  const auto count = static_cast<double>(std::max<std::size_t>(n, 1));
  const double mean = sum / count;
  return std::abs(mean) > noise * std::max(1.0, 5 / std::sqrt(count)) + 0.5 * noise ? mean : 0;
}

double floor_offset_mps2(const std::vector<double>& floor) {
  const std::size_t n = std::max<std::size_t>(floor.size() / 20, 10);
  if (floor.size() < 4 * n) return 0;
  const Part before = part_of({floor.data(), n}), after = part_of({floor.data() + floor.size() - n, n});
  const double least = std::min(std::abs(before.mean), std::abs(after.mean));
  const bool steady = least > 3 * std::max(before.scatter, after.scatter) && before.mean * after.mean > 0 &&
                      least > 0.5 * std::max(std::abs(before.mean), std::abs(after.mean));
  return steady && least > 0.01 * greatest(floor) ? 0.5 * (before.mean + after.mean) : 0;
}

}  // namespace freestand::measurement
