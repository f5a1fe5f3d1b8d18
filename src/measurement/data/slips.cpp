#include "measurement/data/slips.hpp"

#include <cmath>

namespace freestand::measurement {

std::vector<Slip> slips(const Test& test, const Smooth& motion, double least_speed_mps, double rotation_noise_rad) {
  std::vector<Slip> found;
  const auto direction = [&](std::size_t i) {
    const bool turned = !test.rotation_rad.empty() && std::abs(test.rotation_rad[i]) > 6 * rotation_noise_rad;
    const double rate = motion.firm_rate(i);
    return turned || std::abs(rate) < least_speed_mps ? 0.0 : rate > 0 ? 1.0 : -1.0;
  };
  for (std::size_t i = 0; i < motion.rate.size(); ++i) {
    const double sigma = direction(i);
    if (sigma == 0) continue;
    if (!found.empty() && found.back().to == i && found.back().sigma == sigma)
      ++found.back().to;
    else
      found.push_back({i, i + 1, sigma});
  }
  return found;
}

}  // namespace freestand::measurement
