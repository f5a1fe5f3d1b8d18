#include "support/rocking.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"

namespace freestand::test {
namespace {

struct Rule {
  std::vector<double> x, w;
};

// Gauss-Legendre on [0, 1], nodes by Newton's iteration on the Legendre polynomial.
Rule gauss_legendre(int n) {
  Rule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double before = 1, value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-16) break;
    }
    rule.x.push_back(0.5 * (1 - x));
    rule.w.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace

double RockingBlock::restitution() const { return 1 - 1.5 * std::pow(std::sin(alpha_rad), 2); }

double fall_time_s(const RockingBlock& block, double peak_rad, double to_rad) {
  static const Rule rule = gauss_legendre(60);
  const double end = std::sqrt(peak_rad - to_rad);
  double sum = 0;
  for (std::size_t i = 0; i < rule.x.size(); ++i) {
    const double u = end * rule.x[i], half = 0.5 * u * u;
    // cos(A) - cos(B) = 2 sin((A + B)/2) sin((B - A)/2), A = alpha - peak, B = A + u^2
    const double drop = 4 * std::sin(block.alpha_rad - peak_rad + half) * std::sin(half);
    sum += rule.w[i] * 2 * u / std::sqrt(drop);
  }
  return end * sum / block.p_radps;
}

double peak_of(const RockingBlock& block, double at_rad, double rate_radps) {
  const double ratio = rate_radps / block.p_radps;
  return block.alpha_rad - std::acos(std::cos(block.alpha_rad - at_rad) + 0.5 * ratio * ratio);
}

RockingState advance_rocking(const RockingBlock& block, RockingState state, int sign, double t_s, double step_s,
                             const std::function<double(double)>& floor_g) {
  const double p2 = block.p_radps * block.p_radps;
  const auto acceleration = [&](double theta, double a) {
    const double phi = block.alpha_rad - sign * theta;
    return -p2 * (sign * std::sin(phi) + a * std::cos(phi));
  };
  const double h = step_s, a0 = floor_g(t_s), a1 = floor_g(t_s + 0.5 * h), a2 = floor_g(t_s + h);
  const double k1 = acceleration(state.theta, a0), v1 = state.rate;
  const double v2 = state.rate + 0.5 * h * k1, k2 = acceleration(state.theta + 0.5 * h * v1, a1);
  const double v3 = state.rate + 0.5 * h * k2, k3 = acceleration(state.theta + 0.5 * h * v2, a1);
  const double v4 = state.rate + h * k3, k4 = acceleration(state.theta + h * v3, a2);
  state.theta += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
  state.rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  return state;
}

namespace {

// Rocks from time t until the impact, the overturning, or `end`. Returns the time reached; -1: overturned.
double rock_until_impact(const RockingBlock& block, RockingState& state, int sign, double t, double end, double step,
                         const std::function<double(double)>& floor_g, double& peak) {
  while (t < end) {
    const double h = std::min(step, end - t);
    const RockingState next = advance_rocking(block, state, sign, t, h, floor_g);
    peak = std::max(peak, std::abs(next.theta));
    if (std::abs(next.theta) > 0.5 * pi) return -1;
    if (sign * next.theta <= 0 && sign * next.rate < 0) {
      double low = 0, high = h;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (sign * advance_rocking(block, state, sign, t, middle, floor_g).theta > 0 ? low : high) = middle;
      }
      state = advance_rocking(block, state, sign, t, high, floor_g);
      state.theta = 0;
      return t + high;
    }
    state = next;
    t += h;
  }
  return end;
}

// Free rocking from `state`: overturns on this side, or after one impact on the other, or never (impacts take energy).
void finish_freely(const RockingBlock& block, const RockingState& state, int sign, RockingRun& run) {
  const double rotation = sign * state.theta, cos_alpha = std::cos(block.alpha_rad);
  const double energy = 0.5 * std::pow(state.rate / block.p_radps, 2) + std::cos(block.alpha_rad - rotation);
  const bool outward = sign * state.rate >= 0, beyond = rotation > block.alpha_rad;
  if (outward ? (beyond || energy > 1) : (beyond && energy <= 1)) {
    run.overturned = true;
    return;
  }
  if (outward) {
    run.peak_rotation_rad = std::max(run.peak_rotation_rad, peak_of(block, rotation, state.rate));
    return;
  }
  const double other_side = std::pow(block.restitution(), 2) * (energy - cos_alpha) + cos_alpha;
  run.overturned = other_side > 1;
  if (!run.overturned) {
    const double rate = block.p_radps * std::sqrt(2 * std::max(0.0, other_side - cos_alpha));
    run.peak_rotation_rad = std::max(run.peak_rotation_rad, peak_of(block, 0, rate));
  }
}

}  // namespace

RockingRun rock_under_one_sine(const RockingBlock& block, double amplitude_g, double omega_radps, int steps) {
  RockingRun run;
  const double period = 2 * pi / omega_radps, threshold = std::tan(block.alpha_rad), step = period / steps;
  if (amplitude_g <= threshold) return run;
  const auto pulse = [=](double t) { return t <= period ? amplitude_g * std::sin(omega_radps * t) : 0.0; };
  const double uplift = std::asin(threshold / amplitude_g) / omega_radps;
  double t = uplift;
  RockingState state;
  int sign = -1;
  bool resting = false;
  constexpr double least_rate = 1e-7;
  while (t >= 0 && t < period) {
    if (resting) {
      // |a| > g tan(alpha) again: in this half of the sine, or from the uplift of the second half on
      const double second = 0.5 * period + uplift;
      if (std::abs(pulse(t)) <= threshold) t = t < uplift ? uplift : (t < second ? second : period);
      if (t >= period) return run;
      sign = pulse(t + 1e-9) > 0 ? -1 : 1;
      state = {};
      resting = false;
    }
    t = rock_until_impact(block, state, sign, t, period, step, pulse, run.peak_rotation_rad);
    if (t < 0) break;
    if (t < period || state.theta == 0) {
      run.impact_s.push_back(t);
      state.rate *= block.restitution();
      sign = -sign;
      resting = std::abs(state.rate) < least_rate;
    }
  }
  if (t < 0) {
    run.overturned = true;
    return run;
  }
  finish_freely(block, state, sign, run);
  return run;
}

}  // namespace freestand::test
