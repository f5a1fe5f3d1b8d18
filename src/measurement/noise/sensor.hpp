// What the noise of a sensor is like, and histories of it turned into independent numbers.
//
//   e_k = w_k + c_k,   w white, of standard deviation `white`;   c correlated in time, of standard deviation `coloured`:
//   c_k = r c_{k-1} + sqrt(1 - r^2) coloured n_k,   r = exp(-dt/correlation_s)
//
// beside which the reading may drift away from zero, evenly in a test, by a slope that differs from test to test.
#pragma once

#include <string>
#include <vector>

namespace freestand::measurement {

struct Sensor {
  double white = 1, coloured = 0, correlation_s = 0;  // [noise units: over what the data set states]
  double drift_per_s = 0;                             // standard deviation of the slopes [noise units/s]
  double size_error = 0;  // standard error of the logarithm of the noise's size; 0: as stated, nothing stood still
  double quiet_s = 0;     // how long nothing moved, in all tests together
  // The power of slow noise, coloured^2 correlation_s, over that of this sensor: equally likely values, ascending, by the likelihood of the
  // stretches. Sixteen seconds hold some fifty correlation times of 0.3 s, and leave it known to a factor of 1.5. None where noise is white.
  std::vector<double> slow_powers = {};

  double size() const;  // of white and coloured noise together
  // Innovations of Kalman's filter over their standard deviations: of noise like this, independent numbers of deviation 1.
  // Linear in the samples.
  void whiten(double* samples, std::size_t count, double dt_s) const;
  void whiten_transposed(double* weights, std::size_t count, double dt_s,
                         std::size_t series = 1) const;  // one behind the other
  // The coloured noise is L n, n independent numbers: L^T weights, whose squares add up to the variance of the weighted sum.
  void colour_transposed(double* weights, std::size_t count, double dt_s) const;
  // With so many times the power of slow noise, the same of fast noise: coloured^2/correlation_s, which neighbouring samples tell.
  Sensor with_slow_power(double times) const;
};

// Equally spaced samples in which nothing but noise changes, about an unknown constant [noise units].
struct QuietStretch {
  std::size_t test = 0;
  double dt_s = 0;
  std::vector<double> samples;
};

// By the likelihood of the stretches, each with a mean of its own (and so of its differences alone). As stated (white, 1),
// unless another size is likelier by more than chance (5 %), or a correlated part beside it; likewise the drift. An
// estimate where none is needed costs little: its standard error. Not below `rounding`, which the steps of the sensor make wherever
// something moves (resolution.hpp) [noise units]: where nothing does it reads one and the same.
Sensor sensor_of(const std::vector<QuietStretch>&, double rounding = 0);

}  // namespace freestand::measurement
