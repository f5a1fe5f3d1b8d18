#include "hidden_effect/shaking.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"

namespace freestand::test {
namespace {

using Samples = std::vector<double>;

void to_unit_peak(Samples& a) {
  double peak = 0;
  for (const double value : a) peak = std::max(peak, std::abs(value));
  for (double& value : a) value /= peak;
}

// x'' + 2 z w x' + w^2 x = -n: what the ground passes on is -(2 z w x' + w^2 x).
Samples filtered_noise(KeyedRandom& random, double frequency_hz, double damping, double dt_s, std::size_t samples) {
  const double w = 2 * pi * frequency_hz;
  double x = 0, v = 0;
  Samples a(samples);
  for (double& value : a) {
    v -= dt_s * (random.normal() + 2 * damping * w * v + w * w * x);
    x += dt_s * v;
    value = 2 * damping * w * v + w * w * x;
  }
  return a;
}

void high_pass(Samples& a, double corner_hz, double dt_s) {
  const double keep = 1 / (1 + 2 * pi * corner_hz * dt_s);
  double before = 0, passed = 0;
  for (double& value : a) {
    passed = keep * (passed + value - before);
    before = value;
    value = passed;
  }
}

void low_pass(Samples& a, double corner_hz, double dt_s) {
  const double take = 1 - 1 / (1 + 2 * pi * corner_hz * dt_s);
  double passed = 0;
  for (double& value : a) value = passed += take * (value - passed);
}

struct Envelope {
  double rise_s, hold_s, decay_per_s;
  double operator()(double t) const {
    if (t < rise_s) return t * t / (rise_s * rise_s);
    return t < rise_s + hold_s ? 1 : std::exp(-decay_per_s * (t - rise_s - hold_s));
  }
};

Envelope draw_envelope(KeyedRandom& random, double length_s) {
  Envelope e{};
  e.rise_s = length_s * random.uniform(0.08, 0.2);
  e.hold_s = length_s * random.uniform(0.1, 0.35);
  e.decay_per_s = random.uniform(3, 5) / (length_s - e.rise_s - e.hold_s);
  return e;
}

Samples stochastic(KeyedRandom& random, double ground_hz, double corner_hz, double dt_s, std::size_t samples) {
  Samples a = filtered_noise(random, ground_hz, random.uniform(0.2, 0.6), dt_s, samples);
  for (int pass = 0; pass < 2; ++pass) high_pass(a, corner_hz, dt_s), low_pass(a, 15, dt_s);
  const Envelope envelope = draw_envelope(random, dt_s * static_cast<double>(samples));
  for (std::size_t i = 0; i < samples; ++i) a[i] *= envelope(dt_s * static_cast<double>(i));
  to_unit_peak(a);
  return a;
}

// One of the four, as a function of time from its start.
struct Pulse {
  int form;
  double period_s, cycles;
  double length_s() const { return form < 2 ? period_s : form == 2 ? 2 * period_s : cycles * period_s; }
  double operator()(double t) const {
    if (t < 0 || t > length_s()) return 0;
    const double phase = 2 * pi * t / period_s;
    if (form == 0) return std::sin(phase);
    if (form == 1) return std::cos(phase);
    const double x = pi * (t / period_s - 1);
    if (form == 2) return (1 - 2 * x * x) * std::exp(-x * x);
    return std::sin(phase) * 0.5 * (1 - std::cos(phase / cycles));
  }
};

Pulse draw_pulse(KeyedRandom& random, const ShakingRange& range) {
  Pulse pulse{};
  pulse.form = static_cast<int>(4 * random.unit());
  pulse.period_s = random.log_uniform(range.period_low_s, range.period_high_s);
  pulse.cycles = random.chance(0.5) ? 2 : 3;
  return pulse;
}

void add(Samples& a, const Pulse& pulse, double factor, double start_s, double dt_s) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * pulse(dt_s * static_cast<double>(i) - start_s);
}

}  // namespace

Samples draw_shaking(KeyedRandom& random, Shaking kind, const ShakingRange& range, double dt_s, double duration_s) {
  const bool alone = kind == Shaking::pulse;
  const double length_s = duration_s * (alone ? random.uniform(0.3, 0.45) : random.uniform(0.6, 1.5));
  Samples a(static_cast<std::size_t>(length_s / dt_s));
  if (!alone) {
    const double ground_hz = random.log_uniform(range.ground_low_hz, range.ground_high_hz);
    a = stochastic(random, ground_hz, random.uniform(0.15, 0.5), dt_s, a.size());
  }
  if (kind != Shaking::stochastic) {
    const Pulse pulse = draw_pulse(random, range);
    const double factor = (random.chance(0.5) ? 1 : -1) * (alone ? 1 : random.uniform(0.7, 1.5));
    add(a, pulse, factor, alone ? 0.5 : length_s * random.uniform(0.1, 0.4), dt_s);
  }
  to_unit_peak(a);
  return a;
}

Samples draw_vertical(KeyedRandom& random, double dt_s, std::size_t samples) {
  return stochastic(random, random.log_uniform(3, 12), 0.5, dt_s, samples);
}

}  // namespace freestand::test
