#include "dynamics/plane_slide.hpp"

#include <algorithm>
#include <limits>

#include "dynamics/floor_cursor.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/plane_ellipse.hpp"
#include "dynamics/plane_history.hpp"
#include "dynamics/plane_peaks.hpp"
#include "dynamics/plane_slip.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = plane_order;

// A slip follows the drive where its direction settles, in the time |w|/A, this many times faster than the step lasts: then
// the terms of its series that are left out, each N |w|/(A h) times the last, vanish.
constexpr double settles_in = 0.25 / N;
// The floor may change by this share of F - A during what slip_end() computes with a floor that holds still.
constexpr double still_enough = 0.1;
// A step in s changes the speed by the factor e^2 at most.
constexpr double longest_exponent = 2;
constexpr int most_steps_a_segment = 1000000;

class PlaneSlide {
 public:
  PlaneSlide(const Setup& setup, const Settings& settings, History* history)
      : shaking_(setup.shaking),
        settings_(settings),
        mu_s_(setup.specimen.friction.mu_s),
        mu_k_(setup.specimen.friction.mu_k),
        grip_{mu_k_, setup.specimen.friction.ratio_across},
        elliptic_(grip_.ratio != 1),
        axis_(elliptic_
                  ? PlaneVector{std::cos(setup.specimen.friction.axis_rad), std::sin(setup.specimen.friction.axis_rad)}
                  : PlaneVector{1, 0}),
        g_(standard_gravity_mps2),
        force_zero_(1e-11 * g_),
        length_(setup.specimen.block.size_m()),
        speed_(length_ * setup.specimen.block.p_radps()),
        own_time_(1 / setup.specimen.block.p_radps()),
        instant_s_(1e-9 * own_time_),
        along_(shaking_, g_),
        across_(FloorCursor::across(shaking_)),
        peaks_(g_, mu_k_),
        history_(history, shaking_, axis_) {}

  Response run() {
    while (!finished_) {
      read_floor();
      if (mode_ == Mode::rest)
        rest();
      else if (mode_ == Mode::flight)
        fly();
      else
        slide();
      stop_when_done();
    }
    return result();
  }

 private:
  void read_floor() {
    const Floor<double, N> along = along_.local<N>();
    floor_.ax = along.a;
    floor_.g = along.g;
    floor_.ay = across_.local<N>().a;
    for (int k = 0; k <= N && axis_.y != 0; ++k) {
      const PlaneVector a = turned_back({floor_.ax[k], floor_.ay[k]}, {axis_.x, -axis_.y});
      floor_.ax[k] = a.x, floor_.ay[k] = a.y;
    }
    floor_.degree = along_.motion_over() ? 0 : shaking_.motion->degree;
    floor_.shakes_vertically = shaking_.vertical_scale != 0 && !shaking_.motion->vertical_mps2.empty();
    left_ = along_.motion_over() ? std::fmax(end_s() - along_.time(), 0.0) : along_.left();
  }
  double end_s() const { return shaking_.duration_s() + settings_.free_vibration_s; }
  double F() const { return elliptic_ ? grip_.hardest(floor_.g[0]) : mu_k_ * floor_.g[0]; }
  // |q| of elliptic friction.
  double speed_of(const PlaneVector& w) const { return elliptic_ ? grip_.speed(w) : size(w); }
  double drive() const { return elliptic_ ? size(grip_.scaled(floor_.a())) : size(floor_.a()); }

  void advance(double tau) {
    if (tau < left_ || along_.motion_over()) {
      along_.advance(tau);
      across_.advance(tau);
      return;
    }
    along_.next_segment();
    across_.next_segment();
    steps_ = 0;
  }

  // Rest.

  // mu_s^2 g'^2 - |a|^2, of elliptic friction with a_y/r: not below zero while the block is stuck.
  PlaneSeries grip() const {
    PlaneSeries grip;
    for (int k = 0; k <= N; ++k)
      grip[k] = mu_s_ * mu_s_ * product(floor_.g, floor_.g, k) - product(floor_.ax, floor_.ax, k) -
                product(floor_.ay, floor_.ay, k) / (grip_.ratio * grip_.ratio);
    return grip;
  }
  // Round-off of the grip, in the terms of the root search.
  ZeroTolerance grip_zero() const { return {0, 2 * force_zero_ * std::fmax(mu_s_ * floor_.g[0], force_zero_)}; }
  ZeroTolerance weight_zero() const { return {0, force_zero_}; }

