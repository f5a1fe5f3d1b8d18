// One sample of slide-rock: where it is, the floor under it, its limits, forces and peaks.
#pragma once

#include <cmath>

#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/corner_constants.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/lane_rows.hpp"
#include "dynamics/pack/outside.hpp"
#include "dynamics/pack/search.hpp"
#include "dynamics/pack/slide_rock_blow.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockBlock {
 public:
  explicit SlideRockBlock(const BatchCase& c)
      : c_(c),
        t_(*c.table),
        h_(t_.step_s),
        last_(t_.knots - 1),
        shaken_(c.vertical_scale != 0),
        pulled_(c.stiffness != 0 || c.drag != 0),
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
  // Floor acceleration and effective gravity. Slope, spring and drag act as if the floor were shaken by `along`, which is part of a and
  // no acceleration of the block.
  struct Field {
    double a, g, along;
  };
  struct Forces {
    double alpha, slip, fx, fy, along;
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
    if (m_ > last_ && now() >= latest()) declined_ = true;
  }
  double latest() const { return h_ * last_ + c_.free_vibration_s; }  // until when its rest is waited for
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

  Field field() const { return field_of(a_, g_, pull()); }
  // Of the upright block that slips with w.
  Field field(double w) const { return field_of(a_, g_, pulled_ ? pull_at(xi_, w) : 0); }
  Field field_of(double a, double g, double pull) const { return {a + pull, g, c_.along + pull}; }
  // By what spring and drag slow the block: stiffness u + drag u'.
  double pull() const { return pulled_ ? pull_at(xi_, w_, theta_, omega_, rx_, ry_) : 0; }
  double pull_upright() const { return pulled_ ? c_.stiffness * xi_ : 0; }  // of one that does not slip
  double pull_at(double xi, double w) const { return c_.stiffness * xi + c_.drag * w; }
  double pull_at(double xi, double w, double theta, double omega, double rx, double ry) const {
    if (theta == 0) return pull_at(xi, w);
    return pull_at(xi + side_ * half_base_ * versine(theta), w + lever() * leaning(rx, ry) * omega);
  }
  // Velocity of the middle of the base, u' = w + lever() leaning() omega: sin(theta) = leaning()/(h^2 + c^2).
  double lever() const { return side_ * half_base_ / (c_.h * c_.h + arm(side_) * arm(side_)); }
  double leaning(double rx, double ry) const { return c_.h * rx + arm(side_) * ry; }

  Forces rocking(double rx, double ry, double omega, Field f) const {
    const double alpha = (rx * f.g - ry * f.a) / (c_.k2 + rx * rx + ry * ry);
    return {alpha, 0, ry * alpha - rx * omega * omega + f.a, f.g - rx * alpha - ry * omega * omega, f.along};
  }
  // Near Painleve's paradox, where d vanishes, or under friction that pushes, the corner is said to pull: the sample is then computed
  // alone.
  Forces slipping(double rx, double ry, double omega, Field f, double w, double ahead = 0) const {
    const double sm = sigma_ * mu_k(w, sigma_, ahead), q = rx + sm * ry, n = f.g - ry * omega * omega,
                 d = c_.k2 + rx * q;
    const double alpha = n * q / d, fy = n * c_.k2 / d;
    return {alpha, -sm * fy - f.a - ry * alpha + rx * omega * omega, -sm * fy,
            d > 1e-3 * c_.k2 && sigma_ * sm >= 0 ? fy : -1.0, f.along};
  }
  Forces forces(double rx, double ry, double omega, Field f, double w, double ahead = 0) const {
    return mode_ == Mode::rock ? rocking(rx, ry, omega, f) : slipping(rx, ry, omega, f, w, ahead);
  }

  // ---- peaks
  void feel(const Forces& f) { feel_acceleration(f.fx - f.along, f.fy - c_.g); }
  void feel(double fx, double fy) { feel_acceleration(fx - c_.along, fy - c_.g); }  // without spring and drag
  void feel_acceleration(double ax, double ay) { force2_ = larger(force2_, square_of(ax, ay)); }
  double square_of_forces(const Forces& f) const { return square_of(f.fx - f.along, f.fy - c_.g); }
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
  bool pulled_;  // by a spring, or a drag
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
