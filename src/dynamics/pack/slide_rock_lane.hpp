// One sample of slide-rock: where it is, the floor under it, its limits, forces and peaks, and its place in the packs.
#pragma once

#include <cmath>

#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/corner_constants.hpp"
#include "dynamics/pack/hop_rows.hpp"
#include "dynamics/pack/outside.hpp"
#include "dynamics/pack/search.hpp"
#include "dynamics/pack/slide_rock_blow.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"
#include "dynamics/pack/slide_rock_strikes.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockLane {
 public:
  explicit SlideRockLane(const BatchCase& c)
      : c_(c),
        t_(*c.table),
        h_(t_.step_s),
        last_(t_.knots - 1),
        shaken_(c.vertical_scale != 0),
        g_(c.g),
        half_base_(0.5 * (c.left + c.right)),
        corner_constants_{{c, -1}, {c, 1}},
        bounds_(c, corner_constants_[0], corner_constants_[1]),
        mu_s_{c.mu_s, c.mu_s},
        sticks_(!c.coulomb || (blow_sticks(c, corner_constants_[0], corner_constants_[1]) &&
                               blow_sticks(c, corner_constants_[1], corner_constants_[0]))) {
    look_at_law();
  }

  bool declined() const { return declined_; }
  bool ended() const { return declined_ || ended_; }

  // ---- in packs
  // Knot up to which the floor is watched.
  int patience() const {
    return last_ +
           static_cast<int>(
               smaller(c_.free_vibration_s / h_, shaken_ ? still_intervals / Shaken::stride : still_intervals)) -
           4;
  }
  // So short a rest of an interval, a difference, has seven digits: it is left to the lane alone, which goes on to the knot.
  bool in_packs() const { return fraction_ > 1e-9 && (m_ < last_ || m_ < patience()); }
  bool marches() const { return mode_ == Mode::rock && in_packs(); }
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
    const double alpha = (rx_ * g_ - ry_ * a_) * corner.per_inertia, omega2 = omega_ * omega_;
    const double fx = ry_ * alpha - rx_ * omega2 + a_, lift = (g_ - c_.g) - rx_ * alpha - ry_ * omega2;
    r.grip[i] = (mu_s_against(fx) * (c_.g + lift) - magnitude(fx)) * h2;
    r.square[i] = square_of(fx - c_.along, lift) * (h2 * h2);
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
    enter_midpoint(r, i);
    r.look[i] = peak_rotation_;
    r.peak[i] = peak_slip_;
    r.seen[i] = force2_ * (h2 * h2);
    if constexpr (Gravity::shaken) r.shakes.weight[i] = c_.vertical_scale * h2;
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
  template <class Rows>
  void enter_midpoint(Rows& r, int i) const {
    const double b = magnitude(arm(side_)), lever = half_base_ / (c_.h * c_.h + b * b);
    r.half_base[i] = half_base_;
    r.lever_x[i] = lever * b;
    r.lever_y[i] = lever * c_.h;
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

  struct Forces {
    double alpha, slip, fx, fy;
  };

  // ---- the floor, its slope included: gravity along it acts as if it were shaken so
  double floor_at(int knot) const {
    return knot <= last_ ? c_.scale * t_.acceleration[static_cast<std::size_t>(knot)] + c_.along : c_.along;
  }
  double next_floor() const { return m_ < last_ ? floor_at(m_ + 1) : c_.along; }
  // Effective gravity.
  double gravity_at(int knot) const {
    return shaken_ && knot <= last_ ? c_.g + c_.vertical_scale * t_.vertical[static_cast<std::size_t>(knot)] : c_.g;
  }
  double next_gravity() const { return shaken_ && m_ < last_ ? gravity_at(m_ + 1) : c_.g; }
  // From knot m on.
  double least_gravity(int m) const {
    if (!shaken_ || m > last_) return c_.g;
    return c_.g - magnitude(c_.vertical_scale) * t_.later_vertical_peak[static_cast<std::size_t>(m / table_run)];
  }
  double now() const { return h_ * (m_ + 1 - fraction_); }
  void stand_at_knot() {
    fraction_ = 1;
    a_ = m_ < last_ ? floor_at(m_) : c_.along;
    if (shaken_) g_ = m_ < last_ ? gravity_at(m_) : c_.g;
  }
  void next_knot() {
    ++m_;
    stand_at_knot();
    if (m_ > last_ && now() >= h_ * last_ + c_.free_vibration_s) declined_ = true;
  }
  // Forward by a part x of what is left of the interval. A rest of 1e-12 of it is the next knot: at 100 intervals a second that misses 1e-14 s,
  // to which events are located.
  void forward(double x) {
    if (x >= 1 || fraction_ * (1 - x) < 1e-12) return next_knot();
    a_ += (next_floor() - a_) * x;
    if (shaken_) g_ += (next_gravity() - g_) * x;
    fraction_ -= fraction_ * x;
  }

  // ---- limits
  const CornerConstants& on(int side) const { return corner_constants_[side > 0]; }
  double arm(int side) const { return on(side).arm; }
  double tips_at(double a, double g) const { return (a > 0 ? c_.left : c_.right) / c_.h * g; }
  double slips_at(double a, double g) const { return mu_s_against(a) * g; }
  double quiet(double a, double g) const { return smaller(tips_at(a, g), slips_at(a, g)); }

  // Of a slip to the right or to the left with velocity w [m/s], so much farther on [m].
  double mu_k(double w, int sigma, double ahead = 0) const {
    return c_.law ? c_.mu_k * friction_factor_outside(*c_.law, {magnitude(w), path_ + ahead, sigma}) : c_.mu_k;
  }
  // Of one that begins so; under a force fx.
  double mu_s(int sigma) const { return mu_s_[sigma > 0]; }
  double mu_s_against(double fx) const { return mu_s(fx > 0 ? -1 : 1); }
  double least_mu_s() const { return smaller(mu_s_[0], mu_s_[1]); }

  // By so much.
  void slid(double way) {
    path_ += magnitude(way);
    if (c_.law && c_.law->sees_path) look_at_law();
  }
  void look_at_law() {
    if (!c_.law) return;
    for (const int sigma : {-1, 1}) mu_s_[sigma > 0] = c_.mu_s * friction_factor_outside(*c_.law, {0, path_, sigma});
    if (!(mu_s_[0] >= 0 && mu_s_[1] >= 0)) return decline();
    more_bent_ = bent_share(larger(mu_s_[0], mu_s_[1])) / bent_share(c_.mu_s);
  }

  // Floor acceleration and effective gravity.
  struct Field {
    double a, g;
  };
  Field field() const { return {a_, g_}; }

  Forces rocking(double rx, double ry, double omega, Field f) const {
    const double alpha = (rx * f.g - ry * f.a) / (c_.k2 + rx * rx + ry * ry);
    return {alpha, 0, ry * alpha - rx * omega * omega + f.a, f.g - rx * alpha - ry * omega * omega};
  }
  // Near Painleve's paradox, where d vanishes, or under friction that pushes, the corner is said to pull: the sample is then computed
  // alone.
  Forces slipping(double rx, double ry, double omega, Field f, double w, double ahead = 0) const {
    const double sm = sigma_ * mu_k(w, sigma_, ahead), q = rx + sm * ry, n = f.g - ry * omega * omega,
                 d = c_.k2 + rx * q;
    const double alpha = n * q / d, fy = n * c_.k2 / d;
    return {alpha, -sm * fy - f.a - ry * alpha + rx * omega * omega, -sm * fy,
            d > 1e-3 * c_.k2 && sigma_ * sm >= 0 ? fy : -1.0};
  }
  Forces forces(double rx, double ry, double omega, Field f, double w, double ahead = 0) const {
    return mode_ == Mode::rock ? rocking(rx, ry, omega, f) : slipping(rx, ry, omega, f, w, ahead);
  }

  // ---- peaks
  void feel(double fx, double fy) { feel_acceleration(fx - c_.along, fy - c_.g); }
  void feel_acceleration(double ax, double ay) { force2_ = larger(force2_, square_of(ax, ay)); }
  double square_of_forces(const Forces& f) const { return square_of(f.fx - c_.along, f.fy - c_.g); }
  static double square_of(double x, double y) { return x * x + y * y; }
  double slip_of(double xi, double theta) const {
    const double half = sin_outside(0.5 * theta);
    return xi + side_ * half_base_ * 2 * half * half;
  }
  void see_slip(double u) { peak_slip_ = larger(peak_slip_, magnitude(u)); }
  void see_rotation(double theta) { peak_rotation_ = larger(peak_rotation_, magnitude(theta)); }

  void event() {
    if (++events_ > most_events) declined_ = true;
  }

  void stand(Mode mode, int side) {
    mode_ = mode;
    side_ = side;
    theta_ = omega_ = 0;
    rx_ = -arm(side);
    ry_ = c_.h;
    if (mode == Mode::rock || mode == Mode::rest) sigma_ = 0;
  }

  // Of a free hop that starts flat.
  double hop(int side, double omega) const { return 0.5 * omega * omega * on(side).per_weight; }

  void decline() { declined_ = true; }

  static constexpr int most_events = 10000;
  static constexpr double longest_row = 80;  // intervals
  // Small hops, and rows of them that are counted at once, are not watched: they may raise the peak slip by so much, unseen [m].
  static constexpr double least_slip = 1e-10;

  const BatchCase& c_;
  const MotionTable& t_;
  double h_;
  int last_;
  bool shaken_;  // vertically
  double g_;     // effective gravity now
  double half_base_;
  CornerConstants corner_constants_[2];  // on the left corner, on the right one
  HopBounds bounds_;
  double mu_s_[2];        // of slips to the left, and to the right, that begin
  double more_bent_ = 1;  // factor on the corners' curvatures, where the law makes mu_s larger
  bool sticks_;           // impacts of a corner that sticks make none slip
  Mode mode_ = Mode::rest;
  int m_ = 0, side_ = 0, sigma_ = 0;
  double fraction_ = 1, a_ = 0;  // part of the interval ahead; floor acceleration now, its slope included
  double theta_ = 0, omega_ = 0, rx_ = 0, ry_ = 0, xi_ = 0, w_ = 0;
  double peak_slip_ = 0, peak_rotation_ = 0, force2_ = 0, path_ = 0, end_ = 0;
  double room_ = 0;      // peak slip less s xi, when it entered a pack
  double hops_end_ = 0;  // of the last row of hops that was not gone through, on the still floor [s]
  mutable const double* entry_ = nullptr;
  int events_ = 0, impacts_ = 0;
  bool hops_ = false;        // small hops lie ahead
  bool in_between_ = false;  // in a pack: it may have moved without having reached a knot
  bool ended_ = false, declined_ = false, overturned_ = false;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
