// One sample of slide-rock and its place in the packs.
#pragma once

#include <cmath>

#include "dynamics/pack/hop_rows.hpp"
#include "dynamics/pack/slide_rock_block.hpp"
#include "dynamics/pack/slide_rock_strikes.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockLane : public SlideRockBlock {
 public:
  using SlideRockBlock::SlideRockBlock;

  // Knot up to which the floor is watched.
  int patience() const {
    return last_ +
           static_cast<int>(
               smaller(c_.free_vibration_s / h_, shaken_ ? still_intervals / Shaken::stride : still_intervals)) -
           4;
  }
  // So short a rest of an interval, a difference, has seven digits: it is left to the lane alone, which goes on to the knot.
  bool in_packs() const { return fraction_ > 1e-9 && (m_ < last_ || m_ < patience()); }
  // Packs look for peaks of the slip where the rotation is largest; of a corner that stands far on the other side it is largest where that is
  // least.
  bool marches() const { return mode_ == Mode::rock && in_packs() && !(-side_ * xi_ > peak_slip_); }
  bool slips() const { return mode_ == Mode::slide_rock && in_packs(); }

  // Rocking. How many intervals there are to go: 1 at least.
  template <class Gravity>
  int enter(SlideRockRows<Gravity>& r, int i) {
    const double s = side_, h2 = h_ * h_;
    const CornerConstants& corner = on(side_);
    const double per_inertia = h2 * corner.per_inertia;
    r.theta[i] = s * theta_;
    r.omega[i] = s * omega_ * h_;
    r.rx[i] = s * rx_;
    r.ry[i] = ry_;
    const int free = enter_floor(r, i);
    r.weight[i] = side_ * c_.scale * h2;
    r.weight_g[i] = c_.g * h2;
    r.gravity[i] = c_.g * per_inertia;
    r.push[i] = s * c_.scale * per_inertia;
    r.mu_left[i] = mu_s(-side_);
    r.mu_right[i] = mu_s(side_);
    const Field f = field();
    const double alpha = (rx_ * g_ - ry_ * f.a) * corner.per_inertia, omega2 = omega_ * omega_;
    const double fx = ry_ * alpha - rx_ * omega2 + f.a, lift = (g_ - c_.g) - rx_ * alpha - ry_ * omega2;
    r.grip[i] = (mu_s_against(fx) * (c_.g + lift) - magnitude(fx)) * h2;
    r.square[i] = square_of(fx - f.along, lift) * (h2 * h2);
    r.seen[i] = force2_ * (h2 * h2);
    // Rotations that add less than peak_slip - s xi to the slip; 1 - cos(theta) <= theta^2/2.
    r.room[i] = room_ = larger(peak_slip_ - s * xi_, 0);
    r.turned[i] = peak_rotation_;
    r.look[i] = smaller(peak_rotation_, std::sqrt(2 * room_ / half_base_));
    r.half_base[i] = half_base_;
    r.curvature0[i] = more_bent_ * corner.curvature0;
    r.curvature1[i] = more_bent_ * corner.curvature1;
    r.curvature2[i] = more_bent_ * corner.curvature2;
    if constexpr (Gravity::shaken) {
      r.shakes.weight[i] = c_.vertical_scale * h2;
      r.shakes.per_inertia[i] = corner.per_inertia;
      r.shakes.curvature[i] = corner.lift_curvature;
    }
    if constexpr (Gravity::pulls) {
      enter_pull(r.shakes, i, s);
      r.shakes.xi[i] = s * xi_;
    }
    return free;
  }

  // Slide-rocking.
  template <class Gravity, class Friction>
  void enter(SlipRows<Gravity, Friction>& r, int i) {
    const double s = side_, h2 = h_ * h_;
    r.theta[i] = s * theta_;
    r.omega[i] = s * omega_ * h_;
    r.rx[i] = s * rx_;
    r.ry[i] = ry_;
    r.xi[i] = s * xi_;
    r.w[i] = s * w_ * h_;
    enter_floor(r, i);
    r.weight[i] = side_ * c_.scale * h2;
    r.weight_g[i] = c_.g * h2;
    r.k2[i] = c_.k2;
    r.size[i] = c_.h;
    r.sigma[i] = side_ * sigma_;
    r.friction[i] = side_ * sigma_ * c_.mu_k;
    r.half_base[i] = half_base_;
    enter_levers(r, i);
    r.look[i] = peak_rotation_;
    r.peak[i] = peak_slip_;
    r.seen[i] = force2_ * (h2 * h2);
    if constexpr (Gravity::shaken) r.shakes.weight[i] = c_.vertical_scale * h2;
    if constexpr (Gravity::pulls) enter_pull(r.shakes, i, s);
    r.law.enter(i, c_, path_, sigma_);
  }

  // The block in lane i of the rows is about to strike the floor as lane l of a pack.
  template <class Gravity>
  void come_down(const SlideRockRows<Gravity>& r, int i, StrikeRows& k, int l) {
    const CornerConstants &from = on(side_), &to = on(-side_);
    const double h2 = h_ * h_, per_inertia = h2 * to.per_inertia;
    see_room(r, i);
    see_slip(xi_);
    k.gravity[l] = c_.g * per_inertia;
    k.push[l] = -side_ * c_.scale * per_inertia;
    k.curvature0[l] = more_bent_ * to.curvature0;
    k.curvature1[l] = more_bent_ * to.curvature1;
    k.curvature2[l] = more_bent_ * to.curvature2;
    k.arm[l] = magnitude(to.arm);
    k.height[l] = c_.h;
    k.kept[l] = from.kept;
    k.told[l] = from.told * h2;
    k.rests[l] = sticks_ ? to.rests * h2 : 1e300;
    k.peak[l] = peak_slip_;
    k.shift[l] = -side_ * xi_;
    k.limit2[l] = bounds_.limit2;
    k.row[l] = bounds_.row;
    k.slow[l] = longest_row * bounds_.slow * h2;
    k.last_told[l] = to.told * h2;
    k.fx[l] = bounds_.fx * h2;
    k.fx1[l] = bounds_.fx1;
    k.lift[l] = bounds_.lift * h2;
    k.lift1[l] = bounds_.lift1;
    k.tips[l] = bounds_.tips * h2;
  }
  // It did so, and rocks on in lane i of the rows.
  template <class Gravity>
  void came_down(const SlideRockRows<Gravity>& r, int i, double peak, bool told) {
    side_ = -side_;
    room_ = r.room[i];
    peak_slip_ = larger(peak_slip_, peak);
    impacts_ += told;
    in_between_ = true;
    event();
  }

  // Its slip, or its stay on the corner, is about to end in a pack.
  void end_in_between() { in_between_ = true; }

  // Back from the packs.
  template <class Gravity>
  void leave(const SlideRockRows<Gravity>& r, int i) {
    peak_rotation_ = larger(peak_rotation_, r.turned[i]);
    see_room(r, i);
    leave_rows(r, i);
    if (in_between_ && r.fraction[i] < 1) {
      fraction_ = r.fraction[i];
      a_ = c_.scale * r.a[i];
    }
    in_between_ = false;
  }
  template <class Gravity, class Friction>
  void leave(const SlipRows<Gravity, Friction>& r, int i) {
    peak_slip_ = larger(peak_slip_, r.peak[i]);
    see_rotation(r.look[i]);
    const bool moved = leave_rows(r, i);
    in_between_ = false;
    if (!moved) return;
    const double xi = side_ * r.xi[i];
    slid(xi - xi_);
    xi_ = xi;
    w_ = side_ * r.w[i] / h_;
  }

 protected:
  template <class Rows>
  int enter_floor(Rows& r, int i) const {
    const bool over = m_ >= last_;
    constexpr int stride = Rows::Gravity::stride;
    const double* record = stride == 1 ? t_.acceleration.data() : t_.both.data();
    const double* row = over ? still_ground : record + stride * m_;
    const int free = over ? patience() - m_ : last_ - m_;
    const double slope = c_.along / c_.scale;
    r.a[i] = fraction_ == 1 ? *row + slope : a_ / c_.scale;
    if constexpr (requires { r.slope; }) r.slope[i] = slope;
    r.fraction[i] = fraction_;
    r.next[i] = entry_ = row + stride;
    r.stop[i] = row + stride * free;
    if constexpr (Rows::Gravity::shaken) r.shakes.v[i] = fraction_ == 1 ? row[1] : (g_ - c_.g) / c_.vertical_scale;
    return free;
  }
  // Mirrored.
  template <class Rows>
  void enter_levers(Rows& r, int i) const {
    r.lever_x[i] = lever() * arm(side_);
    r.lever_y[i] = side_ * lever() * c_.h;
  }
  // Mirrored by s.
  void enter_pull(Pulled::Rows& r, int i, double s) const {
    enter_levers(r, i);
    r.stiffness[i] = s * c_.stiffness / c_.scale;
    r.drag[i] = s * c_.drag / (c_.scale * h_);
    r.share[i] = magnitude(c_.scale) / (c_.g + magnitude(c_.scale) * t_.later_peak[0]);
  }
  // False: it has not moved.
  template <class Rows>
  bool leave_rows(const Rows& r, int i) {
    const double s = side_;
    force2_ = larger(force2_, r.seen[i] / (h_ * h_ * h_ * h_));
    if (!leave_floor(r, i)) return false;
    theta_ = s * r.theta[i];
    omega_ = s * r.omega[i] / h_;
    rx_ = s * r.rx[i];
    ry_ = r.ry[i];
    return true;
  }
  template <class Gravity>
  void see_room(const SlideRockRows<Gravity>& r, int i) {
    if (r.room[i] > room_) peak_slip_ = larger(peak_slip_, r.room[i] + side_ * xi_);
  }
  // False: it has not moved.
  template <class Rows>
  bool leave_floor(const Rows& r, int i) {
    if (r.next[i] == entry_) return in_between_;
    m_ += static_cast<int>(r.next[i] - entry_) / Rows::Gravity::stride;
    stand_at_knot();
    return true;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
