// Stretches of a measured history in which the block slips one way, read off its smoothed speed.
#pragma once

#include <vector>

#include "measurement/data/dataset.hpp"
#include "measurement/data/smooth.hpp"

namespace freestand::measurement {

struct Slip {
  std::size_t from, to;  // samples [from, to)
  double sigma;          // direction
};

// motion: the slip, smoothed. Slower than least_speed_mps, or turned by more than six times rotation_noise: no slip.
std::vector<Slip> slips(const Test&, const Smooth& motion, double least_speed_mps, double rotation_noise_rad);

}  // namespace freestand::measurement
