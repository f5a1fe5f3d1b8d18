#include "dynamics/plane_sample.hpp"

#include <algorithm>

#include "base/units.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = plane_order, D = driven_order;
// The floor may change by this share of F - A during what slip_end() computes with a floor that holds still.
constexpr double still_enough = 0.1;
// A slip that does not follow the drive is asked again after this share of the step.
constexpr double ask_again = 0.2;

PlaneVector axis_of(const Friction& friction) {
  if (friction.ratio_across == 1) return {1, 0};
  return {std::cos(friction.axis_rad), std::sin(friction.axis_rad)};
}

}  // namespace

PlaneSample::PlaneSample(const Setup& setup, const Settings& settings, History* history)
    : shaking_(setup.shaking),
      settings_(settings),
      mu_s_(setup.specimen.friction.mu_s),
      g_(standard_gravity_mps2),
      force_zero_(1e-11 * g_),
      instant_s_(1e-9 / setup.specimen.block.p_radps()),
      axis_(axis_of(setup.specimen.friction)),
      road_(shaking_, axis_, g_),
      state_{},
      history_(history, shaking_, axis_) {
  const Block& block = setup.specimen.block;
  state_.grip = {setup.specimen.friction.mu_k, setup.specimen.friction.ratio_across};
  state_.weight = g_;
  state_.size = block.size_m();
  state_.over_speed = 1 / (block.size_m() * block.p_radps());
  state_.over_size = 1 / block.size_m();
  state_.over_time = block.p_radps();
  enter_segment();
}

void PlaneSample::turn() {
  look();
  if (mode_ == Mode::rest)
    rest();
  else if (mode_ == Mode::flight)
    fly();
  else
    slide();
  stop_when_done();
}

void PlaneSample::look() {
  floor_ = state_.floor.later(state_.offset);
  left_ = std::fmax(road_.over() ? end_s() - time() : state_.length - state_.offset, 0.0);
}

void PlaneSample::enter_segment() {
  state_.offset = state_.asks = 0;
  state_.floor = road_.floor();
  state_.length = road_.over() ? std::numeric_limits<double>::infinity() : road_.length();
  steps_ = 0;
}

void PlaneSample::next_segment() {
  road_.go_to(road_.segment() + 1);
  enter_segment();
}

void PlaneSample::advance(double tau) {
  if (tau < left_ || road_.over())
    state_.offset += tau;
  else
    next_segment();
}

// Rest.

// mu_s^2 g'^2 - |a|^2, of elliptic friction with a_y/r: not below zero while the block is stuck.
Series<double, 2> PlaneSample::grip() const {
  const PlaneFloor& f = floor_;
  const double mu2 = mu_s_ * mu_s_, r2 = state_.grip.ratio * state_.grip.ratio;
  return {{mu2 * f.g * f.g - f.a.x * f.a.x - f.a.y * f.a.y / r2,
           2 * (mu2 * f.g * f.dg - f.a.x * f.da.x - f.a.y * f.da.y / r2),
           mu2 * f.dg * f.dg - f.da.x * f.da.x - f.da.y * f.da.y / r2}};
}
// Round-off of the grip, in the terms of the root search.
ZeroTolerance PlaneSample::grip_zero() const { return {0, 2 * force_zero_ * std::fmax(mu_s_ * floor_.g, force_zero_)}; }

// Where g' is steady, |a|^2 bends upwards between knots.
void PlaneSample::pass_over_quiet() {
  const double r2 = state_.grip.ratio * state_.grip.ratio, hold2 = (1 - 1e-9) * mu_s_ * mu_s_ * g_ * g_;
  const auto pull2 = [&](const PlaneFloor& f) { return f.a.x * f.a.x + f.a.y * f.a.y / r2; };
  for (; !road_.over(); look()) {
    if (state_.offset == 0 && road_.quiet_run(mu_s_ * std::fmin(1.0, state_.grip.ratio), state_.acceleration)) {
      road_.skip_run();
      enter_segment();
    } else if (!shaken() && std::fmax(pull2(floor_), pull2(floor_.later(left_))) < hold2) {
      observe_felt(left_);
      next_segment();
    } else {
      return;
    }
  }
}

