#include "measurement/noise/between_readings.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/data/ground.hpp"

namespace freestand::measurement {
namespace {

std::vector<double> thinned(std::vector<double> readings, std::size_t first) {
  for (std::size_t i = first; i + 1 < readings.size(); i += 2)
    if (i > 0) readings[i] = 0.5 * (readings[i - 1] + readings[i + 1]);
  return readings;
}

// Mean square by which lines between readings that are so many steps off miss those in the middle, without what noise adds.
double missed(const std::vector<double>& readings, std::size_t steps, double noise) {
  double sum = 0, count = 0;
  for (std::size_t i = steps; i + steps < readings.size(); ++i, ++count)
    sum += std::pow(readings[i] - 0.5 * (readings[i - steps] + readings[i + steps]), 2);
  return count > 0 ? std::max(0.0, sum / count - 1.5 * noise * noise) : 0;
}

}  // namespace

BetweenReadings between_readings(const FloorMotion& motion, double noise_mps2) {
  if (motion.degree != 1 || motion.segments() < 4) return {};
  const auto horizontal = motion_samples(motion, motion.horizontal_mps2),
             vertical = motion_samples(motion, motion.vertical_mps2);
  BetweenReadings found;
  for (const std::size_t first : {1U, 2U})
    found.thinned.push_back(piecewise_linear(motion.name, motion.knot_s[1] - motion.knot_s[0],
                                             thinned(horizontal, first), thinned(vertical, first)));
  // What steps of 2 h miss over what h misses, as errors of histories go: 4 where the floor is smooth.
  const double by_one = missed(horizontal, 1, noise_mps2), by_two = missed(horizontal, 2, noise_mps2);
  const double ratio = by_one > 0 ? std::sqrt(by_two / by_one) : 4;
  found.share = 1 / (std::clamp(ratio, 2.0, 4.0) - 1);
  return found;
}

}  // namespace freestand::measurement
