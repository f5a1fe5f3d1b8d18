// A step of a slip in the plane, in the series in s (plane_slip.hpp): one text for a sample and for a pack of samples, whose lanes have
// the bits of single ones. Numbers: OnePlane below, or LanePlane in pack/plane_march.hpp.
#pragma once

#include <freestand/floor_motion.hpp>

#include "base/units.hpp"
#include "dynamics/plane_slip.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {

// A slip is asked whether it follows the drive where its direction settles, in the time |q|/A, so much faster than the step lasts.
inline constexpr double settles_in = 0.1;
// Where friction differs between directions the end of a slip is not computed, but cut off: this share of what a step may miss.
inline constexpr double cut_off = 0.01;
// A step in s changes the speed by the factor e^2 at most.
inline constexpr double longest_exponent = 2;
inline constexpr int most_steps_a_segment = 1000000;
inline constexpr double plane_bound = 1e6;  // of slip and velocity: beyond it a sample is not finite [m], [m/s]

// What changes along a slip, and what it depends on. Directions: of the axes of friction.
template <class Real>
struct PlaneState {
  Real offset, length;  // time since the start of the segment, and to its end from there [s]
  Real asks;            // until when it is not asked again whether it follows the drive
  FloorAt<Real> floor;  // at the start of the segment
  Vector2<Real> u, w;
  Real slip, path, acceleration;  // peaks, and the length of the path
  Grip<Real> grip;
  Real weight;                            // g' of a floor that does not shake vertically
  Real over_speed, over_size, over_time;  // what errors are measured by: 1/(R p), 1/R, p
  Real size;
};
inline constexpr int plane_numbers = sizeof(PlaneState<double>) / sizeof(double);
inline constexpr int numbers_of_segment = 3 + sizeof(PlaneFloor) / sizeof(double);  // the first ones

struct OnePlane {
  static double choose(bool which, double yes, double no) { return which ? yes : no; }
  static bool any(bool which) { return which; }
  static double sqrt(double x) { return std::sqrt(x); }
  static double root(bool, double x, double degree) { return std::pow(x, 1 / degree); }
  static double most(bool, const PlaneSeries& y, double h, double floor) { return max_of(y, h, floor); }
};

template <class Real, class Numbers, bool elliptic, bool shaken>
struct PlaneStep {
  static constexpr int N = plane_order;
  using Mask = decltype(Real() < Real());

  PlaneState<Real>& at;
  const Real tolerance;
  FloorAt<Real> floor{};
  SlipSeries<Real> slip;
  Real v{}, drive{}, hold{}, h{}, tau{};  // |q|, |A|, the larger F m_i; length of the step, in s and in time

  PlaneStep(PlaneState<Real>& state, double accuracy) : at(state), tolerance(accuracy) {}

  // The floor at this instant, and the speed.
  [[gnu::always_inline]] void look() {
    floor.a.x = at.floor.a.x + at.offset * at.floor.da.x;
    floor.a.y = at.floor.a.y + at.offset * at.floor.da.y;
    floor.da.x = at.floor.da.x, floor.da.y = at.floor.da.y;
    floor.g = at.floor.g + at.offset * at.floor.dg, floor.dg = at.floor.dg;
    v = length(at.w);
    drive = length(floor.a);
    hold = at.grip.mu * abs(floor.g);
    if constexpr (elliptic) hold = larger(Real(1.0), at.grip.ratio * at.grip.ratio) * hold;
  }
  Real left() const { return at.length - at.offset; }

  // The slip goes on to the end of the segment beyond doubt: it does not end, follow the drive or lift off.
  [[gnu::always_inline]] Mask regular() const {
    const Real limit = left(), zero(0.0);
    Mask is = (limit > zero) & !may_follow(limit) & (v * at.over_speed > Real(0.1) * tolerance) & lasts() &
              (abs(at.u.x) + abs(at.u.y) + abs(at.w.x) + abs(at.w.y) < Real(plane_bound));
    if constexpr (shaken) is = is & (floor.g > zero) & (floor.g + limit * floor.dg > zero);
    return is;
  }

  // The slip covers more until its end than what PlaneSample::ends_within() computes in one, by a hundredth, as their sums round otherwise.
  [[gnu::always_inline]] Mask lasts() const {
    const Real allowed = Real(1.01 * (elliptic ? cut_off : 1.0)) * tolerance * at.size;
    const Real F = at.grip.mu * floor.g;
    if constexpr (!elliptic) {
      const Real rubs = F * v, ahead = dot(floor.a, at.w);
      return (F <= drive) | (rubs + ahead <= Real(0.0)) | (v * (rubs - ahead) > allowed * (F - drive) * (F + drive));
    }
    const Real m = at.grip.ratio * at.grip.ratio, v2 = v * v, y2 = m * at.w.y * at.w.y;
    const Real along = floor.a.x * at.w.x + m * floor.a.y * at.w.y;
    return v2 * v2 > allowed * (along * v + F * (at.w.x * at.w.x + m * y2));
  }