void PlaneSample::rest() {
  if (road_.over()) return;
  if (!history_.wanted()) {
    pass_over_quiet();
    if (road_.over()) return;
  }
  double tau = left_, found = 0;
  const Series<double, 1> weight{{floor_.g, floor_.dg}};
  const bool lifts = first_root(weight, tau, ZeroTolerance{0, force_zero_}, found);
  if (lifts) tau = found;
  const bool slips = first_root(grip(), tau, grip_zero(), found);
  if (slips) tau = found;
  if (tau > 0) observe_felt(tau);
  history_.rest(floor_, state_.u, time(), tau);
  advance(tau);
  if (slips)
    change(Mode::slide);
  else if (lifts)
    take_off();
}

// Slip.

template <class Use>
auto PlaneSample::with_step(Use&& use) {
  const double tolerance = settings_.tolerance;
  if (elliptic())
    return shaken() ? use(Step<true, true>(state_, tolerance)) : use(Step<true, false>(state_, tolerance));
  return shaken() ? use(Step<false, true>(state_, tolerance)) : use(Step<false, false>(state_, tolerance));
}

void PlaneSample::slide() {
  if (++steps_ > most_steps_a_segment) return stop(Outcome::step_limit);
  double limit = left_, found = 0;
  const Series<double, 1> weight{{floor_.g, floor_.dg}};
  const bool lifts = first_root(weight, limit, ZeroTolerance{0, force_zero_}, found);
  if (lifts && found == 0) return take_off();
  if (lifts) limit = found;
  if (ends_within(limit)) return;
  if (may_follow(limit)) {
    if (follows_drive(limit)) return;
    if (size(state_.w) > 0) state_.asks = state_.offset + ask_again * limit;
  }
  if (size(state_.w) == 0)
    return come_to_rest(std::fmin(limit, instant_s_));  // no floor acceleration gives a direction
  step_in_s(limit);
}

// The slip comes to its end within the step.
bool PlaneSample::ends_within(double limit) {
  const PlaneVector& w = state_.w;
  const Grip<double>& grip = state_.grip;
  const double v = size(w), tolerance = settings_.tolerance;
  if (v == 0) return false;
  const double F = grip.mu * floor_.g, slow = slows(floor_, grip, w);
  if (v * state_.over_speed <= 0.1 * tolerance && slow > 0) {
    come_to_rest(0);
    return true;
  }
  const double m = grip.ratio * grip.ratio, A = size({floor_.a.x, floor_.a.y / grip.ratio});  // to be held by F
  if (!(A < F) || !(slow > 0)) return false;
  const double q = size(grip.scaled(w)), left = elliptic() ? slow / q : F - A;
  const SlipEnd end = elliptic() ? SlipEnd{q / left, 0, {}} : slip_end(floor_.a, F, w);
  const double changes = std::fmax(1.0, m) * (size(floor_.da) + grip.mu * std::abs(floor_.dg)) * end.after_s;
  const double allowed = (elliptic() ? cut_off : 1.0) * tolerance * state_.size;
  const bool still = q * end.after_s <= allowed && changes <= still_enough * left;
  if (!(still || (road_.over() && !elliptic())) || end.after_s > limit) return false;
  history_.end(floor_, state_.u, w, end.covers_m, time(), end.after_s);
  observe_friction(end.after_s);
  state_.u.x += end.covers_m.x;
  state_.u.y += end.covers_m.y;
  state_.path += end.path_m;
  state_.slip = std::fmax(state_.slip, size(state_.u));
  come_to_rest(end.after_s);
  return true;
}

void PlaneSample::come_to_rest(double tau) {
  state_.w = {};
  state_.asks = 0;
  advance(tau);
  look();
  const bool slips = sign_after(grip(), grip_zero()) < 0;
  change(slips ? Mode::slide : Mode::rest);
  response_.events += slips;  // it starts again at once
}

