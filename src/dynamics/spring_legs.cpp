#include "dynamics/spring_legs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/floor_cursor.hpp"
#include "dynamics/history_recorder.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/overturned.hpp"
#include "dynamics/peaks.hpp"
#include "dynamics/roots.hpp"
#include "dynamics/spring_sway.hpp"
#include "dynamics/step_watch.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = sway_order;
using Line = SwaySeries;

class OnSpringLegs {
 public:
  OnSpringLegs(const Setup& setup, const Settings& settings, History* history)
      : rig_(setup.specimen, settings, setup.floor),
        shaking_(setup.shaking),
        settings_(settings),
        rate_(2 * pi * setup.specimen.legs->frequency_hz),
        length_(setup.specimen.block.size_m()),
        own_rate_(setup.specimen.block.p_radps()),
        base_{0.5 * rate_ * rate_,
              setup.specimen.legs->damping * rate_,
              {{{rig_.right, rig_.g * rig_.left / (rig_.left + rig_.right)},
                {-rig_.left, rig_.g * rig_.right / (rig_.left + rig_.right)}}}},
        legs_(base_.legs),
        force_zero_(std::fmax(rig_.force_zero, 1e-14 * base_.stiffness * length_ * own_rate_)),
        cursor_(shaking_, rig_.g),
        peaks_(settings),
        recorder_(history, rig_) {}

  Response run() {
    while (!finished_) step();
    return result();
  }

 private:
  double end_s() const { return shaking_.duration_s() + settings_.free_vibration_s; }
  // Of an upright block the edge that was the lower one.
  int lower() const { return at_.theta != 0 ? (at_.theta > 0 ? 1 : -1) : foot_ != 0 ? foot_ : at_.omega < 0 ? -1 : 1; }
  bool both() const { return legs_[0].on && legs_[1].on; }
  // +1: right, -1: left, 0: none.
  int carrying() const { return both() ? lower() : legs_[0].on ? 1 : legs_[1].on ? -1 : 0; }
  const Leg& leg(int foot) const { return legs_[foot > 0 ? 0 : 1]; }

  void equations(const Floor<double, N>& floor, int foot, int sigma, Sway& s) const {
    sway(rig_, base_, at_, floor, (foot != 0 ? foot : lower()) > 0 ? 0 : 1, foot != 0 && sigma == 0, sigma, s);
  }

  double length_of_step(const Sway& s, double left) const {
    const double whole = std::fmin(left, std::fmin(1 / own_rate_, 1 / rate_)), speed = own_rate_ * length_;
    const double last = std::max({std::abs(s.theta[N]), std::abs(s.omega[N]) / own_rate_, std::abs(s.x[N]) / length_,
                                  std::abs(s.vx[N]) / speed, std::abs(s.y[N]) / length_, std::abs(s.vy[N]) / speed});
    const double size = rig_.half_base() / rig_.h;  // rotations matter as shares of the slenderness
    return std::fmin(whole, last > 0 ? std::pow(settings_.tolerance * std::fmin(size, 1.0) / last, 1.0 / N) : whole);
  }

  // Steps, and what ends them.

  enum class Happening {
    nothing,
    lets_go,
    pushes_again,
    rises,
    comes_down,
    levels,
    stops,
    slips_right,
    slips_left,
    falls
  };
  struct Found {
    Happening what = Happening::nothing;
    std::size_t leg = 0;
    double tau;
  };