  void pass_over_quiet() {
    const std::vector<double>& runs = shaking_.motion->cross_run_mps2;
    const bool passed = along_.pass_over([&](const FloorCursor::Bound& floor) {
      const double cross = std::abs(shaking_.scale) * runs[along_.segment() / FloorMotion::run_length];
      const double push = std::hypot(floor.a, cross), peak = peaks_.response().peak_acceleration_mps2;
      return push < mu_s_ * std::fmin(1.0, grip_.ratio) * (g_ - floor.v) &&
             push * push + floor.v * floor.v <= peak * peak;
    });
    if (!passed) return;
    const FloorCursor::Place place = along_.place();
    across_.go_to(place.left, place.start, place.offset);
  }

  void rest() {
    if (along_.motion_over()) return;
    if (!history_.wanted()) {
      pass_over_quiet();
      if (along_.motion_over()) return;
      read_floor();
    }
    double tau = left_, found = 0;
    const bool lifts = first_root(floor_.g, tau, weight_zero(), found);
    if (lifts) tau = found;
    const bool slips = first_root(grip(), tau, grip_zero(), found);
    if (slips) tau = found;
    go_at_rest(tau);
    if (slips)
      change(Mode::slide);
    else if (lifts)
      take_off();
  }

  void go_at_rest(double tau) {
    if (tau > 0) peaks_.observe_rest(floor_, tau);
    history_.rest(floor_, u_, along_.time(), tau);
    advance(tau);
  }

  // Slip.

  void slide() {
    if (++steps_ > most_steps_a_segment) return stop(Outcome::step_limit);
    double limit = left_, found = 0;
    const bool lifts = first_root(floor_.g, limit, weight_zero(), found);
    if (lifts && found == 0) return take_off();
    if (lifts) limit = found;
    if (ends_within(limit) || follows_drive(limit)) return;
    if (size(w_) == 0) return come_to_rest(std::fmin(limit, instant_s_));  // no floor acceleration gives a direction
    step_in_s(limit);
  }

  // The slip comes to its end within the step.
  bool ends_within(double limit) {
    const double v = size(w_), A = size(floor_.a());
    if (v == 0) return false;
    const double decelerates = elliptic_ ? slows(floor_, grip_, w_) : F() * v + dot(floor_.a(), w_);
    if (v <= 0.1 * settings_.tolerance * speed_ && decelerates > 0) {
      come_to_rest(0);
      return true;
    }
    if (elliptic_ || !(A < F())) return false;
    const SlipEnd end = slip_end(floor_.a(), F(), w_);
    const double changes = (std::hypot(floor_.ax[1], floor_.ay[1]) + mu_k_ * std::abs(floor_.g[1])) * end.after_s;
    const bool still = along_.motion_over() ||
                       (v * end.after_s <= settings_.tolerance * length_ && changes <= still_enough * (F() - A));
    if (!still || end.after_s > limit) return false;
    history_.end(floor_, u_, w_, end.covers_m, along_.time(), end.after_s);
    peaks_.observe_friction(floor_, end.after_s);
    u_.x += end.covers_m.x;
    u_.y += end.covers_m.y;
    peaks_.observe_end(end, u_);
    come_to_rest(end.after_s);
    return true;
  }

  void come_to_rest(double tau) {
    w_ = {};
    advance(tau);
    read_floor();
    const bool slips = sign_after(grip(), grip_zero()) < 0;
    change(slips ? Mode::slide : Mode::rest);
    peaks_.response().events += slips;  // it starts again at once
  }