bool PlaneSample::may_follow(double limit) {
  return limit > 0 && with_step([&](auto step) {
           step.look();
           return step.may_follow(limit);
         });
}

// A step in time of a slip that follows the drive.
bool PlaneSample::follows_drive(double limit) {
  const Grip<double>& grip = state_.grip;
  const double v = size(grip.scaled(state_.w)), tolerance = settings_.tolerance, speed = 1 / state_.over_speed;
  DrivenSlip driven;
  if (!driven_slip(floor_, grip, state_.w, state_.u, g_, force_zero_, limit, 1e-3 * tolerance * speed, driven))
    return false;
  const double turned = driven.turned;
  // The direction settles within about v/A, and takes along what it loses of the speed and of the place.
  if (v * turned * (turned + driven.bends) > tolerance * speed ||
      v * v * turned > tolerance * state_.size * driven.settles)
    return false;
  double h = cut(driven, limit);
  if (!(h > 0)) return false;
  double found = 0;
  Series<double, D> speeds;
  std::copy_n(driven.slip.v.c, D + 1, speeds.c);
  const bool stops = first_root(speeds, h, ZeroTolerance{1, 0.0}, found);
  if (stops && found == 0) {  // it does not start
    come_to_rest(std::fmin(h, instant_s_));
    return true;
  }
  if (stops) h = found;
  observe_friction(h);
  const double path = driven.slip.path.at(h);
  state_.path += path;
  if (size(state_.u) + path > state_.slip) observe_place(driven.slip, h);
  if (elliptic())
    state_.acceleration = std::sqrt(max_of(driven.slip.felt2, h, state_.acceleration * state_.acceleration));
  history_.along(driven.slip, floor_, time(), h, h, Mode::slide);
  state_.w = {driven.slip.wx.at(h), driven.slip.wy.at(h)};
  state_.u = {driven.slip.ux.at(h), driven.slip.uy.at(h)};
  advance(h);
  if (stops) come_to_rest(0);
  return true;
}

// As far as its series is good; 0: no step of use.
double PlaneSample::cut(const DrivenSlip& driven, double limit) const {
  double h = limit;
  for (int turn = 0; turn < 20; ++turn) {
    const double fastest = std::abs(driven.slip.v[0]) + size_of_rest<1>(driven.slip.v, h);
    const double missed = (std::abs(driven.slip.v[D]) * h + fastest * std::abs(driven.last_angle)) *
                          std::pow(h, D - 1) * state_.over_speed / settings_.tolerance;
    if (missed <= 1) return h;
    h *= 0.95 * std::pow(missed, -1.0 / D);
  }
  return 0;
}

void PlaneSample::step_in_s(double limit) {
  with_step([&](auto step) {
    const double start = time();
    step.look();
    if (!step.expand(limit)) {
      step.h = place_in_series(step.slip, limit, step.h);
      step.tau = limit;
    }
    step.follow(true);
    history_.along(step.slip, floor_, start, step.h, step.tau, Mode::slide);
    if (!(step.tau < left_) && !road_.over()) next_segment();
  });
}

bool PlaneSample::marches() {
  if (mode_ != Mode::slide || road_.over()) return false;
  return with_step([](auto step) {
    step.look();
    return step.regular();
  });
}

void PlaneSample::marched(int steps) {
  steps_ = steps;
  stop_when_done();
}

// Flight.

void PlaneSample::take_off() {
  y_ = vy_ = 0;
  change(Mode::flight);
}

void PlaneSample::fly() {
  const SlipSeries<double> path = free_slip(floor_, state_.w, state_.u);
  const Series<double, 3> y{{y_, vy_, -0.5 * floor_.g, -floor_.dg / 6}}, vy{{vy_, -floor_.g, -0.5 * floor_.dg, 0}};
  double tau = left_, found = 0;
  const bool lands = first_root(y, tau, ZeroTolerance{2, force_zero_}, found);
  if (lands) tau = found;
  observe_place(path, tau);
  state_.acceleration = std::fmax(state_.acceleration, g_);
  history_.along(path, floor_, time(), tau, tau, Mode::flight);
  state_.w = {path.wx.at(tau), path.wy.at(tau)};
  state_.u = {path.ux.at(tau), path.uy.at(tau)};
  y_ = y.at(tau);
  vy_ = vy.at(tau);
  advance(tau);
  if (lands) land();
}

