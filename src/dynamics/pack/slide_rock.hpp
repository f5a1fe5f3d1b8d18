// Slide-rock, one sample by itself: one Taylor step per knot interval without sines, polynomials as their own dense
// output, and mode changes decided from the values at the instant (who was violated says what cannot follow). Whatever is
// not decided beyond doubt - a corner that lifts off, Painleve's paradox - is declined and left to the general text
// (dynamics/mode_logic.hpp). Intervals of rocking in which nothing happens go in packs (dynamics/pack/slide_rock_pool.hpp).
#pragma once

#include <cmath>

#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/polynomial_root.hpp"
#include "dynamics/pack/slide_rock_sliding.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Orders of the steps that rock, and that slip.
template <int N, int M, class Gravity>
class SlideRock : public SlideRockSliding {
 public:
  using SlideRockSliding::SlideRockSliding;

  void begin() {
    stand_at_knot();
    if (magnitude(a_) > quiet(a_, g_)) {
      event();
      choose_flat();
    }
    if (!in_a_group()) go_on();
  }

  void strike_at(const Impact& impact) {
    see_rotation(impact.turned);
    see_slip(impact.slid);
    theta_ = 0;
    omega_ = side_ * impact.rate / h_;
    see_slip(xi_);
    forward(impact.part);
    strike();
    settle();
  }

  // After a part x of what is left of the interval the slip ends, or the stay on the corner.
  void end_slip(double x, bool impact) {
    if (impact) theta_ = 0;
    if (!impact) w_ = 0;
    forward(x);
    if (impact) {
      strike();
    } else {
      event();
      if (mode_ == Mode::slide)
        choose_flat();
      else
        choose_on_corner();
    }
    settle();
  }

  // Back from the hops, at rest or not.
  void settle() {
    if (mode_ == Mode::rest) choose_flat();
    while (!ended() && !in_a_group()) step();
  }

  // Step by step, one at least, until the packs can take it, or to its end.
  void go_on() {
    do step();
    while (!ended() && !in_a_group());
  }

 private:
  bool in_a_group() const { return marches() || slips() || slides(); }

  void step() {
    switch (mode_) {
      case Mode::rest:
        rest();
        break;
      case Mode::slide:
        slide();
        break;
      case Mode::rock:
        corner<N, false>();
        break;
      default:
        corner<M, true>();
    }
  }