  // A step in time of a slip that follows the drive.
  bool follows_drive(double limit) {
    const double v = speed_of(w_), A = drive();
    if (v > settles_in * A * limit || !(limit > 0)) return false;
    DrivenSlip driven;
    if (!(elliptic_ ? elliptic_driven_slip(floor_, grip_, w_, u_, g_, force_zero_, driven)
                    : driven_slip(floor_, mu_k_, w_, u_, force_zero_, driven)))
      return false;
    const double turned = std::abs(driven.turned), tolerance = settings_.tolerance;
    // The direction settles within about v/A, and takes along what it loses of the speed and of the place.
    if (v * turned * (turned + driven.bends) > tolerance * speed_ ||
        v * v * turned > tolerance * length_ * driven.settles)
      return false;
    double h = limit;
    for (int turn = 0;; ++turn) {
      const double fastest = std::abs(driven.slip.v[0]) + size_of_rest<1>(driven.slip.v, h);
      const double missed =
          (std::abs(driven.slip.v[N]) * std::pow(h, N) + fastest * std::abs(driven.last_angle) * std::pow(h, N - 1)) /
          (tolerance * speed_);
      if (missed <= 1) break;
      if (turn == 20) return false;
      h *= 0.95 * std::pow(missed, -1.0 / N);
    }
    if (v > settles_in * driven.settles * h) return false;
    double found = 0;
    const bool stops = first_root(driven.slip.v, h, ZeroTolerance{1, 0.0}, found);
    if (stops && found == 0) {  // it does not start
      come_to_rest(std::fmin(h, instant_s_));
      return true;
    }
    if (stops) h = found;
    step_along(driven.slip, h, h);
    if (stops) come_to_rest(0);
    return true;
  }

  // The series in s to the end of the step, or as far as its last terms are within the tolerance.
  void step_in_s(double limit) {
    const double rate = drive() + std::abs(F()), to_knot = rate * limit / speed_of(w_);
    if (!elliptic_ && to_knot < longest_exponent && step_with<short_order>(limit, to_knot)) return;
    step_with<N>(limit, longest_exponent);
  }

  // False: it would not come to `limit`, which is `exponent` away.
  template <int M>
  bool step_with(double limit, double exponent) {
    const double x = exponent * exponent;
    if (M < N && x * x * x > 720 * settings_.tolerance * speed_ / size(w_)) return false;
    const SlipSeries slip =
        elliptic_ ? elliptic_slip(floor_, grip_, w_, u_, g_) : slip_series(floor_, mu_k_, w_, u_, M);
    double h = longest_exponent / (drive() + std::abs(F()));
    const double last =
        std::fmax(std::fmax(std::hypot(slip.wx[M], slip.wy[M]), std::abs(slip.v[M])) / speed_,
                  std::fmax(std::hypot(slip.ux[M], slip.uy[M]) / length_, std::abs(slip.t[M]) / own_time_));
    if (last > 0) h = std::fmin(h, std::pow(settings_.tolerance / last, 1.0 / M));
    double tau = slip.t.at(h);
    if (!(tau < limit)) {
      h = place_in_series(slip, limit, h);
      tau = limit;
    } else if (M < N) {
      return false;
    }
    step_along(slip, h, tau);
    return true;
  }

  // To the place h of the series, at time tau.
  void step_along(const SlipSeries& slip, double h, double tau) {
    if (elliptic_)
      peaks_.observe_friction(slip, h);
    else
      peaks_.observe_friction(floor_, tau);
    peaks_.observe_slip(slip, h);
    history_.along(slip, floor_, along_.time(), h, tau, Mode::slide);
    w_ = {slip.wx.at(h), slip.wy.at(h)};
    u_ = {slip.ux.at(h), slip.uy.at(h)};
    advance(tau);
  }

  // Flight.

  void take_off() {
    y_ = vy_ = 0;
    change(Mode::flight);
  }

  void fly() {
    const SlipSeries path = free_slip(floor_, w_, u_);
    PlaneSeries y, vy;
    y[0] = y_;
    vy[0] = vy_;
    for (int k = 0; k < N; ++k) {
      y[k + 1] = vy[k] / (k + 1);
      vy[k + 1] = -floor_.g[k] / (k + 1);
    }
    double tau = left_, found = 0;
    const bool lands = first_root(y, tau, ZeroTolerance{2, force_zero_}, found);
    if (lands) tau = found;
    peaks_.observe_flight(path, tau);
    peaks_.observe_fall();
    history_.along(path, floor_, along_.time(), tau, tau, Mode::flight);
    w_ = {path.wx.at(tau), path.wy.at(tau)};
    u_ = {path.ux.at(tau), path.uy.at(tau)};
    y_ = y.at(tau);
    vy_ = vy.at(tau);
    advance(tau);
    if (lands) land();
  }

