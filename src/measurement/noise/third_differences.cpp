#include "measurement/noise/third_differences.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/data/floor_readings.hpp"
#include "measurement/data/resolution.hpp"

namespace freestand::measurement {

namespace {

// By windows of so many readings, one a stride behind the other: the level that a share of them stays below, over what white noise has there.
double quiet_level(const std::vector<double>& signal, std::size_t window, std::size_t stride, double share,
                   double of_white_noise) {
  std::vector<double> levels;
  for (std::size_t from = 0; from + window + 3 <= signal.size(); from += stride) {
    double sum = 0;
    for (std::size_t i = from; i < from + window; ++i) {
      const double third = signal[i + 3] - 3 * signal[i + 2] + 3 * signal[i + 1] - signal[i];
      sum += third * third;
    }
    levels.push_back(std::sqrt(sum / (20.0 * static_cast<double>(window))));
  }
  if (levels.empty()) return 0;
  const auto quiet = levels.begin() + static_cast<long>(share * static_cast<double>(levels.size()));
  std::nth_element(levels.begin(), quiet, levels.end());
  return *quiet / of_white_noise;
}

}  // namespace

double sensor_noise(const std::vector<double>& signal) {
  // The quiet fifth; a window of that length comes out 14 % low there on white noise.
  return std::max(quiet_level(signal, 50, 50, 0.2, 0.86), rounding(signal));
}

double slow_noise(const std::vector<double>& signal, double step_s) {
  constexpr double window_s = 0.25;  // as long as 50 readings at 200 Hz
  const auto window = static_cast<std::size_t>(std::max(12.0, std::round(window_s / step_s)));
  // The quiet tenth, which comes out by 1.37 over the root of the window's length low on white noise (simulated, 12 to 50 readings); where no
  // more than that tenth is quiet at all, it is not low, and the noise is told up to 1.7 times too large.
  const double low = 1 - 1.37 / std::sqrt(static_cast<double>(window));
  return std::max(quiet_level(signal, window, window / 4, 0.1, low), rounding(signal));
}

double floor_noise_mps2(const Dataset& data, const Test& test) {
  if (!test.has_history() || test.motion.degree != 1) return 0;
  const double given = data.noise.floor_acceleration_mps2;
  if (given > 0) return given;
  const FloorReadings read = readings_of(test);
  return read.smooth() ? slow_noise(read.horizontal_mps2, read.step_s) : sensor_noise(read.horizontal_mps2);
}

}  // namespace freestand::measurement
