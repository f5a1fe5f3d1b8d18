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
constexpr int points_of_known = 256;                           // of a period that is known

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

// The best start of each pulse at a period that is known.
std::vector<PulseFit> starts_at(double period_s, const FloorMotion& motion, const std::vector<Pulse>& pulses) {
  const Octave record = octave(motion, period_s / points_of_known);
  std::vector<PulseFit> best;
  for (const Pulse& pulse : pulses) best.push_back(best_start(record, pulse, period_s));
  return best;
}

std::vector<Pulse> candidates(const KnownPulse& known) {
  std::vector<Pulse> pulses;
  for (const std::string& type : pulse_types())
    if (known.type.empty() || known.type == type) pulses.push_back(find_pulse(type));
  return pulses;
}

}  // namespace

const std::vector<std::string>& pulse_types() {
  static const std::vector<std::string> types = {"A", "B", "C1", "C2"};
  return types;
}

IdentifiedPulse identify_pulse(const FloorMotion& motion, const KnownPulse& known) {
  IdentifiedPulse found{.type = known.type, .period_s = known.period_s.value_or(0)};
  found.type_given = !known.type.empty();
  found.period_given = known.period_s.has_value();
  if (motion.segments() == 0) return found;
  const FloorVelocity velocity(motion);
  const double energy = velocity.energy(), duration = motion.duration_s();
  if (!(energy > 0)) return found;
  const std::vector<Pulse> pulses = candidates(known);
  const std::vector<PulseFit> starts =
      known.period_s ? starts_at(*known.period_s, motion, pulses) : best_starts(motion, pulses);
  double most = 0;
  for (std::size_t k = 0; k < pulses.size(); ++k) {
    if (starts[k].gain <= 0) continue;
    const PulseFit fit = known.period_s ? starts[k] : refine(velocity, duration, pulses[k], starts[k]);
    if (fit.gain <= most) continue;
    most = fit.gain;
    found.type = pulses[k].name;
    found.period_s = fit.period_s;
    found.velocity_mps = fit.velocity_mps;
    found.start_s = fit.start_s;
    found.explained = std::clamp(fit.gain / energy, 0.0, 1.0);
  }
  return found;
}

}  // namespace freestand::motion