  // The floor stops the block's fall by an impulse, against which friction takes what it can of the slip.
  void land() {
    const double push = std::abs(vy_), v = size({w_.x, w_.y / grip_.ratio});
    const double kept = v <= mu_s_ * push ? 0.0 : std::fmax(v - mu_k_ * push, 0.0) / v;
    w_ = elliptic_ && kept > 0 ? slip_after_push(grip_, w_, push) : PlaneVector{w_.x * kept, w_.y * kept};
    ++peaks_.response().impacts;
    read_floor();
    const bool slips = kept > 0 || sign_after(grip(), grip_zero()) < 0;
    if (sign_after(floor_.g, weight_zero()) < 0)
      take_off();
    else
      change(slips ? Mode::slide : Mode::rest, true);
  }

  // Life.

  void change(Mode to, bool impact = false) {
    history_.event({along_.time(), mode_, to, 0, impact});
    if (to == Mode::rest) w_ = {};
    if (to != mode_ || impact) ++peaks_.response().events;
    moved_ = moved_ || to != Mode::rest;
    mode_ = to;
    if (++changes_ >= settings_.event_limit) stop(Outcome::step_limit);
  }
  void stop(Outcome outcome) {
    outcome_ = outcome;
    finished_ = true;
  }
  void stop_when_done() {
    for (const double value : {u_.x, u_.y, w_.x, w_.y, y_, vy_, peaks_.response().peak_acceleration_mps2})
      if (!(std::abs(value) < beyond_all_bounds)) return stop(Outcome::not_finite);
    if (finished_ || !along_.motion_over()) return;
    if (mode_ == Mode::rest || along_.time() >= end_s()) stop(moved_ ? Outcome::moved : Outcome::at_rest);
  }
  Response result() {
    peaks_.response().outcome = outcome_;
    const PlaneVector residual = turned_back(u_, axis_);
    peaks_.response().residual_slip_m = residual.x;
    peaks_.response().residual_cross_slip_m = residual.y;
    peaks_.response().end_time_s = along_.time();
    if (outcome_ == Outcome::at_rest || outcome_ == Outcome::moved) history_.hold(u_, mode_);
    return peaks_.response();
  }

  const Shaking shaking_;
  const Settings settings_;
  const double mu_s_, mu_k_;
  const EllipticGrip grip_;
  const bool elliptic_;     // else as with the same friction in all directions
  const PlaneVector axis_;  // of grip_, along which a, u and w have their x
  const double g_, force_zero_, length_, speed_, own_time_, instant_s_;
  FloorCursor along_, across_;
  PlaneFloor floor_;
  double left_ = 0;  // to the next knot, or to the end of the time given [s]
  Mode mode_ = Mode::rest;
  PlaneVector u_, w_;
  double y_ = 0, vy_ = 0;  // height over the floor in flight
  PlanePeaks peaks_;
  PlaneHistory history_;
  Outcome outcome_ = Outcome::moved;
  bool finished_ = false, moved_ = false;
  int steps_ = 0, changes_ = 0;
};

}  // namespace

std::string refusal_in_plane(const Specimen& specimen) {
  if (specimen.model != Model::slide) return "a block is followed in both horizontal directions where it only slides";
  if (!specimen.start.upright_at_rest()) return "in the plane a block begins at rest where it is counted from";
  if (specimen.neighbour) return "two blocks side by side are followed along one line";
  if (specimen.legs) return "a block on legs that give way is followed along one line";
  for (const EffectUse& use : specimen.effects) {
    FloorInput floor;
    if (use.effect->floor) use.effect->floor(floor, use.parameters);
    if (use.effect->dynamic() || floor.push_mps2 != 0 || floor.gravity_factor != 1)
      return "the law of effect " + use.effect->name + " is along one line, and not known in the plane";
  }
  return "";
}

Response respond_in_plane(const Setup& setup, const Settings& settings, History* history) {
  const FloorMotion& motion = *setup.shaking.motion;
  const bool shaped = motion.degree <= plane_degree && motion.cross_mps2.size() == motion.horizontal_mps2.size() &&
                      !motion.cross_run_mps2.empty();
  const bool sound = shaped && setup.specimen.model == Model::slide && !has_laws(setup.specimen) &&
                     setup.floor.push_mps2 == 0 && setup.floor.gravity_factor == 1 && admissible(setup, settings);
  if (!sound) return Response{.outcome = Outcome::not_finite};
  return PlaneSlide(setup, settings, history).run();
}

}  // namespace freestand::dynamics