  // ---- one corner
  template <int K, bool slips>
  void corner() {
    const double hs = h_ * fraction_, hs2 = hs * hs;
    const Field next{next_floor(), Gravity::shaken ? next_gravity() : c_.g, 0};
    CornerSeries<K> y;
    y.theta[0] = theta_;
    y.omega[0] = omega_ * hs;
    y.rx[0] = rx_;
    y.ry[0] = ry_;
    y.xi[0] = xi_;
    y.w[0] = w_ * hs;
    const Forces begin = forces(rx_, ry_, omega_, field(), w_);
    if (!(begin.fy > 0)) return decline();
    if constexpr (slips) {
      slide_rock(y, hs, next);
    } else {
      const double over = hs2 / (c_.k2 + rx_ * rx_ + ry_ * ry_);
      auto pull = pull_within<K>(hs);
      if constexpr (Gravity::shaken)
        y.rock(Straight<double>{g_, next.g - g_} * over, a_ * over, (next.a - a_) * over, pull, over);
      else
        y.rock(c_.g * over, a_ * over, (next.a - a_) * over, pull, over);
    }
    // Which comes first?
    const double reach = valid_part(y.omega[K + 1], y.w[K + 1], K + 1, slips && c_.law);
    if (reach == 0) return decline();
    double x = reach;
    Cause cause = Cause::none;
    double p[K + 2];
    for (int k = 0; k < K + 2; ++k) p[k] = side_ * y.theta[k];
    // Rig's force_zero, as a rotation.
    if (p[0] == 0 && p[1] == 0 && p[2] < 0 && p[2] > -1e-11 * c_.g * hs2 / c_.h) p[2] = 0;
    const double falls = first_fall<K + 1>(p, reach);
    if (falls <= reach) x = falls, cause = Cause::impact;
    if (slips) {
      for (int k = 0; k < K + 2; ++k) p[k] = sigma_ * y.w[k];
      if (p[0] == 0 && p[1] < 0 && p[1] > -slip_zero * c_.g * hs2) p[1] = 0;
      const double stops = first_fall<K + 1>(p, x);
      if (stops <= x) x = stops, cause = Cause::stop;
    } else {
      const double held = grip(y, x, hs, next);
      if (held < 0)
        x = lost_grip(y, x, hs, next, held), cause = Cause::grip;
      else if (const double low = weakest(y, x, hs, next, begin, held); low < x)
        x = lost_grip(y, low, hs, next, grip(y, low, hs, next)), cause = Cause::grip;
    }
    const double theta = value(y.theta, x), omega = value(y.omega, x) / hs;
    if (!(side_ * theta < 0.5 * pi)) {
      if (side_ * theta >= 0.5 * pi) return overturn(y, x, hs, next);
      return decline();
    }
    if (x > 0 || cause != Cause::grip) watch(y, x, hs, next, begin);  // else the corner never stuck
    if (declined_) return;
    theta_ = theta;
    omega_ = omega;
    rx_ = value(y.rx, x);
    ry_ = value(y.ry, x);
    if (slips) {
      const double xi = value(y.xi, x);
      slid(xi - xi_);
      xi_ = xi;
      w_ = value(y.w, x) / hs;
    }
    forward(x);
    switch (cause) {
      case Cause::none:
        break;
      case Cause::impact:
        strike();
        break;
      case Cause::stop:
        event();
        w_ = 0;
        choose_on_corner();
        break;
      case Cause::grip:
        event();
        slip_on_corner(rocking(rx_, ry_, omega_, field()).fx);
        break;
    }
  }

  template <int K>
  void slide_rock(CornerSeries<K>& y, double hs, Field next) const {
    const double hs2 = hs * hs, sigma_mu = sigma_ * c_.mu_k;
    auto pull = pull_within<K>(hs);
    if (c_.law) {
      OwnFactor<K> factor(*c_.law, {*c_.law, path_, sigma_}, sigma_);
      y.slide_rock(c_.g * hs2, a_ * hs2, (next.a - a_) * hs2, c_.k2, sigma_mu, sigma_ / hs, factor, pull, hs2);
    } else {
      NoFactor none;
      const double a1 = (next.a - a_) * hs2;
      if constexpr (Gravity::shaken)
        y.slide_rock(Straight<double>{g_, next.g - g_} * hs2, a_ * hs2, a1, c_.k2, sigma_mu, 0.0, none, pull, hs2);
      else
        y.slide_rock(c_.g * hs2, a_ * hs2, a1, c_.k2, sigma_mu, 0.0, none, pull, hs2);
    }
  }

  template <int K>
  auto pull_within(double hs) const {
    if constexpr (Gravity::pulls)
      return Pull<K, double>{c_.stiffness, c_.drag / hs, lever() * arm(side_), lever() * c_.h,
                             xi_ + side_ * half_base_ * versine(theta_)};
    else
      return NoPull{};
  }

  // By how much the pull leaves its chord within the step, at most [m/s2]: u = xi + s B (1 - cos theta).
  template <int K>
  double pull_bends(const CornerSeries<K>& y, double hs) const {
    const auto u = [&](int k) { return y.xi[k] - lever() * (c_.h * y.ry[k] - arm(side_) * y.rx[k]); };
    double sum = 0;
    for (int k = 2; k < K; ++k) sum += magnitude(c_.stiffness * u(k) + c_.drag * (k + 1) * u(k + 1) / hs);
    return sum;
  }