  // Whether it follows the drive is to be asked of driven_slip(): nothing here says that it does not, or misses too much of its direction.
  // To first order there theta' = G_t/(S + v'), S = -dG/dtheta.
  [[gnu::always_inline]] Mask may_follow(const Real& limit) const {
    const Mask slow = (v <= settles_in * drive * limit) & (at.offset >= at.asks);
    if (!Numbers::any(slow)) return slow;
    const Real F = at.grip.mu * floor.g, r = elliptic ? at.grip.ratio : Real(1.0), zero(0.0), v2 = v * v;
    const Real stiff = r * r - Real(1.0), anisotropy = F * stiff, qx = at.w.x, qy = r * at.w.y, Ay = r * floor.a.y;
    const Real ahead = (floor.a.x * qx + Ay * qy) * v, slows = ahead + F * v2 + anisotropy * qy * qy;  // times v^2
    const Real settles = anisotropy * (qx * qx - qy * qy) - ahead;
    const Real turns = (floor.a.x * qy - Ay * qx) * v - anisotropy * qx * qy;
    const Real changes = (floor.da.x * qy - r * floor.da.y * qx) * v - at.grip.mu * floor.dg * stiff * qx * qy;
    const Real lag = v2 * v * changes / (settles - slows), rate = length(floor.da) + at.grip.mu * abs(floor.dg);
    const Real lags = v * rate / (drive * drive);
    const Real angle = smaller(Numbers::sqrt(tolerance / (v * at.over_speed)), tolerance * at.size * drive / v2);
    return slow & ((v <= zero) | ((Real(driven_order - 1.0) * slows < Real(0.75) * settles) &
                                  (abs(turns - lag) <= Real(2.0) * v2 * drive * (angle + lags * lags))));
  }

  // A step up to `limit`, or as far as the last terms of its series are within the tolerance. False: it went beyond, and is to be cut
  // there.
  [[gnu::always_inline]] Mask expand(const Real& limit) {
    slip_series<elliptic, shaken>(floor, at.grip, at.weight, at.w, at.u, v, slip);
    const Real rate = drive + hold, longest(longest_exponent);
    const Real last = larger(larger(abs(slip.wx[N]) + abs(slip.wy[N]), abs(slip.v[N])) * at.over_speed,
                             larger((abs(slip.ux[N]) + abs(slip.uy[N])) * at.over_size, abs(slip.t[N]) * at.over_time));
    Mask found;
    const Real s = place(limit, rate, found);
    const Real s2 = s * s, s4 = s2 * s2;
    const Mask reaches = found & (last * (s4 * s4 * s2) <= tolerance) & (rate * s <= longest);
    h = s;
    tau = limit;
    if (!Numbers::any(!reaches)) return reaches;
    const Real reach = Numbers::root(!reaches, tolerance / last, N), full = longest / rate;
    h = Numbers::choose(reaches, s, Numbers::choose(reach < full, reach, full));
    tau = Numbers::choose(reaches, limit, slip.t.at(h));
    return reaches | (tau < limit);
  }

  // To the end of the step, where `goes`; the peaks on the way.
  [[gnu::always_inline]] void follow(const Mask& goes) {
    see_acceleration(goes);
    const Real path = slip.path.at(h), x = slip.ux.at(h), y = slip.uy.at(h);
    // No point of the way is farther than half of it beyond the mean of its ends.
    const Real ends = Numbers::sqrt(at.u.x * at.u.x + at.u.y * at.u.y) + Numbers::sqrt(x * x + y * y);
    const Mask far = goes & (Real(0.5) * (ends + path) > at.slip);
    if (Numbers::any(far)) {
      Series<Real, N> u2;
      for (int k = 0; k <= N; ++k) u2[k] = detail::square(slip.ux, k) + detail::square(slip.uy, k);
      const Real most = Numbers::most(far, u2, h, at.slip * at.slip);
      at.slip = Numbers::choose(far, larger(at.slip, Numbers::sqrt(most)), at.slip);
    }
    at.path = Numbers::choose(goes, at.path + path, at.path);
    at.w = {Numbers::choose(goes, slip.wx.at(h), at.w.x), Numbers::choose(goes, slip.wy.at(h), at.w.y)};
    at.u = {Numbers::choose(goes, x, at.u.x), Numbers::choose(goes, y, at.u.y)};
    at.offset = Numbers::choose(goes, at.offset + tau, at.offset);
  }

 private:
  static Real abs(const Real& x) {
    using std::abs;
    return abs(x);
  }
  static Real larger(const Real& a, const Real& b) { return Numbers::choose(a < b, b, a); }
  static Real smaller(const Real& a, const Real& b) { return Numbers::choose(b < a, b, a); }
  // Of a vector (x, r y).
  Real length(const Vector2<Real>& p) const {
    const Real y = elliptic ? at.grip.ratio * p.y : p.y;
    return Numbers::sqrt(p.x * p.x + y * y);
  }

