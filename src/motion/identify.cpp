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

constexpr double shortest_s = 0.2, longest_s = 15;
constexpr int periods_per_octave = 9, points_per_period = 16;  // at the short end of an octave

// The record's velocity at the steps of one octave of periods, with its transform.
struct Octave {
  double step_s;
  std::vector<double> velocity;
  RealTransform transform;  // twice as long as the record, so that nothing wraps around
  RealTransform::Spectrum spectrum;
};

Octave octave(const FloorMotion& motion, double step_s) {
  std::vector<double> velocity = floor_history(motion, step_s).velocity_mps;
  RealTransform transform(2 * transform_size(velocity.size()));
  RealTransform::Spectrum spectrum = transform.forward(velocity);
  return {step_s, std::move(velocity), std::move(transform), std::move(spectrum)};
}

// Best start and amplitude of one pulse at one period: with x the correlation and n the pulse's own sum of squares
// inside the record, the amplitude x/n takes x^2/n off the sum of squares.
PulseFit best_start(const Octave& record, const Pulse& pulse, double period_s) {
  std::vector<double> shape, energy{0};
  const std::size_t size = record.velocity.size();
  for (double t = 0; t <= pulse.duration && shape.size() < size; t += record.step_s / period_s) {
    shape.push_back(pulse.at(t).velocity / pulse.velocity_amplitude);
    energy.push_back(energy.back() + shape.back() * shape.back());
  }
  auto spectrum = record.transform.forward(shape);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] = record.spectrum[k] * std::conj(spectrum[k]);
  const std::vector<double> correlation = record.transform.inverse(spectrum);
  PulseFit best{period_s, 0, 0, 0};
  for (std::size_t lag = 0; lag < size; ++lag) {
    const double own = energy[std::min(shape.size(), size - lag)], x = correlation[lag];
    if (own < 0.25 * energy.back()) break;  // most of the pulse would lie behind the record's end
    if (x * x > best.gain * own) best = {period_s, x / own, static_cast<double>(lag) * record.step_s, x * x / own};
  }
  best.gain *= record.step_s;
  return best;
}

// Best start of each pulse over all periods, octave by octave: long periods need no fine steps.
std::vector<PulseFit> best_starts(const FloorMotion& motion, const std::vector<Pulse>& pulses) {
  std::vector<PulseFit> best(pulses.size());
  const double last = std::min(motion.duration_s(), longest_s);
  for (double first = std::min(shortest_s, last / 4); first <= last; first *= 2) {
    const Octave record = octave(motion, first / points_per_period);
    for (int i = 0; i < periods_per_octave; ++i) {
      const double period = first * std::exp2(static_cast<double>(i) / periods_per_octave);
      if (period > last) break;
      for (std::size_t k = 0; k < pulses.size(); ++k) {
        const PulseFit fit = best_start(record, pulses[k], period);
        if (fit.gain > best[k].gain) best[k] = fit;
      }
    }
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
  const std::vector<Pulse> pulses = {find_pulse("A"), find_pulse("B"), find_pulse("C1"), find_pulse("C2")};
  const std::vector<PulseFit> starts = best_starts(motion, pulses);
  double most = 0;
  for (std::size_t k = 0; k < pulses.size(); ++k) {
    if (starts[k].gain <= 0) continue;
    const PulseFit fit = refine(velocity, duration, pulses[k], starts[k]);
    if (fit.gain <= most) continue;
    most = fit.gain;
    found = {pulses[k].name, fit.period_s, fit.velocity_mps, fit.start_s, std::clamp(fit.gain / energy, 0.0, 1.0)};
  }
  return found;
}

}  // namespace freestand::motion
