#include "motion/identify.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "motion/fourier.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "motion/pulse_fit.hpp"
#include "motion/velocity.hpp"

namespace freestand::motion {
namespace {

constexpr double shortest_s = 0.1, longest_s = 15, period_ratio = 1.07;
constexpr std::size_t coarse_points = 2048;

// The record's velocity at coarse steps with its transform, for cross-correlation with every candidate.
struct Coarse {
  double step_s;
  std::vector<double> velocity;
  std::vector<std::complex<double>> spectrum;
  std::size_t size;  // of the transforms: twice the record, so that nothing wraps around
};

Coarse coarse(const FloorMotion& motion, double step_s) {
  Coarse c{step_s, floor_history(motion, step_s).velocity_mps, {}, 0};
  c.size = 2 * transform_size(c.velocity.size());
  c.spectrum = transform(c.velocity, c.size);
  return c;
}

// Best start and amplitude of one pulse at one period: with x the correlation and n the pulse's own sum of squares
// inside the record, the amplitude x/n takes x^2/n off the sum of squares.
PulseFit best_start(const Coarse& c, const Pulse& pulse, double period_s) {
  std::vector<double> shape, energy{0};
  for (double t = 0; t <= pulse.duration && shape.size() < c.velocity.size(); t += c.step_s / period_s) {
    shape.push_back(pulse.at(t).velocity / pulse.velocity_amplitude);
    energy.push_back(energy.back() + shape.back() * shape.back());
  }
  auto spectrum = transform(shape, c.size);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] = c.spectrum[k] * std::conj(spectrum[k]);
  const std::vector<double> correlation = inverse_transform(spectrum, c.size);
  PulseFit best{period_s, 0, 0, 0};
  for (std::size_t lag = 0; lag < c.velocity.size(); ++lag) {
    const double own = energy[std::min(shape.size(), c.velocity.size() - lag)], x = correlation[lag];
    if (own < 0.25 * energy.back()) break;  // most of the pulse would lie behind the record's end
    if (x * x / own <= best.gain) continue;
    best = {period_s, x / own, static_cast<double>(lag) * c.step_s, x * x / own};
  }
  best.gain *= c.step_s;
  return best;
}

PulseFit best_period(const Coarse& c, const Pulse& pulse, double duration_s) {
  PulseFit best;
  const double last = std::min(duration_s, longest_s);
  for (double period = std::max(shortest_s, 6 * c.step_s); period <= last; period *= period_ratio) {
    const PulseFit fit = best_start(c, pulse, period);
    if (fit.gain > best.gain) best = fit;
  }
  return best;
}

}  // namespace

IdentifiedPulse identify_pulse(const FloorMotion& motion) {
  IdentifiedPulse found;
  if (motion.segments() == 0) return found;
  const FloorVelocity velocity(motion);
  const double energy = velocity.energy(), duration = motion.duration_s();
  if (!(energy > 0)) return found;
  const double step = duration / std::min<double>(coarse_points, 8.0 * static_cast<double>(motion.segments()));
  const Coarse c = coarse(motion, step);
  double most = 0;
  for (const char* type : {"A", "B", "C1", "C2"}) {
    const Pulse pulse = find_pulse(type);
    const PulseFit start = best_period(c, pulse, duration);
    if (start.gain <= 0) continue;
    const PulseFit fit = refine(velocity, duration, pulse, start);
    if (fit.gain <= most) continue;
    most = fit.gain;
    found = {type, fit.period_s, fit.velocity_mps, fit.start_s, std::clamp(fit.gain / energy, 0.0, 1.0)};
  }
  return found;
}

}  // namespace freestand::motion