  Found first_event(const Sway& s, double h) const {
    Found found{.tau = h};
    const auto look = [&](Line witness, ZeroTolerance zero, Happening what, std::size_t leg = 0,
                          bool from_zero = false) {
      double tau = 0;
      if (from_zero) witness[0] = 0;
      if (first_root(witness, found.tau, zero, tau) && (found.what == Happening::nothing || tau < found.tau))
        found = {what, leg, tau};
    };
    // Friction changes the acceleration of its foot by 1 + r_y^2/k^2 times itself.
    const ZeroTolerance force{0, force_zero_}, speed{1, force_zero_ * (1 + length_ * length_ / rig_.k2)},
        length{2, force_zero_}, rotation{2, force_zero_ / length_};
    // The lower side first, so that the mirror image of a sample goes the same way, to the bit.
    const int first = lower();
    for (const int side : {first, -first}) {
      const std::size_t i = side > 0 ? 0 : 1;
      const Leg& leg = legs_[i];
      Line over = s.rise[i];
      over[0] -= leg.stands_on / base_.stiffness;
      if (leg.on) {
        look(s.push[i], force, Happening::lets_go, i, leg.begins_at_zero);
      } else if (leg.over_floor) {
        look(over, length, Happening::comes_down, i, leg.begins_at_zero);
      } else {
        look(scaled(-1.0, s.push[i]), force, Happening::pushes_again, i, leg.begins_at_zero);
        look(scaled(-1.0, over), length, Happening::rises, i);
      }
    }
    if (both()) look(scaled(double(foot_), s.theta), rotation, Happening::levels);
    if (foot_ != 0 && sigma_ != 0) look(scaled(double(sigma_), s.arc.w), speed, Happening::stops, 0, slip_begins_);
    for (const int way : {first, -first})
      if (foot_ != 0 && sigma_ == 0)
        look(combination(rig_.mu_s, s.total, double(way), s.arc.fx), force,
             way > 0 ? Happening::slips_right : Happening::slips_left);
    Line upright = scaled(at_.theta < 0 ? 1.0 : -1.0, s.theta);
    upright[0] += pi / 2;
    look(upright, rotation, Happening::falls);
    return found;
  }

  void step() {
    const Floor<double, N> floor = cursor_.local<N>();
    const double left = cursor_.motion_over() ? std::fmax(end_s() - cursor_.time(), 0.0) : cursor_.left();
    equations(floor, foot_, sigma_, sway_);
    const double h = length_of_step(sway_, left);
    const Found found = first_event(sway_, h);
    go(floor, found.tau);
    if (found.what != Happening::nothing)
      happen(found);
    else if (h == left && !cursor_.motion_over())
      cursor_.next_segment(), watch_.steps = 0;
    stop_when_done();
  }

  void go(const Floor<double, N>& floor, double tau) {
    State seen;
    seen.theta = at_.theta;
    seen.omega = at_.omega;
    seen.pivot = foot_ != 0 ? foot_ : lower();
    seen.sigma = sigma_;
    seen.mode = mode();
    recorder_.record(seen, sway_.arc, floor, cursor_.time(), tau);
    if (seen.mode == Mode::rest) seen.mode = Mode::rock;  // it turns
    peaks_.observe(rig_, seen, sway_.arc, tau);
    if (!(tau > 0)) return;
    if (foot_ == 0) flown_ += std::abs(sway_.x.at(tau) - at_.x);
    const double stands_at = sway_.arc.xi[0];
    at_.x = sway_.x.at(tau), at_.y = sway_.y.at(tau), at_.theta = sway_.theta.at(tau);
    at_.vx = sway_.vx.at(tau), at_.vy = sway_.vy.at(tau), at_.omega = sway_.omega.at(tau);
    if (foot_ != 0 && sigma_ == 0) stand_at(stands_at);
    cursor_.advance(tau);
    slip_begins_ = false;
    for (Leg& leg : legs_) leg.begins_at_zero = false;
  }

  Arm<double> over_foot(int foot) const {
    const Rotation<double> r = rotation_by(at_.theta);
    const double c = leg(foot).offset;
    return {rig_.h * r.sine - c * r.cosine, c * r.sine + rig_.h * r.cosine};
  }
  // The foot that carries stands still, xi from where it stood first.
  void stand_at(double xi) {
    const Arm<double> r = over_foot(foot_);
    at_.x = xi + r.rx + leg(foot_).offset;
    at_.vx = r.ry * at_.omega;
  }

