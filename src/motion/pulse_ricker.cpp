// Symmetric Ricker wavelet, second derivative of a Gaussian, highest in its middle; a negative scale turns it over.
//   a = a_p (1 - 2 z) exp(-z),  v = a_p tau exp(-z),  u = -(a_p T^2 / (2 pi^2)) exp(-z),
//   z = (pi tau / T)^2,  tau = t - 2 T,  0 <= t <= 4 T.
// The wavelet has no end: at two periods from its middle, where it is cut, it has fallen to 6e-16 of its peak.
// Its Fourier spectrum is highest at 1/T.
#include <cmath>

#include "base/units.hpp"
#include "motion/pulse_family.hpp"

namespace freestand::motion::pulse_ricker {
namespace {

constexpr double half_duration = 2;

PulseState state(double t) {
  const double tau = t - half_duration;
  const double z = pi * pi * tau * tau, fall = std::exp(-z);
  return {(1 - 2 * z) * fall, tau * fall, -fall / (2 * pi * pi)};
}

Pulse make(int) {
  const double peak_velocity = std::exp(-0.5) / (pi * std::sqrt(2.0));
  return {.name = "ricker",
          .summary = "symmetric Ricker wavelet, highest in the middle of its four periods",
          .source = "Ricker (1943); Vassiliou & Makris (2011)",
          .duration = 2 * half_duration,
          .velocity_amplitude = peak_velocity,
          .peak_velocity = peak_velocity,
          .peak_displacement = 1 / (2 * pi * pi),
          .segments_per_period = 64,
          .breaks = {0, 2 * half_duration},
          .at = state};
}

const RegisteredPulse here{{.name = "ricker", .aliases = {"ricker_symmetric"}, .make = make}};

}  // namespace
}  // namespace freestand::motion::pulse_ricker
