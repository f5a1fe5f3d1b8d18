// Speed and acceleration of a measured displacement, by quadratics fitted to the samples around each instant (Savitzky &
// Golay, Anal. Chem. 36, 1964).
#pragma once

#include <cstddef>
#include <vector>

namespace freestand::measurement {

struct Smooth {
  std::vector<double> value, rate, second;  // [m], [m/s], [m/s2] of a displacement in metres
  std::size_t half = 0;                     // samples to either side in a window

  // The rate where the nearest full window stands: extrapolated to both ends it has many times the noise.
  double firm_rate(std::size_t i) const;
};

// Windows are times, so that what is found does not hang on the rate of the samples. half_window_s: to either side. At
// both ends the last full window is extrapolated. Less than a window of samples: zeros.
Smooth smooth(const std::vector<double>& samples, double dt_s, double half_window_s);

// Samples to either side in such a window; at least two, since a quadratic goes through any three.
std::size_t half_window_samples(double half_window_s, double dt_s);

// Standard deviations of rate and second that white noise of 1 on the samples makes.
double rate_noise(double dt_s, double half_window_s);
double second_noise(double dt_s, double half_window_s);

}  // namespace freestand::measurement