  // Where the series has gone for the time `limit`: Halley's rule, from the root of a parabola. found: it has, within a step.
  [[gnu::always_inline]] Real place(const Real& limit, const Real& rate, Mask& found) const {
    const Real zero(0.0), longest(longest_exponent), close = Real(1e-5) * limit;
    const Real square = v * v + Real(2.0) * slip.v[1] * limit;
    Real s = Real(2.0) * limit / (v + Numbers::sqrt(larger(square, zero)));
    Mask sought = rate * s <= longest;
    found = sought & (zero > zero);
    for (int turn = 0; turn < 8 && Numbers::any(sought); ++turn) {
      Real time = slip.t[N], speed = zero, half_curvature = zero;
#pragma GCC unroll 16
      for (int k = N - 1; k >= 0; --k) {
        half_curvature = half_curvature * s + speed;
        speed = speed * s + time;
        time = time * s + slip.t[k];
      }
      const Real missed = time - limit;
      s = Numbers::choose(sought, s - missed * speed / (speed * speed - missed * half_curvature), s);
      const Mask there = abs(missed) <= close;  // and Halley's rule leaves the third power of what is missing
      found = found | (sought & there);
      sought = sought & !there & (speed > zero) & (s > zero) & (rate * s <= longest);
    }
    return s;
  }

  // At its ends, where friction is the same in all directions: there it is the root of a sum of squares of what is linear in time.
  [[gnu::always_inline]] void see_acceleration(const Mask& goes) {
    const Real before2 = at.acceleration * at.acceleration;
    Real most = before2;
    if constexpr (elliptic) {
      const Mask exceeds = goes & (size_of_rest<0>(slip.felt2, h) > before2);
      if (Numbers::any(exceeds))
        most = Numbers::choose(exceeds, Numbers::most(exceeds, slip.felt2, h, before2), before2);
    } else {
      most = larger(most, felt2(floor));
      if constexpr (shaken) most = larger(most, felt2(floor.later(tau)));
    }
    const Real peak = Numbers::choose(most > before2, Numbers::sqrt(most), at.acceleration);
    at.acceleration = Numbers::choose(goes, larger(at.acceleration, peak), at.acceleration);
  }
  Real felt2(const FloorAt<Real>& f) const {
    const Real rubs = at.grip.mu * f.g, lift = f.g - at.weight;
    return rubs * rubs + lift * lift;
  }
};

// The two or three channels of a record, segment by segment, along the axes of friction.
class PlaneRoad {
 public:
  PlaneRoad() = default;
  // axis: unit vector along which friction is mu. g: gravity [m/s2].
  PlaneRoad(const Shaking& shaking, const PlaneVector& axis, double g)
      : motion_(shaking.motion),
        shaken_(shaking.vertical_scale != 0 && !shaking.motion->vertical_mps2.empty()),
        scale_(shaking.scale),
        vertical_scale_(shaking.vertical_scale),
        stretch_(shaking.stretch),
        g_(g),
        axis_(axis) {}

  bool shaken() const { return shaken_; }
  bool over() const { return segment_ == motion_->segments(); }
  double start() const { return start_; }
  std::size_t segment() const { return segment_; }
  void go_to(std::size_t segment) {
    segment_ = segment;
    start_ = motion_->knot_s[segment] * stretch_;
  }
  double length() const { return motion_->knot_s[segment_ + 1] * stretch_ - start_; }
  // The floor at the start of the segment.
  PlaneFloor floor() const {
    if (over()) return {{0, 0}, {0, 0}, g_, 0};
    const double *x = motion_->horizontal_mps2.data() + 2 * segment_, *y = motion_->cross_mps2.data() + 2 * segment_;
    const double rate = scale_ / stretch_;
    const PlaneVector back{axis_.x, -axis_.y};
    PlaneFloor floor{turned_back({scale_ * x[0], scale_ * y[0]}, back), turned_back({rate * x[1], rate * y[1]}, back),
                     g_, 0};
    if (shaken_) {
      const double* v = motion_->vertical_mps2.data() + 2 * segment_;
      floor.g += vertical_scale_ * v[0];
      floor.dg = vertical_scale_ / stretch_ * v[1];
    }
    return floor;
  }
  // A run of segments starts here that holds a block at rest with friction mu, and in which it has no new peak of its acceleration.
  bool quiet_run(double mu, double peak) const {
    if (segment_ % FloorMotion::run_length != 0) return false;
    const std::size_t run = segment_ / FloorMotion::run_length;
    const double along = motion_->horizontal_run_mps2[run], across = motion_->cross_run_mps2[run];
    const double push2 = scale_ * scale_ * (along * along + across * across);
    const double lift = shaken_ ? std::abs(vertical_scale_) * motion_->vertical_run_mps2[run] : 0,
                 held = mu * (g_ - lift);
    return held > 0 && push2 < held * held && push2 + lift * lift <= peak * peak;
  }
  void skip_run() {
    const std::size_t end = segment_ + FloorMotion::run_length;
    go_to(end < motion_->segments() ? end : motion_->segments());
  }

 private:
  const FloorMotion* motion_ = nullptr;
  bool shaken_ = false;
  double scale_ = 1, vertical_scale_ = 0, stretch_ = 1, g_ = 0;
  PlaneVector axis_;
  std::size_t segment_ = 0;
  double start_ = 0;
};

}  // namespace freestand::dynamics
