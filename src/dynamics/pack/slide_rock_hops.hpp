// Rows of small hops of a block that rocks itself to rest, without slip.
#pragma once

#include <limits>

#include "dynamics/pack/slide_rock_lane.hpp"
#include "dynamics/pack/slide_rock_search.hpp"
#include "dynamics/row_of_hops.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockHops : public SlideRockLane {
 public:
  using SlideRockLane::enter;
  using SlideRockLane::leave;
  bool hops() const { return hops_ && marches(); }

  template <class Gravity>
  void enter(HopRows<Gravity>& r, int i) const {
    const double h2 = h_ * h_, size = magnitude(c_.scale), lift = lift_ahead();
    r.theta[i] = magnitude(theta_);
    r.omega[i] = side_ * omega_ * h_;
    r.side[i] = side_;
    enter_floor(r, i);
    for (int k = 0; k < 2; ++k) {
      const CornerConstants& corner = corner_constants_[k];
      r.stand(k, i, corner, c_.scale, h2);
      if constexpr (Gravity::pulls) {
        const double swings = half_base_ * c_.h * corner.per_inertia;
        r.shakes.stiffness[k][i] = swings * c_.stiffness * h2;
        r.shakes.drag[k][i] = swings * c_.drag * h_;
      }
      if constexpr (Gravity::shaken) {
        const double weight = c_.vertical_scale * h2 * corner.per_inertia;
        r.shakes.lift[k][i] = weight * magnitude(corner.arm);
        r.shakes.turn[k][i] = weight * c_.h;
      }
    }
    if constexpr (Gravity::shaken) r.shakes.most[i] = lift / magnitude(c_.vertical_scale);
    if constexpr (Gravity::pulls) {
      r.slope[i] = (c_.along + pull_upright()) / c_.scale;
      r.a[i] = (a_ + pull_upright()) / c_.scale;
    }
    r.limit2[i] = limit2();
    r.push[i] = largest_push(lift) / size;
    r.hops[i] = r.impacts[i] = r.ended[i] = 0;
  }

  template <class Gravity>
  void leave(const HopRows<Gravity>& r, int i) {
    side_ = r.side[i] > 0 ? 1 : -1;
    stand(Mode::rock, side_);
    events_ += static_cast<int>(r.hops[i]);
    impacts_ += static_cast<int>(r.impacts[i]);
    if (events_ > most_events) declined_ = true;
    m_ += static_cast<int>(r.next[i] - entry_) / Gravity::stride;
    stand_at_knot();
    fraction_ = r.fraction[i];
    if (fraction_ < 1) {
      a_ = c_.scale * r.a[i] - pull_upright();
      if constexpr (Gravity::shaken) g_ = c_.g + c_.vertical_scale * r.shakes.v[i];
    }
    const double theta = r.theta[i];
    theta_ = side_ * theta;
    omega_ = side_ * r.omega[i] / h_;
    const double sine = theta_ * (1 - theta * theta * (1.0 / 6)), lost = 0.5 * theta * theta;
    rx_ = c_.h * sine - arm(side_) * (1 - lost);
    ry_ = arm(side_) * sine + c_.h * (1 - lost);
    hops_ = false;
    const bool small = r.ended[i] > 0, many = r.hops[i] >= hops_at_once;
    if (small && ends_hops(side_, omega_)) {
      if (m_ >= last_) hops_end_ = now() + row_lasts(side_, magnitude(omega_));
      return stand(Mode::rest, 0);
    }
    if (many && dies_out()) return stand(Mode::rest, 0);
    hops_ = small || many;
  }

 protected:
  using SlideRockLane::SlideRockLane;

  // The hops from here on are so small that their series (dynamics/pack/hop_series.hpp) is as good as that of rocking, slip
  // nowhere and are no new peaks. kappa h^2 < 1e-3: the first term left out of a hop is (kappa h^2)^3/7! = 2e-13 of it.
  bool small_hops() const {
    const double a = a_ + pull_upright(), pull = on(side_).pull(a, g_ - c_.g), square = omega_ * omega_;
    return square * square < limit2() * pull * pull && bounds_.fast * c_.g * h_ * h_ < 1e-3 &&
           magnitude(a) <= largest_push(lift_ahead());
  }

  // The hops that follow end before the floor could make one larger, or make it slip: they are counted, and the block
  // rests. While the block falls back with accelerations alpha(t) >= slow, a hop that starts with rate omega returns with
  // omega exp(v/2) at most, v the variation of ln(alpha) within: the row of hops, each e times the one before, lasts
  // 2 omega/slow exp(V/2)/(1 - e) at most.
  bool dies_out() {
    const double omega = magnitude(omega_), square = omega * omega, span = bounds_.row * omega / h_;
    const double along = along_hops(), slow = bounds_.slow - bounds_.slow1 * along;
    if (span > longest_row * slow || square >= on(side_).told) return false;
    RowOfHops row{span, square, magnitude(a_) + (along - magnitude(c_.along)), 0, slow, 1, along};
    if (!unnoticed(row)) return false;
    if (m_ < last_ && !(quiet_row(row) && unnoticed(row))) return false;
    if (m_ >= last_) hops_end_ = now() + row_lasts(side_, omega);
    const double both = on(-1).kept * on(1).kept, size = hop(side_, omega);
    if (both > 0 && size > c_.rest_rotation)  // in a steady field
      events_ += static_cast<int>(std::ceil(log_outside(c_.rest_rotation / size) / log_outside(both)));
    if (events_ > most_events) declined_ = true;
    return true;
  }
  // On a still floor.
  double row_lasts(int side, double omega) const {
    const double along = c_.along + pull_upright();
    const auto pull = [&](int corner) { return on(corner).pull(along, 0); };
    return lasts_in_all(omega, pull(side), on(side).kept, pull(-side), on(-side).kept);
  }

  // The row of hops that starts on `side`, without slip, is over.
  bool ends_hops(int side, double omega) const {
    return row_is_over(hop(side, omega), c_.rest_rotation, omega, most_kept(), [&] { return given_ahead(); });
  }
  double most_kept() const { return larger(on(-1).kept, on(1).kept); }

  // Up to the next knot, on the corner where it is less. pull(corner, field): back to the floor, of the upright block.
  template <class Pull>
  double given_ahead(Pull&& pull) const {
    const Field next = field_of(next_floor(), next_gravity(), this->pull());
    const double time = m_ < last_ ? h_ * fraction_ : std::numeric_limits<double>::infinity();
    const auto given = [&](int corner) {
      const double now = pull(corner, field());
      return dynamics::given_ahead(now, (pull(corner, next) - now) / time, time);
    };
    return smaller(given(-1), given(1));
  }
  double given_ahead() const {
    return given_ahead([&](int corner, Field at) { return on(corner).pull(at.a, at.g - c_.g); });
  }

 private:
  // Four times the squared rotation up to which hops are small.
  double limit2() const {
    const double room = larger(peak_slip_ + least_slip - magnitude(xi_), 0) / half_base_;
    return 4 * smaller(smaller(bounds_.limit2, peak_rotation_ * peak_rotation_), room);
  }

  // Largest |v| of the knots just ahead.
  double lift_ahead() const {
    if (!shaken_) return 0;
    double most = 0;
    for (int j = m_; j <= last_ && j < m_ + watched_ahead; ++j)
      most = larger(most, magnitude(t_.vertical[static_cast<std::size_t>(j)]));
    return magnitude(c_.vertical_scale) * most;
  }

  // Of the floor, so that small hops are unnoticed and it tips the block nowhere, where it lifts with `v` at most;
  // negative: none.
  double largest_push(double v) const {
    const HopBounds& b = bounds_;
    const double share = v / c_.g;
    const double fx = b.fx * (1 + share) + small_share * c_.g + swings(), lift = b.lift + v + small_share * c_.g;
    const double mu_s = least_mu_s(), grip = (mu_s * (c_.g - lift) - fx) / (b.fx1 + mu_s * b.lift1);
    const double unseen = b.unseen_push(fx + along_hops(), lift, force2_);
    return smaller(smaller(grip, unseen), b.tips * (1 - share));
  }

  struct RowOfHops {
    double span, square;  // its duration times slow, in intervals; squared rate at the start
    double push, lift;    // bounds of the floor's acceleration
    double slow, growth;  // alpha at least; exp(V)
    double along;         // bound of what is no shaking
  };
  // Slope, spring and drag while a row of hops lasts whose rotations are small enough for `unnoticed`.
  double along_hops() const { return magnitude(c_.along) + magnitude(pull_upright()) + swings(); }
  // By what spring and drag change in it.
  double swings() const {
    if (!pulled_) return 0;
    const double most = most_of_row * smaller(c_.left, c_.right) / c_.h;
    return half_base_ * most * (c_.stiffness * most + c_.drag * magnitude(omega_));
  }

  // An upper bound of exp(x), x >= 0.
  static double above_exp(double x) { return x < 1.75 ? 1 + x * (1 + x) : exp_outside(x); }

  // Is it certain that the floor does not tip the block while a row of hops lasts? Sets the bounds.
  bool quiet_row(RowOfHops& row) const {
    const double unit = magnitude(c_.scale), *a = t_.acceleration.data() + m_, span = row.span;
    const double lifts = magnitude(c_.vertical_scale), *v = shaken_ ? t_.vertical.data() + m_ : nullptr;
    double &push = row.push, &lift = row.lift, &slow = row.slow;
    int end = static_cast<int>(span / slow) + 2;
    const double along = row.along;
    if (m_ + end > last_ || unit * bound_between(t_, m_, m_ + end) + along > bounds_.tips) return false;
    double variation = 0;
    for (int done = 0; done < end;) {
      done = end;
      const Swing shaking = swing(a, end), lifting = shaken_ ? swing(v, end) : Swing{0, 0};
      push = unit * shaking.most + along;
      lift = lifts * lifting.most;
      const double rest = 1 - lift / c_.g;  // of gravity
      slow = bounds_.slow * rest - bounds_.slow1 * push;
      if (push > bounds_.tips * rest || push > least_mu_s() * (c_.g - lift)) return false;
      variation = (unit * bounds_.fast * shaking.path + lifts * bounds_.fast_lift * lifting.path) / slow;
      const double need = span / slow * above_exp(0.5 * variation) + 2;
      if (!(need < longest_row) || m_ + need > last_) return false;
      end = static_cast<int>(need);
    }
    row.growth = above_exp(variation);
    return true;
  }

  // A row of hops is no peak, and slips nowhere.
  bool unnoticed(const RowOfHops& row) const {
    const double rotation = row.growth * row.square / (2 * row.slow);
    // A rotation of this share of b/h takes as much off the pull back, and off the rates of the row. Of the longest row, 80 intervals,
    // a thousandth is a twelfth of an interval, and quiet_row looks at two more. At the end of all, where the time of the hops
    // counts, a row from 1e-5 lasts 2 sqrt(2e-5)/(1 - e)/p = 0.009/(1 - e)/p, and that is off by 1e-7/(1 - e)/p.
    const double least = m_ < last_ ? most_of_row : 1e-5;
    if (rotation > peak_rotation_ || rotation * c_.h > least * smaller(c_.left, c_.right)) return false;
    if (magnitude(xi_) + half_base_ * rotation * rotation > peak_slip_ + least_slip) return false;
    return unnoticed(row.push, row.lift, 2 * c_.h * row.growth * row.square, row.along);
  }

  // Small hops neither slip nor make a new peak of the acceleration while the floor's is `push` at most, and `v`
  // vertically; more: what the rotation adds to the forces.
  bool unnoticed(double push, double v, double more, double along) const {
    const double fx = bounds_.fx * (1 + v / c_.g) + bounds_.fx1 * push + more;
    const double lift = bounds_.lift + v + bounds_.lift1 * push + more;
    const double ax = fx + along;
    return ax * ax + lift * lift < force2_ && fx < least_mu_s() * (c_.g - lift);
  }

  static constexpr double most_of_row = 1e-3;   // see `unnoticed`
  static constexpr int watched_ahead = 32;      // knots
  static constexpr double small_share = 0.002;  // of gravity: what small rotations add to the forces
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