  template <int K>
  Field field_at(const CornerSeries<K>& y, double x, double hs, const Field& next) const {
    double pull = 0;
    if constexpr (Gravity::pulls)
      pull = pull_at(value(y.xi, x), value(y.w, x) / hs, value(y.theta, x), value(y.omega, x) / hs, value(y.rx, x),
                     value(y.ry, x));
    return field_of(a_ + (next.a - a_) * x, Gravity::shaken ? g_ + (next.g - g_) * x : c_.g, pull);
  }

  enum class Cause { none, impact, stop, grip };

  template <int terms>
  static double value(const double (&c)[terms], double x) {
    double v = c[terms - 1];
    for (int k = terms - 2; k >= 0; --k) v = v * x + c[k];
    return v;
  }

  // mu_s f_y - |f_x| at x, rocking.
  template <int K>
  double grip(const CornerSeries<K>& y, double x, double hs, Field next) const {
    const Forces f = rocking(value(y.rx, x), value(y.ry, x), value(y.omega, x) / hs, field_at(y, x, hs, next));
    return mu_s_against(f.fx) * f.fy - magnitude(f.fx);
  }

  // Where the grip, which holds at both ends of the step, is lost in between; the end: nowhere.
  template <int K>
  double weakest(const CornerSeries<K>& y, double x, double hs, Field next, const Forces& begin, double last) const {
    const double first = mu_s_against(begin.fx) * begin.fy - magnitude(begin.fx);
    if (smaller(first, last) > 0.05 * c_.g) return x;
    const double middle = 0.5 * x, here = grip(y, middle, hs, next);
    if (here < 0) return middle;
    const double half_curvature = 2 * (first + last - 2 * here),
                 slope = last - first - half_curvature;  // of the parabola, in part/x
    const double low = -0.5 * slope / half_curvature;
    if (!(half_curvature > 0 && low > 0 && low < 1)) return x;
    return grip(y, low * x, hs, next) < 0 ? low * x : x;
  }

  // Illinois; the grip holds at the start, or was just found to.
  template <int K>
  double lost_grip(const CornerSeries<K>& y, double hi, double hs, Field next, double f_hi) const {
    double lo = 0, f_lo = grip(y, 0, hs, next);
    if (!(f_lo > 0)) return 0;
    int side = 0;
    for (int i = 0; i < 60 && hi - lo > 1e-13; ++i) {
      double x = hi - f_hi * (hi - lo) / (f_hi - f_lo);
      if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
      const double f = grip(y, x, hs, next);
      if (magnitude(f) < 1e-14 * c_.g) return x;
      if (f > 0) {
        lo = x;
        f_lo = f;
        if (side == 1) f_hi *= 0.5;
        side = 1;
      } else {
        hi = x;
        f_hi = f;
        if (side == -1) f_lo *= 0.5;
        side = -1;
      }
    }
    return hi;
  }

  template <int K>
  Forces forces_at(const CornerSeries<K>& y, double x, double hs, Field next) const {
    return forces(value(y.rx, x), value(y.ry, x), value(y.omega, x) / hs, field_at(y, x, hs, next), value(y.w, x) / hs,
                  magnitude(value(y.xi, x) - xi_));
  }

