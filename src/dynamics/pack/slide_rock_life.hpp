// One sample of slide-rock between its steps on a corner: rest, sliding, limits, peaks, impacts, and which mode follows.
#pragma once

#include <cmath>

#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/polynomial_root.hpp"
#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockLife {
 public:
  explicit SlideRockLife(const BatchCase& c)
      : c_(c), t_(*c.table), h_(t_.step_s), last_(t_.knots - 1), half_base_(0.5 * (c.left + c.right)) {}

 protected:
  struct Forces {
    double alpha, slip, fx, fy;
  };

  // ---- the floor
  double floor_at(int knot) const {
    return knot <= last_ && !after_ ? c_.scale * t_.acceleration[static_cast<std::size_t>(knot)] : 0.0;
  }
  double next_floor() const { return m_ < last_ ? floor_at(m_ + 1) : 0.0; }
  double now() const { return h_ * (m_ + 1 - left_); }
  void next_knot() {
    ++m_;
    left_ = 1;
    a_ = m_ < last_ ? floor_at(m_) : 0.0;
    if (m_ > last_ && now() >= h_ * last_ + c_.free_vibration_s) declined_ = true;
  }
  // Forward by a part x of what is left of the interval.
  void forward(double x) {
    if (x >= 1 || left_ * (1 - x) < 1e-12) return next_knot();
    a_ += (next_floor() - a_) * x;
    left_ -= left_ * x;
  }

  // ---- limits
  double arm(int side) const { return side > 0 ? c_.right : -c_.left; }
  double tips_at(double a) const { return (a > 0 ? c_.left : c_.right) / c_.h * c_.g; }
  double slips_at() const { return c_.mu_s * c_.g; }
  double quiet(double a) const { return std::fmin(tips_at(a), slips_at()); }

  Forces rocking(double rx, double ry, double omega, double a) const {
    const double alpha = (rx * c_.g - ry * a) / (c_.k2 + rx * rx + ry * ry);
    return {alpha, 0, ry * alpha - rx * omega * omega + a, c_.g - rx * alpha - ry * omega * omega};
  }
  Forces slipping(double rx, double ry, double omega, double a) const {
    const double sm = sigma_ * c_.mu_k, q = rx + sm * ry, n = c_.g - ry * omega * omega, d = c_.k2 + rx * q;
    const double alpha = n * q / d, fy = n * c_.k2 / d;
    return {alpha, -sm * fy - a - ry * alpha + rx * omega * omega, -sm * fy, d > 1e-3 * c_.k2 ? fy : -1.0};
  }
  Forces forces(double rx, double ry, double omega, double a) const {
    return mode_ == Mode::rock ? rocking(rx, ry, omega, a) : slipping(rx, ry, omega, a);
  }

  // ---- peaks
  void feel(double fx, double fy) {
    const double lift = fy - c_.g, square = fx * fx + lift * lift;
    if (square > force2_) force2_ = square;
  }
  double slip_of(double xi, double theta) const {
    const double half = std::sin(0.5 * theta);
    return xi + side_ * half_base_ * 2 * half * half;
  }
  void see_slip(double u) { peak_slip_ = larger(peak_slip_, magnitude(u)); }
  void see_rotation(double theta) { peak_rotation_ = larger(peak_rotation_, magnitude(theta)); }

  void event() {
    if (++events_ > 10000) declined_ = true;
  }

  // ---- rest
  void rest() {
    const double size = magnitude(c_.scale), least = std::fmin(std::fmin(quiet(1), quiet(-1)) / size, 1e300);
    if (m_ < last_) {
      for (int j = m_ + 1;; ++j) {
        j = first_above(t_, j, least);
        if (j > last_) break;
        const double after = c_.scale * t_.acceleration[static_cast<std::size_t>(j)], limit = quiet(after);
        if (!(magnitude(after) > limit)) continue;
        feel_rest(j);
        const double before = c_.scale * t_.acceleration[static_cast<std::size_t>(j) - 1];
        const double breaks = after > 0 ? limit : -limit, part = (breaks - before) / (after - before);
        left_ = j - 1 == m_ ? std::fmin(left_, 1 - part) : 1 - part;
        m_ = j - 1;
        a_ = breaks;
        if (left_ < 1e-9 && m_ + 1 < last_) next_knot();
        feel(breaks, c_.g);
        event();
        side_ = after > 0 ? -1 : 1;
        if (tips_at(after) <= slips_at()) {
          stand(Mode::rock, side_);
        } else {
          mode_ = Mode::slide;
          sigma_ = side_;
        }
        return;
      }
      feel_rest(t_.knots);
    }
    ended_ = true;
    end_ = m_ < last_ ? h_ * last_ : now();
  }
  void feel_rest(int end) {
    const double bound = bound_between(t_, m_, end) * c_.scale;
    if (bound * bound <= force2_) return;
    feel(a_, c_.g);
    if (end == t_.knots) return feel(c_.scale * peak_from(t_, m_ + 1), c_.g);
    for (int j = m_ + 1; j < end; ++j) feel(floor_at(j), c_.g);
  }

  // ---- sliding, exact
  void slide() {
    const double hs = h_ * left_, a1 = next_floor(), friction = c_.mu_k * c_.g;
    double p[3] = {sigma_ * w_, -(sigma_ * a_ + friction) * hs, -0.5 * sigma_ * (a1 - a_) * hs};
    if (p[0] == 0 && p[1] < 0 && p[1] > -1e-9 * c_.g * hs) p[1] = 0;
    const double x = first_fall<2>(p, 1.0), part = x < 1 ? x : 1.0;
    feel(friction, c_.g);
    const double moved = sigma_ * hs * part * (p[0] + part * (p[1] * 0.5 + part * p[2] * (1.0 / 3)));
    xi_ += moved;
    path_ += magnitude(moved);
    w_ = x <= 1 ? 0.0 : sigma_ * (p[0] + p[1] + p[2]);
    see_slip(xi_);
    forward(part);
    if (x <= 1) {
      event();
      choose_flat();
    }
  }

  void stand(Mode mode, int side) {
    mode_ = mode;
    side_ = side;
    theta_ = omega_ = 0;
    rx_ = -arm(side);
    ry_ = c_.h;
    if (mode == Mode::rock) sigma_ = 0;
  }

  // ---- what follows
  void choose_flat() {
    stand(Mode::rest, 0);
    side_ = 0;
    sigma_ = 0;
    const int over = a_ > 0 ? -1 : 1;
    if (w_ != 0) {
      const int way = w_ > 0 ? 1 : -1;
      mode_ = Mode::slide;
      sigma_ = way;
      if (c_.mu_k * c_.h > magnitude(arm(way))) {
        stand(Mode::slide_rock, way);
        sigma_ = way;
      }
      return;
    }
    const bool slips = magnitude(a_) > slips_at(), tips = magnitude(a_) > tips_at(a_);
    if (!slips && !tips) return;
    if (tips) {
      stand(Mode::rock, over);
      const Forces f = rocking(rx_, ry_, 0.0, a_);
      if (magnitude(f.fx) <= c_.mu_s * f.fy) return;
    }
    stand(Mode::slide, over);
    side_ = 0;
    sigma_ = over;
    if (c_.mu_k * c_.h > magnitude(arm(over))) {
      stand(Mode::slide_rock, over);
      sigma_ = over;
    }
  }
  void slip_on_corner(double fx) {
    mode_ = Mode::slide_rock;
    sigma_ = fx > 0 ? -1 : 1;
    w_ = 0;
  }
  void choose_on_corner() {
    if (w_ != 0) {
      mode_ = Mode::slide_rock;
      sigma_ = w_ > 0 ? 1 : -1;
      return;
    }
    const Forces f = rocking(rx_, ry_, omega_, a_);
    mode_ = Mode::rock;
    sigma_ = 0;
    if (magnitude(f.fx) > c_.mu_s * f.fy) slip_on_corner(f.fx);
  }
  double hop(int side, double omega) const {
    const double b = arm(side);
    return (c_.k2 + c_.h * c_.h + b * b) * omega * omega / (2 * c_.g * magnitude(b));
  }
  double kept(int from, int to) const {
    const double b = arm(to), kept = (c_.k2 + c_.h * c_.h + arm(from) * b) / (c_.k2 + c_.h * c_.h + b * b);
    return c_.factor * (kept > 0 ? kept : 0.0);
  }
  void strike() {
    event();
    if (hop(side_, omega_) >= c_.told_rotation) ++impacts_;
    const int from = side_, to = -side_;
    const double omega = kept(from, to) * omega_;
    const bool ends = hop(to, omega) < c_.rest_rotation;
    if (ends) {
      if (w_ != 0) w_ = slip_after_hops(to, omega);
      return choose_flat();
    }
    stand(mode_, to);
    omega_ = omega;
    choose_on_corner();
  }
  // As in dynamics/impact.cpp: two geometric series.
  double slip_after_hops(int side, double rate) const {
    const double ratio = kept(side, -side), rows = 1 / (1 - ratio * kept(-side, side));
    const int sigma = w_ > 0 ? 1 : -1;
    const double arms = magnitude(arm(side)) + ratio * magnitude(arm(-side));
    const double after = w_ + rows * (2 * c_.h * rate * (1 - ratio) + 2 * sigma * c_.mu_k * arms * magnitude(rate));
    return sigma * after > 0 ? after : 0;
  }

  void decline() { declined_ = true; }

  void fill(Response& out) const {
    out = Response{};
    out.outcome = overturned_ ? Outcome::overturned : events_ > 0 ? Outcome::moved : Outcome::at_rest;
    out.peak_slip_m = peak_slip_;
    out.residual_slip_m = theta_ == 0 ? xi_ : slip_of(xi_, theta_);
    out.slid_path_m = path_;
    out.peak_rotation_rad = peak_rotation_;
    out.residual_rotation_rad = theta_;
    out.peak_acceleration_mps2 = std::sqrt(force2_);
    out.impacts = impacts_;
    out.events = events_;
    out.end_time_s = end_;
  }

  const BatchCase& c_;
  const MotionTable& t_;
  double h_;
  int last_;
  double half_base_;
  Mode mode_ = Mode::rest;
  int m_ = 0, side_ = 0, sigma_ = 0;
  double left_ = 1, a_ = 0;  // part of the interval ahead; floor acceleration now
  double theta_ = 0, omega_ = 0, rx_ = 0, ry_ = 0, xi_ = 0, w_ = 0;
  double peak_slip_ = 0, peak_rotation_ = 0, force2_ = 0, path_ = 0, end_ = 0;
  int events_ = 0, impacts_ = 0;
  bool after_ = false, ended_ = false, declined_ = false, overturned_ = false;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
