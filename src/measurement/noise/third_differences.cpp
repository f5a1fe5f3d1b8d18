#include "measurement/noise/third_differences.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/data/floor_readings.hpp"
#include "measurement/data/resolution.hpp"

namespace freestand::measurement {

double sensor_noise(const std::vector<double>& signal) {
  constexpr std::size_t window = 50;
  std::vector<double> levels;
  for (std::size_t from = 0; from + window + 3 <= signal.size(); from += window) {
    double sum = 0;
    for (std::size_t i = from; i < from + window; ++i) {
      const double third = signal[i + 3] - 3 * signal[i + 2] + 3 * signal[i + 1] - signal[i];
      sum += third * third;
    }
    levels.push_back(std::sqrt(sum / (20.0 * window)));
  }
  const double rounded = rounding(signal);
  if (levels.empty()) return rounded;
  // The quiet fifth of the windows; a window of that length comes out 14 % low there on white noise.
  const auto quiet = levels.begin() + static_cast<long>(levels.size() / 5);
  std::nth_element(levels.begin(), quiet, levels.end());
  return std::max(*quiet / 0.86, rounded);
}

double floor_noise_mps2(const Dataset& data, const Test& test) {
  if (!test.has_history() || test.motion.degree != 1) return 0;
  const double given = data.noise.floor_acceleration_mps2;
  return given > 0 ? given : sensor_noise(readings_of(test).horizontal_mps2);
}

}  // namespace freestand::measurement