  void happen(const Found& found) {
    Leg& leg = legs_[found.leg];
    const Mode before = mode();
    switch (found.what) {
      case Happening::lets_go:
        leg.on = false;
        leg.over_floor = base_.dashpot == 0;
        leg.begins_at_zero = true;
        moved_ = true;
        break;
      case Happening::pushes_again:
        leg.on = leg.begins_at_zero = true;
        break;
      case Happening::rises:
        leg.over_floor = leg.begins_at_zero = true;
        break;
      case Happening::comes_down:
        leg.on = true;
        leg.over_floor = false;
        leg.begins_at_zero = base_.dashpot == 0;
        ++peaks_.response().impacts;
        break;
      case Happening::levels:
        at_.theta = 0;
        take_over(-foot_);
        break;
      case Happening::stops:
        at_.vx = over_foot(foot_).ry * at_.omega;
        hold_or_slip();
        break;
      case Happening::slips_right:
      case Happening::slips_left:
        slip(found.what == Happening::slips_right ? 1 : -1);
        break;
      case Happening::falls:
        tell(before, false, Mode::overturned);
        return stop(Outcome::overturned);
      case Happening::nothing:
        break;
    }
    if (carrying() != foot_) take_over(carrying());
    if (mode() != before || found.what == Happening::comes_down)
      tell(before, found.what == Happening::comes_down, mode());
    if (++happened_ >= settings_.event_limit) stop(Outcome::step_limit);
  }

  void slip(int sigma) {
    sigma_ = sigma;
    slip_begins_ = true;
    moved_ = true;
  }
  // The foot has come to a stop.
  void hold_or_slip() {
    Sway held{};
    equations(cursor_.local<N>(), foot_, 0, held);
    const ZeroTolerance force{0, force_zero_};
    sigma_ = 0;
    for (const int way : {1, -1})
      if (sign_after(combination(rig_.mu_s, held.total, double(way), held.arc.fx), force) < 0) return slip(way);
  }
  // Another foot carries: it stands, or goes, as the block has it.
  void take_over(int foot) {
    const bool held = foot_ != 0 && sigma_ == 0;
    foot_ = foot;
    sigma_ = 0;
    if (foot == 0) return;
    const double speed = at_.vx - over_foot(foot).ry * at_.omega;
    if (held && at_.theta == 0) {
      at_.vx = over_foot(foot).ry * at_.omega;
    } else if (speed != 0) {
      sigma_ = speed > 0 ? 1 : -1;
      moved_ = true;
    }
  }

  Mode mode() const {
    if (foot_ == 0) return Mode::flight;
    return both() ? (sigma_ == 0 ? Mode::rest : Mode::slide) : (sigma_ == 0 ? Mode::rock : Mode::slide_rock);
  }
  void tell(Mode before, bool comes_down, Mode after) {
    State now;
    now.mode = after;
    now.pivot = both() ? 0 : foot_;
    recorder_.event(cursor_.time(), before, now, comes_down);
    ++peaks_.response().events;
  }

  // Its end.