// The floor stops the block's fall by an impulse, against which friction takes what it can of the slip.
void PlaneSample::land() {
  PlaneVector& w = state_.w;
  const Grip<double>& friction = state_.grip;
  const double push = std::abs(vy_), v = size({w.x, w.y / friction.ratio});
  const double kept = v <= mu_s_ * push ? 0.0 : std::fmax(v - friction.mu * push, 0.0) / v;
  w = elliptic() && kept > 0 ? slip_after_push(friction, w, push) : PlaneVector{w.x * kept, w.y * kept};
  ++response_.impacts;
  look();
  const bool slips = kept > 0 || sign_after(grip(), grip_zero()) < 0;
  if (sign_after(Series<double, 1>{{floor_.g, floor_.dg}}, ZeroTolerance{0, force_zero_}) < 0)
    take_off();
  else
    change(slips ? Mode::slide : Mode::rest, true);
}

// Peaks. At rest the block has the acceleration of the floor; slipping, that of friction, here where it is the same in all directions:
// roots of sums of squares of what is linear in time, whose largest values are at the ends.

void PlaneSample::observe_felt(double tau) {
  const auto felt2 = [&](const PlaneFloor& f) { return dot(f.a, f.a) + (f.g - g_) * (f.g - g_); };
  const double most = std::max(felt2(floor_), felt2(floor_.later(tau)));
  if (most > state_.acceleration * state_.acceleration)
    state_.acceleration = std::fmax(state_.acceleration, std::sqrt(most));
}

void PlaneSample::observe_friction(double tau) {
  if (elliptic()) return;
  for (const PlaneFloor& f : {floor_, floor_.later(tau)})
    state_.acceleration = std::fmax(state_.acceleration, std::hypot(state_.grip.mu * f.g, f.g - g_));
}

void PlaneSample::observe_place(const SlipSeries<double>& slip, double h) {
  PlaneSeries squared;
  for (int k = 0; k <= N; ++k) squared[k] = detail::square(slip.ux, k) + detail::square(slip.uy, k);
  state_.slip = std::fmax(state_.slip, std::sqrt(max_of(squared, h, state_.slip * state_.slip)));
}

// The trajectory.

void PlaneSample::change(Mode to, bool impact) {
  history_.event({time(), mode_, to, 0, impact});
  if (to == Mode::rest) state_.w = {};
  if (to != mode_ || impact) ++response_.events;
  moved_ = moved_ || to != Mode::rest;
  mode_ = to;
  if (++changes_ >= settings_.event_limit) stop(Outcome::step_limit);
}

void PlaneSample::stop(Outcome outcome) {
  outcome_ = outcome;
  finished_ = true;
}

void PlaneSample::stop_when_done() {
  for (const double value : {state_.u.x, state_.u.y, state_.w.x, state_.w.y, y_, vy_, state_.acceleration})
    if (!(std::abs(value) < plane_bound)) return stop(Outcome::not_finite);
  if (finished_ || !road_.over()) return;
  if (mode_ == Mode::rest || time() >= end_s()) stop(moved_ ? Outcome::moved : Outcome::at_rest);
}

Response PlaneSample::result() {
  response_.outcome = outcome_;
  const PlaneVector residual = turned_back(state_.u, axis_);
  response_.residual_slip_m = residual.x;
  response_.residual_cross_slip_m = residual.y;
  response_.peak_slip_m = state_.slip;
  response_.slid_path_m = state_.path;
  response_.peak_acceleration_mps2 = state_.acceleration;
  response_.end_time_s = time();
  if (outcome_ == Outcome::at_rest || outcome_ == Outcome::moved) history_.hold(state_.u, mode_);
  return response_;
}

}  // namespace freestand::dynamics
