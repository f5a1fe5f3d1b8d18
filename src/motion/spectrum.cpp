#include "motion/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/units.hpp"
#include "motion/channel.hpp"
#include "motion/fourier.hpp"
#include "motion/oscillator.hpp"
#include "motion/peaks.hpp"

namespace freestand::motion {

FourierSpectrum fourier_spectrum(const FloorMotion& motion, double step_s, double padding) {
  const std::vector<double> a = floor_history(motion, step_s).acceleration_mps2;
  const double wanted = std::max(1.0, padding) * static_cast<double>(a.size());
  const std::size_t n = transform_size(static_cast<std::size_t>(std::ceil(wanted)));
  FourierSpectrum spectrum;
  spectrum.step_hz = 1 / (static_cast<double>(n) * step_s);
  for (const auto& bin : RealTransform(n).forward(a)) spectrum.amplitude_mps.push_back(std::abs(bin) * step_s);
  return spectrum;
}

double spectral_displacement_m(const FloorMotion& motion, double period_s, double damping) {
  if (!(period_s > 0) || !std::isfinite(period_s))
    throw Error(fmt::format("no spectrum at period {} s (not a positive number): give a period above 0", period_s));
  if (!(damping >= 0 && damping < 1))
    throw Error(fmt::format("no spectrum with damping ratio {} (outside [0, 1)): 0.05 is usual", damping));
  Oscillator oscillator(2 * pi / period_s, damping);
  OscillatorState state;
  double peak = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i)
    state = oscillator.advance(segment(motion, motion.horizontal_mps2, i), length(motion, i), state, peak);
  return std::max(peak, oscillator.free_peak(state));
}

double spectral_velocity_mps(const FloorMotion& motion, double period_s, double damping) {
  return 2 * pi / period_s * spectral_displacement_m(motion, period_s, damping);
}

double spectral_acceleration_mps2(const FloorMotion& motion, double period_s, double damping) {
  return 2 * pi / period_s * spectral_velocity_mps(motion, period_s, damping);
}

// Of a(t / s) the pseudo-velocity at period T is s times that of a(t) at period T / s.
double housner_intensity_m(const FloorMotion& motion, double stretch) {
  constexpr int steps = 120;
  constexpr double first = 0.1, last = 2.5, step = (last - first) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double period = first + step * i;
    const double velocity = stretch * spectral_velocity_mps(motion, period / stretch);
    sum += i == 0 || i == steps ? velocity / 2 : velocity;
  }
  return sum * step;
}

}  // namespace freestand::motion
