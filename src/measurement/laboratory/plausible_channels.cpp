#include "measurement/laboratory/plausible_channels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/units.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/data/smooth.hpp"

namespace freestand::measurement {
namespace {

constexpr double rocking_half_window_s = 0.04;

// Sum of y z over that of z z, and the sums that its standard error needs.
struct Slope {
  double yy = 0, yz = 0, zz = 0, count = 0;
  void add(double y, double z) { yy += y * y, yz += y * z, zz += z * z, count += 1; }
  double value() const { return zz > 0 ? yz / zz : 0; }
  double error(double independent) const {
    return std::sqrt(std::max(yy - yz * value(), 0.0) / (zz * std::max(independent - 1, 1.0)));
  }
};

// Samples before anything is displaced by more than five times its noise, which no noise does in a million.
std::size_t samples_before_motion(const Bench& bench, const Test& test) {
  std::size_t before = test.block_acceleration_mps2.size();
  for (const Channel channel : {Channel::slip, Channel::rotation}) {
    const auto& samples = history(test, channel);
    std::size_t k = 0;
    while (k < samples.size() && std::abs(samples[k]) < 5 * bench.noise(channel)) ++k;
    if (!samples.empty()) before = std::min(before, k);
  }
  const std::size_t half = half_window_samples(rocking_half_window_s, test.dt_s);  // a motion begins before it is seen
  return before > half ? before - half : 0;
}

}  // namespace

double frozen_s(const Bench& bench, std::size_t i, Channel channel) {
  const Test& test = bench.test(i);
  const std::vector<double> samples = readings(test, channel);
  const double noise = bench.noise(channel) * bench.sensor(channel).size();
  if (samples.size() < 2 || noise <= 0) return 0;
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  double step = std::numeric_limits<double>::infinity();
  std::size_t run = 1, longest = 1;
  bool begun = false;  // what stands before the first change is how recorders fill the time before they are started
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double change = std::abs(samples[k] - samples[k - 1]);
    if (change > 0) step = std::min(step, change);
    const bool within = samples[k] != *least && samples[k] != *most;  // a sensor at its end is clipped, and told of so
    begun |= change > 0;
    run = begun && change == 0 && within ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  const auto n = static_cast<double>(samples.size());
  const double repeated = std::max(step / (2 * std::sqrt(std::numbers::pi) * noise), 1 / n);
  if (repeated >= 1 || n * std::pow(repeated, static_cast<double>(longest - 1)) > 1e-6) return 0;
  return static_cast<double>(longest) * test.steps_a_reading * test.dt_s;
}

bool same_history(const Bench& bench, std::size_t i, std::size_t other, Channel channel) {
  const auto &a = history(bench.test(i), channel), &b = history(bench.test(other), channel);
  const std::size_t n = std::min(a.size(), b.size());
  return n > 1 && std::equal(a.begin(), a.begin() + static_cast<long>(n), b.begin()) &&
         std::any_of(a.begin(), a.begin() + static_cast<long>(n), [&](double s) { return s != a[0]; });
}

bool same_floor(const Bench& bench, std::size_t i, std::size_t other) {
  const Test &a = bench.test(i), &b = bench.test(other);
  if (!a.has_history() || !b.has_history() || bench.floor_noise_mps2(i) <= 0 || bench.floor_noise_mps2(other) <= 0)
    return false;
  const auto &one = a.motion.horizontal_mps2, &two = b.motion.horizontal_mps2;
  const std::size_t n = std::min(one.size(), two.size());
  return n > 1 && a.scale == b.scale && std::equal(one.begin(), one.begin() + static_cast<long>(n), two.begin());
}

bool same_peaks(const Bench& bench, std::size_t i, std::size_t other) {
  const Test &a = bench.test(i), &b = bench.test(other);
  const bool moved = a.peaks.peak_slip_m.value_or(0) != 0 || a.peaks.peak_rotation_rad.value_or(0) != 0;
  return moved && !a.has_history() && !b.has_history() && a.peaks == b.peaks && a.specimen == b.specimen &&
         a.scale == b.scale && a.stretch == b.stretch && a.motion.horizontal_mps2 == b.motion.horizontal_mps2;
}

bool turns_against_floor(const Bench& bench, std::size_t i) {
  const Test& test = bench.test(i);
  const Dimensions& body = test.specimen;
  if (test.rotation_rad.empty() || !body.width_m || !body.height_m || bench.noise(Channel::rotation) <= 0) return false;
  const double radius = 0.5 * std::hypot(*body.width_m, *body.height_m);
  const double alpha = std::atan2(*body.width_m, *body.height_m), p2 = 0.75 * standard_gravity_mps2 / radius;
  const Smooth motion = smooth(test.rotation_rad, test.dt_s, rocking_half_window_s);
  const double least = 8 * bench.noise(Channel::rotation);
  Slope slope;
  for (std::size_t k = motion.half; k + motion.half < test.rotation_rad.size(); ++k) {
    const double theta = motion.value[k], side = std::copysign(1.0, theta), lean = alpha - std::abs(theta);
    const auto from = test.rotation_rad.begin() + static_cast<long>(k - motion.half);
    if (lean < 0 ||
        !std::all_of(from, from + static_cast<long>(2 * motion.half + 1), [&](double s) { return side * s > least; }))
      continue;
    slope.add(motion.second[k] + p2 * side * std::sin(lean),
              -p2 * floor_acceleration_mps2(test, k) / standard_gravity_mps2 * std::cos(lean));
  }
  const double independent = slope.count / static_cast<double>(2 * motion.half + 1);
  return independent >= 4 && slope.value() < -4 * slope.error(independent);
}

FloorShare share_of_floor(const Bench& bench, const std::vector<std::size_t>& tests, double floor_without_slip_mps2) {
  Slope slope;
  double of_noise = 0;
  for (const std::size_t i : tests) {
    const Test& test = bench.test(i);
    const std::size_t before = samples_before_motion(bench, test);
    for (std::size_t k = 0; k < before; ++k) {
      const double floor = floor_acceleration_mps2(test, k);
      if (std::abs(floor) > floor_without_slip_mps2) break;
      slope.add(test.block_acceleration_mps2[k], floor);
      of_noise += std::pow(bench.floor_noise_mps2(i), 2);
    }
  }
  if (slope.count <= 10 || slope.zz <= 5 * of_noise) return {};
  const double freed = slope.zz / (slope.zz - of_noise), error = freed * slope.error(slope.count);
  if (std::abs(slope.value()) <= 5 * error) return {};
  return {freed * slope.value(), error};
}

}  // namespace freestand::measurement
