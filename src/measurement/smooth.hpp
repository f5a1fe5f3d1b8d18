// Speed and acceleration of a measured displacement, by quadratics fitted to the samples around each instant (Savitzky &
// Golay, Anal. Chem. 36, 1964).
#pragma once

#include <cstddef>
#include <vector>

namespace freestand::measurement {

struct Smooth {
  std::vector<double> value, rate, second;  // [m], [m/s], [m/s2] of a displacement in metres
};

// half: samples to either side. At both ends the last full window is extrapolated. Fewer than 2 half + 1 samples: zeros.
Smooth smooth(const std::vector<double>& samples, double dt_s, std::size_t half);

// Standard deviations of rate and second that white noise of 1 on the samples makes.
double rate_noise(double dt_s, std::size_t half);
double second_noise(double dt_s, std::size_t half);

}  // namespace freestand::measurement
