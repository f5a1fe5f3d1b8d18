#include "motion/oscillator.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"

namespace freestand::motion {
namespace {

constexpr double substep_rad = 0.5;  // longest w t between two looks at the velocity: the Taylor series below needs it
constexpr double series_rad = 4;     // up to here the power series loses less than the particular polynomial

// Coefficients of a(offset + t) in powers of t.
Polynomial shifted(Polynomial a, double offset) {
  for (int i = 0; i < a.degree; ++i)
    for (int k = a.degree - 1; k >= i; --k)
      a.c[static_cast<std::size_t>(k)] += offset * a.c[static_cast<std::size_t>(k) + 1];
  return a;
}

}  // namespace

// Response from rest to the input t^k.
OscillatorState Oscillator::power_response(int k, double t, const Map& free) const {
  const double w2 = w_ * w_, drag = 2 * z_ * w_;
  OscillatorState at;
  if (w_ * t <= series_rad) {  // u = sum y_j t^j,  (j+1)(j+2) y_(j+2) = -[j = k] - 2 z w (j+1) y_(j+1) - w^2 y_j
    double y0 = 0, y1 = 0, last = 0, power = std::pow(t, k);
    for (int j = k; j < k + 60; ++j) {
      const double y2 = (-(j == k ? 1.0 : 0.0) - drag * (j + 1) * y1 - w2 * y0) / ((j + 1.0) * (j + 2.0));
      at.v += (j + 2) * y2 * power * t;
      const double term = y2 * power * t * t;
      at.u += term;
      const double size = std::abs(term) * (j + 2), enough = 1e-20 * std::abs(at.u);
      if (j > k + 4 && size < enough && last < enough) break;  // every other term is 0 without damping
      last = size;
      y0 = y1;
      y1 = y2;
      power *= t;
    }
    return at;
  }
  Polynomial p;  // particular solution, downwards from p_k = -1/w^2; the free motion takes its start away
  p.degree = k;
  for (int j = k; j >= 0; --j) {
    const auto i = static_cast<std::size_t>(j);
    p.c[i] = (-(j == k ? 1.0 : 0.0) - (j < k ? drag * (j + 1) * p.c[i + 1] : 0) -
              (j + 1 < k ? (j + 2.0) * (j + 1.0) * p.c[i + 2] : 0)) /
             w2;
  }
  const double u0 = p.c[0], v0 = k > 0 ? p.c[1] : 0;
  return {p(t) - free.uu * u0 - free.uv * v0, derivative(p)(t) - free.vu * u0 - free.vv * v0};
}

Oscillator::Map Oscillator::map_at(double t, int degree) const {
  const double wd = w_ * std::sqrt(1 - z_ * z_);
  const double fall = std::exp(-z_ * w_ * t), c = fall * std::cos(wd * t), s = fall * std::sin(wd * t) / wd;
  Map map{c + z_ * w_ * s, s, -w_ * w_ * s, c - z_ * w_ * s, {}};
  for (int k = 0; k <= degree; ++k) map.forced[static_cast<std::size_t>(k)] = power_response(k, t, map);
  return map;
}

OscillatorState Oscillator::apply(const Map& map, const Polynomial& a, OscillatorState from) const {
  OscillatorState to{map.uu * from.u + map.uv * from.v, map.vu * from.u + map.vv * from.v};
  for (std::size_t k = 0; k <= static_cast<std::size_t>(a.degree); ++k) {
    to.u += map.forced[k].u * a.c[k];
    to.v += map.forced[k].v * a.c[k];
  }
  return to;
}

// The solution's Taylor series from `offset` on, and its peak within the substep (error below 1e-12 of |u|).
double Oscillator::peak_between(const Polynomial& a, double offset, double step, OscillatorState from) const {
  const Polynomial input = shifted(a, offset);
  Polynomial u;
  u.degree = Polynomial::max_degree;
  u.c[0] = from.u;
  u.c[1] = from.v;
  for (std::size_t j = 0; j + 2 <= static_cast<std::size_t>(u.degree); ++j) {
    const double n = static_cast<double>(j);
    u.c[j + 2] = (-input.c[j] - 2 * z_ * w_ * (n + 1) * u.c[j + 1] - w_ * w_ * u.c[j]) / ((n + 1) * (n + 2));
  }
  return motion::peak(u, step);
}

OscillatorState Oscillator::advance(const Polynomial& a, double length, OscillatorState from, double& peak) {
  if (std::abs(length - length_) > 1e-11 * length || a.degree != degree_) {
    const int count = std::max(1, static_cast<int>(std::ceil(w_ * length / substep_rad)));
    maps_.clear();
    for (int i = 1; i <= count; ++i) maps_.push_back(map_at(length * i / count, a.degree));
    length_ = length;
    degree_ = a.degree;
  }
  const double step = length / static_cast<double>(maps_.size());
  const auto acceleration = [&](double t, OscillatorState s) { return -a(t) - 2 * z_ * w_ * s.v - w_ * w_ * s.u; };
  OscillatorState here = from;
  double pull = acceleration(0, here);
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const double offset = step * static_cast<double>(i);
    const OscillatorState next = apply(maps_[i], a, from);
    const double next_pull = acceleration(offset + step, next);
    const double ends = std::max(std::abs(here.u), std::abs(next.u));
    peak = std::max(peak, ends);
    const double reach = step * (std::abs(here.v) + std::abs(next.v) + step * (std::abs(pull) + std::abs(next_pull)));
    const bool may_turn = here.v * next.v <= 0 || pull * next_pull <= 0;
    if (may_turn && ends + reach > peak) peak = std::max(peak, peak_between(a, offset, step, here));
    here = next;
    pull = next_pull;
  }
  return here;
}

OscillatorState Oscillator::after(const Polynomial& a, double length, OscillatorState from) {
  if (std::abs(length - whole_length_) > 1e-11 * length || a.degree != whole_degree_) {
    whole_ = map_at(length, a.degree);
    whole_length_ = length;
    whole_degree_ = a.degree;
  }
  return apply(whole_, a, from);
}

double Oscillator::free_peak(OscillatorState from) const {
  const double wd = w_ * std::sqrt(1 - z_ * z_);
  double angle = std::atan2(from.v * wd, w_ * w_ * from.u + z_ * w_ * from.v);  // of the first zero of v
  if (angle < 0) angle += pi;
  const Map map = map_at(angle / wd, -1);
  return std::max(std::abs(from.u), std::abs(map.uu * from.u + map.uv * from.v));
}

}  // namespace freestand::motion
