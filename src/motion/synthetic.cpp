#include "motion/synthetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <freestand/error.hpp>

#include "base/units.hpp"
#include "motion/filtered_noise.hpp"
#include "motion/gamma_envelope.hpp"
#include "motion/pulse.hpp"

namespace freestand::motion {
namespace {

constexpr double left_out = 1e-5;  // of the Arias intensity
constexpr double at_rest =
    16.7;  // w_c t after which a free critically damped oscillator has (1 + w_c t) exp(-w_c t) = 1e-6

// Above the filter's frequency f its spectrum falls as (f/frequency)^-4, to 1/256 of it where the samples end (half of their
// rate), beyond which it would be folded back.
constexpr double highest_frequency_steps = 1.0 / 8;

constexpr std::size_t most_samples = 200'000;  // some megabytes a motion, each held in memory

GammaEnvelope envelope_of(const SyntheticParameters& p) { return {p.arias_mps, p.duration_s, p.middle_s}; }

// Of the filter, at any time.
struct Frequency {
  explicit Frequency(const SyntheticParameters& p)
      : parameters(p), from_s(envelope_of(p).time_of_share(0.01)), to_s(envelope_of(p).time_of_share(0.99)) {}
  double operator()(double t) const {
    return parameters.frequency_hz +
           parameters.frequency_slope_hzps * (std::clamp(t, from_s, to_s) - parameters.middle_s);
  }
  const SyntheticParameters& parameters;
  double from_s, to_s;
};

double pulse_length_s(const SyntheticPulse& pulse) { return find_pulse(pulse.type).duration * pulse.period_s; }
double pulse_start_s(const SyntheticPulse& pulse) { return pulse.middle_s - pulse_length_s(pulse) / 2; }

// The samples of z'' under a line from sample to sample, exact at the samples, by the power series of each step.
std::vector<double> high_passed(const std::vector<double>& x, double corner_hz, double step_s, std::size_t count) {
  constexpr std::size_t terms = 18;  // w_c step < 0.8, so that the last one is below 1e-17
  const double w = 2 * pi * corner_hz;
  const auto input = [&](std::size_t j) { return j < x.size() ? x[j] : 0.0; };
  std::vector<double> acceleration;
  std::array<double, terms + 2> y{};  // z = sum y_n t^n within the step
  for (std::size_t j = 0; j < count; ++j) {
    acceleration.push_back(input(j) - 2 * w * y[1] - w * w * y[0]);
    const std::array<double, 2> line = {input(j), (input(j + 1) - input(j)) / step_s};
    for (std::size_t n = 0; n < terms; ++n) {
      const double forced = n < 2 ? line[n] : 0, order = static_cast<double>(n);
      y[n + 2] = (forced - 2 * w * (order + 1) * y[n + 1] - w * w * y[n]) / ((order + 1) * (order + 2));
    }
    double z = 0, rate = 0;
    for (std::size_t n = terms + 1; n > 0; --n) {
      z = z * step_s + y[n];
      rate = rate * step_s + static_cast<double>(n) * y[n];
    }
    y[0] += z * step_s;
    y[1] = rate;
  }
  return acceleration;
}

void add_pulse(const SyntheticPulse& part, double step_s, std::vector<double>& acceleration) {
  const Pulse pulse = find_pulse(part.type);
  const double peak = acceleration_of_peak_velocity(pulse, part.peak_velocity_mps, part.period_s);
  const double start = pulse_start_s(part), period = part.period_s;
  const auto displacement = [&](double t) {
    const double at = (t - start) / period, within = std::clamp(at, 0.0, pulse.duration);
    const PulseState state = pulse.at(within);
    return peak * period * period * (at <= 0 ? 0 : state.displacement + (at - within) * state.velocity);
  };
  for (std::size_t j = 1; j < acceleration.size(); ++j) {
    const double t = static_cast<double>(j) * step_s;
    if (t < start - step_s || t > start + pulse_length_s(part) + step_s) continue;
    acceleration[j] += (displacement(t + step_s) - 2 * displacement(t) + displacement(t - step_s)) / (step_s * step_s);
  }
}

// Of the whole motion: noise, and what comes after it.
std::size_t samples_of(const SyntheticParameters& p) {
  double end_s = envelope_of(p).time_of_share(1 - left_out) + at_rest / (2 * pi * p.corner_hz);
  if (p.pulse) end_s = std::max(end_s, pulse_start_s(*p.pulse) + pulse_length_s(*p.pulse) + p.step_s);
  return static_cast<std::size_t>(std::ceil(end_s / p.step_s)) + 1;
}

std::string refused_frequency(const SyntheticParameters& p) {
  const Frequency frequency(p);
  const double highest = highest_frequency_steps / p.step_s;
  for (const double t : {frequency.from_s, frequency.to_s}) {
    const double f = frequency(t);
    const char* key = p.frequency_slope_hzps != 0 ? "frequency_slope_hzps" : "frequency_hz";
    if (f > highest)
      return fmt::format(
          "a filter at {:.3g} Hz at {:.3g} s (samples every {:g} s hold a spectrum about {:g} Hz at most): lower {}, "
          "or "
          "step_s",
          f, t, p.step_s, highest, key);
    if (f <= p.corner_hz)
      return fmt::format(
          "a filter at {:.3g} Hz at {:.3g} s (corner_hz, {:g}, takes away all below it): correct {}, or lower "
          "corner_hz",
          f, t, p.corner_hz, key);
  }
  return "";
}

}  // namespace

std::string refusal(const SyntheticParameters& p) {
  try {
    envelope_of(p);
  } catch (const Error& error) {
    return error.what();
  }
  if (const std::string why = refused_frequency(p); !why.empty()) return why;
  if (p.pulse && pulse_start_s(*p.pulse) < p.step_s)
    return fmt::format(
        "a pulse from {:.3g} s on (it lasts {:.3g} s, and the floor is at rest before 0): raise pulse.middle_s to "
        "{:.3g} at least",
        pulse_start_s(*p.pulse), pulse_length_s(*p.pulse), pulse_length_s(*p.pulse) / 2 + p.step_s);
  if (p.pulse) {
    const Pulse pulse = find_pulse(p.pulse->type);
    if (const double leaving = pulse.at(pulse.duration).velocity; std::abs(leaving) > 1e-9 * pulse.peak_velocity)
      return fmt::format("a pulse {} (it leaves the floor moving, for ever): name another type", pulse.name);
  }
  if (samples_of(p) > most_samples)
    return fmt::format(
        "a motion of {} samples (each is held in memory, {} at most): lower duration_s or middle_s, or "
        "raise step_s or corner_hz",
        samples_of(p), most_samples);
  return "";
}

std::size_t noise_samples(const SyntheticParameters& p) {
  return static_cast<std::size_t>(std::ceil(envelope_of(p).time_of_share(1 - left_out) / p.step_s)) + 1;
}

FloorMotion synthetic_motion(const SyntheticParameters& p, const std::vector<double>& white, std::string name) {
  if (const std::string why = refusal(p); !why.empty()) throw Error(name + " is " + why);
  const GammaEnvelope envelope = envelope_of(p);
  const Frequency frequency(p);
  std::vector<double> frequencies;
  for (std::size_t i = 0; i < white.size(); ++i) frequencies.push_back(frequency(static_cast<double>(i) * p.step_s));
  std::vector<double> x = filtered_noise(frequencies, p.bandwidth, p.step_s, white);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= envelope(static_cast<double>(i) * p.step_s);
  std::vector<double> acceleration = high_passed(x, p.corner_hz, p.step_s, samples_of(p));
  if (p.pulse) add_pulse(*p.pulse, p.step_s, acceleration);
  return piecewise_linear(std::move(name), p.step_s, acceleration);
}

}  // namespace freestand::motion