  template <int K>
  void watch(const CornerSeries<K>& y, double x, double hs, Field next, const Forces& begin) {
    const double theta = value(y.theta, x), omega = value(y.omega, x), rx = value(y.rx, x), ry = value(y.ry, x);
    const Forces end = forces_at(y, x, hs, next);
    if (!(end.fy > 0)) return decline();
    feel(begin);
    feel(end);
    // Displacement of the midpoint: u = xi + s B (1 - cos theta).
    const double c = arm(side_), lever = this->lever();
    const auto slip = [&](double at) { return value(y.xi, at) + side_ * half_base_ * versine(value(y.theta, at)); };
    if (y.omega[0] * omega < 0) {
      const double top = sign_change<K + 1>(y.omega, x);
      see_rotation(value(y.theta, top));
      see_slip(slip(top));
      feel(forces_at(y, top, hs, next));
    }
    feel_top(y, x, hs, next, begin, end);
    see_rotation(theta);
    const double u = slip(x);
    see_slip(u);
    const double before = y.w[0] + lever * leaning(rx_, ry_) * y.omega[0];
    const double after = (mode_ == Mode::rock ? 0.0 : value(y.w, x)) + lever * leaning(rx, ry) * omega;
    if (before * after < 0 && magnitude(u) + magnitude(before) + magnitude(after) > peak_slip_) {
      double rate[K + 1];
      for (int k = 1; k <= K; ++k) rate[k] = k * (y.xi[k] - lever * (c_.h * y.ry[k] - c * y.rx[k]));
      see_slip(slip(sign_change<K - 1>(rate + 1, x)));
    }
  }

  // Where the squared acceleration has a top inside the step: between the ends its square is all but a parabola. A force that turns
  // with the block by phi leaves its chord by phi^2/8 of itself: a top 1 % over both ends takes a step that turns by 0.2 rad, and those of
  // a record at 0.02 s turn by less up to 10 rad/s. A top missed by 1e-4 of the step is low by 1e-8 of its rise.
  // Spring and drag bend it more: by the higher terms of their series at most, and with more than one top.
  template <int K>
  void feel_top(const CornerSeries<K>& y, double x, double hs, Field next, const Forces& begin, const Forces& end) {
    const double first = square_of_forces(begin), last = square_of_forces(end), more = 0.01 * (first + last);
    if constexpr (Gravity::pulls) {
      if (square_of(std::sqrt(larger(first, last) + more) + pull_bends(y, hs), 0) < force2_) return;
      constexpr int parts = 16;
      double square[parts + 1] = {first};
      int top = 1;
      for (int part = 1; part < parts; ++part) {
        square[part] = square_of_forces(forces_at(y, x * part / parts, hs, next));
        if (square[part] > square[top]) top = part;
      }
      square[parts] = last;
      force2_ = larger(force2_, square[top]);
      const double left = square[top - 1], right = square[top + 1], curve = left + right - 2 * square[top];
      if (curve < 0 && square[top] >= left && square[top] >= right)
        feel(forces_at(y, x / parts * (top + 0.5 * (left - right) / curve), hs, next));
      return;
    }
    if (larger(first, last) + more < force2_) return;
    double middle = 0.5 * x;
    for (int round = 0; round < 3; ++round) {
      const double here = square_of_forces(forces_at(y, middle, hs, next));
      force2_ = larger(force2_, here);
      // Top of the parabola through both ends and the point between.
      const double left = (here - first) / middle, right = (last - here) / (x - middle),
                   half_curvature = (right - left) / x;
      const double top = 0.5 * (middle - left / half_curvature);
      if (!(half_curvature < 0) || !(top > 1e-6 * x && top < (1 - 1e-6) * x) || magnitude(top - middle) < 1e-4 * x)
        return;
      middle = top;
    }
  }

  template <int K>
  void overturn(const CornerSeries<K>& y, double x, double hs, Field next) {
    double lo = 0, hi = x;
    for (int round = 0; round < 50; ++round) {
      const double middle = 0.5 * (lo + hi);
      (side_ * value(y.theta, middle) < 0.5 * pi ? lo : hi) = middle;
    }
    watch(y, hi, hs, next, forces(rx_, ry_, omega_, field(), w_));
    theta_ = side_ * 0.5 * pi;
    peak_rotation_ = 0.5 * pi;
    const double xi = value(y.xi, hi);
    slid(xi - xi_);
    xi_ = xi;
    event();
    ended_ = true;
    overturned_ = true;
    end_ = now() + hs * hi;
    if (end_ > latest()) decline();
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
