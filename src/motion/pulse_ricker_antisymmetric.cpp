// Antisymmetric Ricker wavelet, third derivative of a Gaussian.
//   a = (a_p / beta)(x^2 - 3) x exp(-x^2/2),  x = 2 pi tau / (sqrt(3) T),  tau = t - 5 T / 2,  0 <= t <= 5 T,
//   v = (a_p T sqrt(3) / (2 pi beta))(1 - x^2) exp(-x^2/2),  u = (3 a_p T^2 / (4 pi^2 beta)) x exp(-x^2/2),
// beta = 1.3801... = the peak of (3 - x^2) x exp(-x^2/2), at x^2 = 3 - sqrt(6).
// Cut at two and a half periods from its middle, where it has fallen to 8e-16 of its peak.
#include <cmath>

#include "base/units.hpp"
#include "motion/pulse_family.hpp"

namespace freestand::motion::pulse_ricker_antisymmetric {
namespace {

constexpr double half_duration = 2.5;
const double length = std::sqrt(3.0) / (2 * pi);  // tau / x, in periods
const double beta = std::sqrt(6.0) * std::sqrt(3 - std::sqrt(6.0)) * std::exp((std::sqrt(6.0) - 3) / 2);

PulseState state(double t) {
  const double x = (t - half_duration) / length, fall = std::exp(-x * x / 2) / beta;
  return {(x * x - 3) * x * fall, length * (1 - x * x) * fall, length * length * x * fall};
}

Pulse make(int) {
  return {.name = "ricker_antisymmetric",
          .summary = "antisymmetric Ricker wavelet: up, then down",
          .source = "Ricker (1943); Vassiliou & Makris (2011)",
          .duration = 2 * half_duration,
          .velocity_amplitude = length / beta,
          .peak_velocity = length / beta,
          .peak_displacement = length * length * std::exp(-0.5) / beta,
          .segments_per_period = 64,
          .breaks = {0, 2 * half_duration},
          .at = state};
}

const RegisteredPulse here{{.name = "ricker_antisymmetric", .make = make}};

}  // namespace
}  // namespace freestand::motion::pulse_ricker_antisymmetric
