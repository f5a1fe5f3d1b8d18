// One sample of slide-rock between its steps on a corner: rest, sliding, limits, peaks, impacts, and which mode follows.
#pragma once

#include <cmath>

#include "dynamics/pack/polynomial_root.hpp"
#include "dynamics/pack/search.hpp"
#include "dynamics/pack/slide_rock_hops.hpp"
#include "dynamics/pack/slide_rock_search.hpp"
#include "dynamics/row_of_hops.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockTrajectory : public SlideRockHops {
 protected:
  using SlideRockHops::SlideRockHops;

  // Part of a step in which the terms left out by series of this order are small enough; their last ones per size. 0:
  // no part that is worth a step, the sample is better computed alone: less than a thousandth, of which a thousand would cost more.
  double valid_part(double omega, double w, int order, bool by_law) const {
    const double last = larger(magnitude(omega), magnitude(w) / c_.h);
    const double allowed = by_law ? neglected_by_laws * fraction_ : neglected;
    if (last < allowed) return 1;
    const double part = pow_outside(allowed / last, 1.0 / (by_law ? order - 1 : order));
    return part > 1e-3 ? part : 0;
  }

  // ---- rest
  void rest() {
    const double size = magnitude(c_.scale), low = larger(least_gravity(m_), 0), spring = pull();
    const double least =
        low > 0 ? smaller((smaller(quiet(1, low), quiet(-1, low)) - magnitude(c_.along + spring)) / size, 1e300) : -1;
    if (!(g_ > 0)) return decline();
    if (m_ < last_) {
      for (int j = m_ + 1;; ++j) {
        j = next_loud(j, least);
        if (j > last_) break;
        const double after = floor_at(j) + spring, g = gravity_at(j);
        if (!(g > 0)) return decline();
        const double limit = quiet(after, g), way = after > 0 ? 1 : -1;
        if (!(magnitude(after) > limit)) continue;
        feel_rest(j);
        const double before = floor_at(j - 1) + spring, g_before = gravity_at(j - 1);
        const double limit_before = quiet(after, g_before);
        const double part = (way * limit_before - before) / ((after - before) - way * (limit - limit_before));
        fraction_ = j - 1 == m_ ? smaller(fraction_, 1 - part) : 1 - part;
        m_ = j - 1;
        g_ = g_before + (g - g_before) * part;
        a_ = way * quiet(after, g_) - spring;
        feel(a_, g_);
        if (fraction_ < 1e-9 && m_ + 1 < last_) next_knot();  // 1e-11 s late at most: a push of 1e-10 m/s
        event();
        side_ = after > 0 ? -1 : 1;
        if (tips_at(after, g_) <= slips_at(after, g_)) {
          stand(Mode::rock, side_);
        } else {
          mode_ = Mode::slide;
          sigma_ = side_;
        }
        return;
      }
      feel_rest(t_.knots);
      // The floor's last push held it on its slope, or against a spring.
      if (const double a = c_.along + spring; magnitude(a) > quiet(a, c_.g)) {
        m_ = last_;
        stand_at_knot();
        event();
        return choose_flat();
      }
    }
    ended_ = true;
    end_ = m_ < last_ ? h_ * last_ : larger(now(), hops_end_);
    if (end_ > latest()) decline();  // single samples know what is told then
  }
  // First knot from j on that may end the rest; `least`: of the unit record, at gravity's lowest.
  int next_loud(int j, double least) const {
    if (!shaken_) return first_above(t_, j, least);
    if (peak_from(t_, j) <= least) return t_.knots;
    return first_loud(t_, j, c_.scale, c_.vertical_scale, smaller(quiet(1, 1), quiet(-1, 1)), c_.g);
  }
  void feel_rest(int end) {
    feel(a_, g_);
    if (shaken_)
      force2_ = peak_of_both(t_, m_ + 1, end, c_.scale, c_.vertical_scale, force2_);
    else if (const double later = c_.scale * t_.later_peak[static_cast<std::size_t>((m_ + 1) / table_run)];
             later * later > force2_)
      feel_acceleration(c_.scale * (end == t_.knots ? peak_from(t_, m_ + 1) : peak_between(t_, m_ + 1, end)), 0);
  }

  // ---- sliding under a constant friction, exact
  void slide_exactly() {
    if (fraction_ == 1 && (!shaken_ || m_ >= last_)) slide_past_knots();
    if (declined_) return;
    const double hs = h_ * fraction_, a1 = next_floor(), g1 = next_gravity(), friction = c_.mu_k * g_;
    if (!(smaller(g_, g1) > 0)) return decline();
    double p[3] = {sigma_ * w_, -(sigma_ * a_ + friction) * hs, -0.5 * (sigma_ * (a1 - a_) + c_.mu_k * (g1 - g_)) * hs};
    if (p[0] == 0 && p[1] < 0 && p[1] > -slip_zero * c_.g * hs) p[1] = 0;
    const double x = first_fall<2>(p, 1.0), part = x < 1 ? x : 1.0;
    feel(-sigma_ * friction, g_);
    if (shaken_) {
      const double g = g_ + (g1 - g_) * part;
      feel(-sigma_ * c_.mu_k * g, g);
    }
    const double moved = sigma_ * hs * part * (p[0] + part * (p[1] * 0.5 + part * p[2] * (1.0 / 3)));
    xi_ += moved;
    slid(moved);
    w_ = x <= 1 ? 0.0 : sigma_ * (p[0] + p[1] + p[2]);
    see_slip(xi_);
    forward(part);
    if (x <= 1) {
      event();
      choose_flat();
    }
  }

  // To the last knot up to which it is certain that the slip goes on (dynamics/pack/slide_rock_search.hpp).
  void slide_past_knots() {
    const double slows = sigma_ * c_.mu_k * c_.g + c_.along, each = sigma_ * slows * h_;
    if (m_ >= last_) {
      const double ahead = patience() - m_, knots = each > 0 ? smaller(sigma_ * w_ / each - 1, ahead) : ahead;
      if (const int whole = static_cast<int>(knots); whole > 0) slide_to(m_ + whole, 0, 0, whole * h_, slows);
      return;
    }
    const auto here = static_cast<std::size_t>(m_);
    const double way = c_.scale > 0 ? sigma_ : -sigma_;
    const int knot = first_doubt(t_, m_, w_ / c_.scale, way, each / magnitude(c_.scale)) - 1;
    if (knot <= m_) return;
    const auto there = static_cast<std::size_t>(knot);
    const double time = (knot - m_) * h_, speed = t_.velocity[there] - t_.velocity[here];
    const double moved = t_.displacement[there] - t_.displacement[here] - t_.velocity[here] * time;
    slide_to(knot, c_.scale * speed, c_.scale * moved, time, slows);
  }
  // speed, moved: of the shaken floor since. slows: what friction and the slope take off the speed [m/s2].
  void slide_to(int knot, double speed, double moved, double time, double slows) {
    const double way = time * (w_ - 0.5 * slows * time) - moved;
    feel(-sigma_ * c_.mu_k * c_.g, c_.g);
    xi_ += way;
    slid(way);
    see_slip(xi_);
    w_ -= speed + slows * time;
    m_ = knot - 1;
    next_knot();
  }

  // ---- what follows
  void choose_flat() {
    stand(Mode::rest, 0);
    side_ = 0;
    sigma_ = 0;
    const Field f = field();
    const int over = f.a > 0 ? -1 : 1;
    if (w_ != 0) {
      const int way = w_ > 0 ? 1 : -1;
      mode_ = Mode::slide;
      sigma_ = way;
      if (mu_k(w_, way) * c_.h > magnitude(arm(way))) {
        stand(Mode::slide_rock, way);
        sigma_ = way;
      }
      return;
    }
    if (!(g_ > 0)) return decline();
    const bool slips = magnitude(f.a) > slips_at(f.a, g_), tips = magnitude(f.a) > tips_at(f.a, g_);
    if (!slips && !tips) return;
    if (tips) {
      stand(Mode::rock, over);
      const Forces stuck = rocking(rx_, ry_, 0.0, f);
      if (magnitude(stuck.fx) <= mu_s_against(stuck.fx) * stuck.fy) return;
    }
    stand(Mode::slide, over);
    side_ = 0;
    sigma_ = over;
    if (mu_k(0, over) * c_.h > magnitude(arm(over))) {
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
    const Forces f = rocking(rx_, ry_, omega_, field());
    mode_ = Mode::rock;
    sigma_ = 0;
    if (magnitude(f.fx) > mu_s_against(f.fx) * f.fy) slip_on_corner(f.fx);
  }
  void strike() {
    event();
    if (hop(side_, omega_) >= c_.told_rotation) ++impacts_;
    const int from = side_, to = -side_;
    const double slip = w_;
    double omega = on(from).kept * omega_;
    if (c_.coulomb && (w_ != 0 || !sticks_)) {
      if (w_ == 0 && ends_hops(to, omega_)) return end_hops(from, slip);
      const Blow blow = coulomb_blow(c_, on(from), on(to), omega_, w_);
      if (blow.ends == Blow::Ends::painleve) return decline();
      w_ = blow.w;
      if (blow.ends == Blow::Ends::flat || (w_ != 0 && ends_slipping_hops(to, blow.omega))) {
        w_ = blow.hops() && !slip_outlasts_hops(to, blow.omega) ? 0 : blow.flat;
        return end_hops(from, slip);
      }
      omega = blow.omega;
    }
    if (w_ == 0 ? ends_hops(to, omega) : ends_slipping_hops(to, omega)) {
      if (w_ != 0 && omega != 0) w_ = slip_outlasts_hops(to, omega) ? slip_after_hops(to, omega) : 0;
      return end_hops(from, slip);
    }
    stand(mode_, to);
    omega_ = omega;
    if (w_ == 0 && sticks_ && dies_out()) return stand(Mode::rest, 0);
    choose_on_corner();
    hops_ = sticks_ && mode_ == Mode::rock && small_hops();
  }

  // The row of hops that starts now, where corner `from` carried until now and slipped with `slip`, is over within the tolerance: it is felt
  // as in dynamics/small_hops.cpp.
  void end_hops(int from, double slip) {
    HopRow row{omega_, slip};
    const auto two_hops = [&](HopRow& at) {
      return strike_and_hop(from, at) && feel_hop(-from, at) && strike_and_hop(-from, at) && feel_hop(from, at);
    };
    if (slip == 0 || w_ != 0) {
      if (two_hops(row)) feel_end_of_row(slip, lasts_in_all(omega_, row), two_hops);
    } else {
      const double after = slip_after_stops(row, two_hops);
      if (m_ >= last_) hops_end_ = now() + row.lasts;
      if (after != 0) leave_row(after, row.lasts);
    }
    choose_flat();
  }
  // steady: how long the row would last on the floor as it is.
  template <class TwoHops>
  void feel_end_of_row(double slip, double steady, TwoHops&& two_hops) {
    if (m_ >= last_ || !(steady > 0)) {
      hops_end_ = now() + steady;
      return;
    }
    const Field here{a_, g_, 0};
    const double left = h_ * fraction_;
    const auto two_hops_later = [&](double time, bool felt) {
      a_ = here.a + (next_floor() - here.a) * (time / left);
      g_ = here.g + (next_gravity() - here.g) * (time / left);
      HopRow later{omega_, slip, felt};
      return two_hops(later) ? lasts_in_all(omega_, later) : std::numeric_limits<double>::infinity();
    };
    const double lasts =
        lasts_on_changing_floor(steady, left, [&](double time) { return two_hops_later(time, false); });
    if (lasts < left) two_hops_later(lasts, true);
    a_ = here.a;
    g_ = here.g;
  }
  void leave_row(double slip, double lasted) {
    sigma_ = slip > 0 ? 1 : -1;
    slip += lasted * (field(slip).a + sigma_ * mu_k(slip, sigma_) * g_);
    if (sigma_ * slip > 0) w_ = slip;
  }
  bool strike_and_hop(int from, HopRow& row) const {
    double &omega = row.rate, &w = row.slip;
    if (c_.coulomb && (w != 0 || !sticks_)) {
      const Blow blow = coulomb_blow(c_, on(from), on(-from), omega, w);
      omega = blow.hops() ? blow.omega : 0;
      w = blow.w;
    } else {
      omega *= on(from).kept;
    }
    return omega != 0;
  }
  bool feel_hop(int side, HopRow& row) {
    constexpr int pieces = 3;
    double &omega = row.rate, &w = row.slip;
    double height = 0, rate = side * omega;
    for (int i = 0; i < pieces; ++i) {
      row.stops = row.stops || w == 0;
      Forces f = rocking(-arm(side), c_.h, 0.0, field(w));
      const bool grips = w == 0 && magnitude(f.fx) <= mu_s_against(f.fx) * f.fy;
      sigma_ = grips ? 0 : w > 0 || (w == 0 && f.fx < 0) ? 1 : -1;
      if (!grips) f = slipping(-arm(side), c_.h, 0.0, field(w), w, row.slid);
      const double half_curvature = 0.5 * side * f.alpha;
      if (!(f.fy > 0)) return false;
      if (row.felt) feel(f);
      const double down = (rate + std::sqrt(rate * rate - 4 * half_curvature * height)) / (-2 * half_curvature),
                   stops = -w / f.slip;
      const double fall = half_curvature < 0 ? down : 1e300;
      const bool slips_on = grips || !(stops > 0 && stops < fall);
      const double time = slips_on ? fall : stops;
      if (m_ < last_ && !(time < h_ * fraction_)) return false;  // the floor decides what becomes of it
      row.lasts += time;
      row.slid += grips ? 0 : time * magnitude(w + 0.5 * f.slip * time);
      height += time * (rate + time * half_curvature);
      rate += 2 * half_curvature * time;
      w = slips_on ? w + time * f.slip : 0;
      if (slips_on) {
        omega = side * rate;
        return true;
      }
    }
    return false;
  }

  // Where the slip ends within the row, the floor may tip the block as it may one that sticks.
  bool ends_slipping_hops(int side, double rate) {
    return row_is_over(hop(side, rate), c_.rest_rotation, rate, most_kept(), [&] {
      const bool outlasts = slip_outlasts_hops(side, rate);
      sigma_ = w_ > 0 ? 1 : -1;
      const double slipping_on =
          given_ahead([&](int corner, Field at) { return -corner * slipping(-arm(corner), c_.h, 0.0, at, w_).alpha; });
      return outlasts ? slipping_on : smaller(slipping_on, given_ahead());
    });
  }

  // The row of hops starts on `side`.
  bool slip_outlasts_hops(int side, double rate) {
    const auto start = [&](int pivot, double w) {
      sigma_ = w > 0 ? 1 : -1;
      const Forces f = slipping(-arm(pivot), c_.h, 0.0, field(w), w);
      return HopStart{f.alpha, f.slip};
    };
    const auto blow = [&](int pivot, double& omega, double& w) {
      if (!c_.coulomb) {
        omega *= on(pivot).kept;
        return omega != 0;
      }
      const Blow after = coulomb_blow(c_, on(pivot), on(-pivot), omega, w);
      if (after.ends == Blow::Ends::painleve) return false;
      w = after.w;
      if (after.omega == 0) return false;
      omega = after.omega;
      return true;
    };
    return outlasts_hops(side, rate, w_, start, blow);
  }

  // As in dynamics/impact.cpp: two geometric series.
  double slip_after_hops(int side, double rate) const {
    const double ratio = on(side).kept, rows = 1 / (1 - ratio * on(-side).kept);
    const int sigma = w_ > 0 ? 1 : -1;
    const double arms = magnitude(arm(side)) + ratio * magnitude(arm(-side));
    const double after =
        w_ + rows * (2 * c_.h * rate * (1 - ratio) + 2 * sigma * mu_k(w_, sigma) * arms * magnitude(rate));
    return sigma * after > 0 ? after : 0;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