  void stop(Outcome outcome) {
    outcome_ = outcome;
    finished_ = true;
  }
  // On a still floor it stands on both feet and sways so little that what it has left can neither let go of a leg nor slip: both forces
  // stay within a tenth of that. Swings of a spring and its mass have the size of their rate over W.
  bool settles() const {
    if (!both() || sigma_ != 0 || !cursor_.motion_over()) return false;
    const double h = rig_.h, b = rig_.half_base(), inertia = rig_.k2 + h * h;
    const double hold =
        base_.stiffness * (rig_.right * rig_.right + rig_.left * rig_.left) - rig_.g * h;  // against turning
    if (!(hold > 0)) return false;
    const double turn_rate = std::sqrt(hold / inertia), turn = std::abs(at_.theta) + std::abs(at_.omega) / turn_rate;
    const double rise = std::abs(at_.y) + std::abs(at_.vy) / rate_;
    const double least = std::fmin(legs_[0].stands_on, legs_[1].stands_on);
    const double pushes = (base_.stiffness + base_.dashpot * std::fmax(rate_, turn_rate)) * (rise + b * turn);
    const double pulls = h * turn_rate * turn_rate * (turn + rise / b);
    return 10 * pushes < least && 10 * pulls < rig_.mu_s * rig_.g;
  }
  void stop_when_done() {
    for (const double value : {at_.x, at_.y, at_.theta, at_.vx, at_.vy, at_.omega})
      if (!(std::abs(value) < beyond_all_bounds)) return stop(Outcome::not_finite);
    if (!peaks_.finite()) return stop(Outcome::not_finite);
    if (watch_.stalls(cursor_.time(), 0.1 / std::fmax(own_rate_, rate_))) return stop(Outcome::step_limit);
    if (finished_ || !cursor_.motion_over()) return;
    if (settles() || cursor_.time() >= end_s()) stop(moved_ ? Outcome::moved : Outcome::at_rest);
  }
  Response result() {
    Response& response = peaks_.response();
    const bool stands = settles();
    const double slip = stands ? sway_.arc.xi[0] : midpoint_in_flight(rig_, at_.x, at_.theta);
    response.outcome = outcome_;
    response.residual_slip_m = slip;
    response.residual_rotation_rad = stands ? 0 : at_.theta;
    response.end_time_s = cursor_.time();
    if (outcome_ != Outcome::overturned) return response;
    State fallen;
    fallen.theta = at_.theta;
    fallen.mode = Mode::overturned;
    leave_out_fall(response, rig_.half_base(), rig_.offset(lower()), rig_.h, flown_);
    recorder_.hold(fallen, slip, shaking_.duration_s(), shaking_);
    return response;
  }

  const Rig rig_;
  const Shaking shaking_;
  const Settings settings_;
  const double rate_;  // W
  const double length_, own_rate_;
  SpringBase base_;
  std::array<Leg, 2>& legs_;
  const double
      force_zero_;  // events are located to about 1e-14 s, in which pushes change by so much at the block's own speed [m/s2]
  FloorCursor cursor_;
  Peaks peaks_;
  HistoryRecorder recorder_;
  Sway sway_{};
  SwayState at_;
  int foot_ = 1, sigma_ = 0;
  bool slip_begins_ = false, moved_ = false, finished_ = false;
  StepWatch watch_;
  int happened_ = 0;
  double flown_ = 0;  // of the centre of mass, in all flights [m]
  Outcome outcome_ = Outcome::moved;
};

}  // namespace

std::string refusal_on_spring_legs(const Specimen& specimen) {
  if (specimen.model != Model::slide_rock) return "a block on legs that give way sways, slips and rocks";
  if (!specimen.start.upright_at_rest()) return "on them a block begins at rest where it is counted from";
  if (specimen.neighbour) return "two blocks side by side are followed where they only slide";
  for (const EffectUse& use : specimen.effects) {
    FloorInput floor;
    Specimen changed = specimen;
    if (use.effect->floor) use.effect->floor(floor, use.parameters);
    if (use.effect->specimen) use.effect->specimen(changed, use.parameters);
    if (use.effect->dynamic() || floor.push_mps2 != 0 || floor.gravity_factor != 1)
      return "the law of effect " + use.effect->name + " is of a block on rigid edges";
    if (changed.impact.factor != specimen.impact.factor)
      return "effect " + use.effect->name + " is of blows, which legs that give way soften";
  }
  return "";
}

Response respond_on_spring_legs(const Setup& setup, const Settings& settings, History* history) {
  const Specimen& specimen = setup.specimen;
  const bool sound = specimen.legs && specimen.legs->frequency_hz > 0 && specimen.legs->damping >= 0 &&
                     std::isfinite(specimen.legs->frequency_hz) && std::isfinite(specimen.legs->damping);
  if (!sound || !refusal_on_spring_legs(specimen).empty() || !admissible(setup, settings))
    return Response{.outcome = Outcome::not_finite};
  return OnSpringLegs(setup, settings, history).run();
}

}  // namespace freestand::dynamics
