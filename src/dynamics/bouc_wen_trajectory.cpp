#include "dynamics/bouc_wen_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "dynamics/bouc_wen_ring.hpp"

namespace freestand::dynamics {

BoucWenContact bouc_wen_contact(double mu, const BoucWen& law, double tolerance) {
  const double n = law.exponent, sum = law.gamma + law.beta;
  const double strongest = std::pow(sum, -1 / n);  // z_u
  BoucWenContact contact{};
  contact.yield = law.yield_displacement_m * strongest;
  contact.strength = mu * strongest;
  contact.n = n;
  contact.kappa = (law.beta - law.gamma) / sum;
  const double negligible = 0.1 * tolerance;
  contact.linear = std::min(0.5, std::pow(negligible * (n + 1) / std::max(1.0, -contact.kappa), 1 / (n + 1)));
  // Steps with errors of the tolerance come as near to |zeta| = 1 as that, and no nearer.
  contact.saturated = std::min(0.1, 2 * n * tolerance);
  contact.sliding = std::pow(0.75, 1 / n);
  return contact;
}

BoucWenTrajectory::BoucWenTrajectory(const Setup& setup, const Settings& settings_, History* history)
    : settings(settings_),
      shaking(setup.shaking),
      gravity(standard_gravity_mps2 * setup.floor.gravity_factor),
      push(setup.floor.push_mps2),
      vertical(shaking.vertical_scale != 0 && !shaking.motion->vertical_mps2.empty()),
      contact(bouc_wen_contact(setup.specimen.friction.mu_k, setup.specimen.bouc_wen, settings.tolerance)),
      laws(has_laws(setup.specimen) ? std::optional<Laws>(std::in_place, setup.specimen) : std::nullopt),
      // Steps are no longer than the ringing's own time, and events are located to the round-off of a step.
      instant_s(1e-14 * std::sqrt(contact.yield / (std::max(contact.strength, 1e-3) * gravity))),
      cursor(shaking, gravity, push),
      history_(history) {
  if (history_) history_->points.clear(), history_->events.clear();
  if (settings.slip_by_side) response_.peak_slip_right_m = response_.peak_slip_left_m = 0;
  if (laws) law_state.sides = laws->initial_sides();
  if (laws && (!laws->sound() || laws->lift >= 0)) finish(Outcome::not_finite);
  if (cursor.motion_over() && push == 0 && !laws) finish(Outcome::moved);
}

double BoucWenTrajectory::time_left() const {
  if (!cursor.motion_over()) return cursor.left();
  return std::max(0.0, shaking.duration_s() + settings.free_vibration_s - cursor.time());
}

void BoucWenTrajectory::set_out(int towards) {
  direction = towards;
  law_state.side = zeta == 0 ? towards : zeta > 0 ? 1 : -1;
  const double along = direction * zeta;
  if (std::abs(zeta) <= contact.linear) {
    phase = ContactPhase::elastic;
  } else if (along < 0) {
    phase = contact.kappa < 0 ? ContactPhase::returning : ContactPhase::elastic;
  } else {
    phase = along < 1 ? ContactPhase::yielding : ContactPhase::sliding;
    if (along > contact.sliding) begin_slide(cursor.time());
  }
  q = contact.q(zeta);
}

void BoucWenTrajectory::pass() {
  phase = phase == ContactPhase::elastic ? ContactPhase::yielding : ContactPhase::elastic;
  q = contact.q(zeta);
}

void BoucWenTrajectory::saturate() {
  const double all = displacement();
  zeta = direction;
  slip = all - contact.yield * zeta;
  phase = ContactPhase::sliding;
}

void BoucWenTrajectory::turn() {
  v = 0;
  direction = 0;
  observe_slip(displacement());
  if (simple()) observe_acceleration(contact.strength * gravity * zeta, 0);
  if (slides_) event(cursor.time(), Mode::slide, Mode::rest);
  if (++turns_ > 20L * settings.event_limit) finish(Outcome::step_limit);
  if (finished_ || !cursor.motion_over() || contact.strength == 0) return;
  if (push == 0 && !laws) {
    if (can_ring_out(contact, contact.q(zeta))) ring();
  } else if (settled()) {
    residual_ = 0.5 * (displacement() + last_turn_u_);
    return finish(Outcome::moved);
  }
  last_turn_u_ = displacement();
  last_turn_slip_ = slip;
}

// With forces besides the floor's the ringing has no closed form. It is left when two swings, one each way, slip no more than this, over
// u_y: the swings to come slip less and less. One swing alone tells nothing: where a slope or a spring leans on the contact, the
// swing against it gives back what the contact holds, without a slip, and the next one creeps.
bool BoucWenTrajectory::settled() {
  constexpr double settled_slip = 1e-6;
  const double since = std::max(shaking.duration_s(), last_slide_s_) + (laws ? laws->settling_s : 0);
  const double swing = std::abs(slip - last_turn_slip_), before = last_swing_slip_;
  last_swing_slip_ = swing;
  return cursor.time() > since && std::max(swing, before) <= settled_slip * contact.yield;
}

// All that follows is symmetric: the swings begin against the side on which the block turned.
void BoucWenTrajectory::ring() {
  const RingOut out = ring_out(contact, std::abs(zeta));
  const double towards = zeta > 0 ? -1 : 1;
  observe_slip(slip + towards * out.reach_m);
  observe_slip(slip - towards * out.second_reach_m);
  slip += towards * out.slip_m;
  zeta = 0;
  finish(Outcome::moved);
}

void BoucWenTrajectory::stand(double tau) {
  const bool to_knot = tau == cursor.left();
  const auto floor = cursor.local<max_floor_degree>();
  BoucWenArc<max_floor_degree> still{};
  still.zeta[0] = zeta;
  for (int k = 0; k < max_floor_degree; ++k) still.hold[k] = -floor.a[k];
  direction = 1;
  phase = ContactPhase::elastic;
  const double told = cursor.motion_over() ? 0 : tau;
  arrive(still, floor, told);
  direction = 0;
  if (simple()) observe_acceleration(contact.strength * gravity * zeta, 0);
  if (cursor.motion_over() && !(laws && laws->evolve_at_rest())) return finish(Outcome::moved);
  cursor.advance(tau - told);
  check();
  if (to_knot) next_segment();
}

void BoucWenTrajectory::next_segment() {
  cursor.next_segment();
  watch.steps = 0;
  if (cursor.motion_over() && v == 0 && zeta == 0 && push == 0 && !laws) finish(Outcome::moved);
}

double BoucWenTrajectory::next_output() const {
  return times_.wanted() ? times_.next() - cursor.time() : std::numeric_limits<double>::infinity();
}

void BoucWenTrajectory::begin_slide(double time) {
  if (!slides_) event(time, Mode::rest, Mode::slide);
}

void BoucWenTrajectory::event(double time, Mode from, Mode to) {
  slides_ = to == Mode::slide;
  last_slide_s_ = time;
  moved_ = true;
  if (++response_.events >= settings.event_limit) finish(Outcome::step_limit);
  if (history_) history_->events.push_back({time, from, to, 0, false});
}

void BoucWenTrajectory::observe_acceleration(double horizontal, double lift) {
  response_.peak_acceleration_mps2 =
      std::max(response_.peak_acceleration_mps2, std::sqrt(horizontal * horizontal + lift * lift));
}

void BoucWenTrajectory::check() {
  if (!std::isfinite(slip) || !std::isfinite(zeta) || !std::isfinite(v)) return finish(Outcome::not_finite);
  if (cursor.motion_over() && cursor.time() >= shaking.duration_s() + settings.free_vibration_s) finish(Outcome::moved);
}

void BoucWenTrajectory::finish(Outcome failure) {
  if (finished_) return;
  finished_ = true;
  failure_ = failure;
  observe_slip(displacement());
  if (simple()) observe_acceleration(contact.strength * gravity * zeta, 0);
}

void BoucWenTrajectory::observe_slip(double u) {
  response_.peak_slip_m = std::max(response_.peak_slip_m, std::abs(u));
  if (!settings.slip_by_side) return;
  response_.peak_slip_right_m = std::fmax(response_.peak_slip_right_m, u);
  response_.peak_slip_left_m = std::fmax(response_.peak_slip_left_m, -u);
}

Response BoucWenTrajectory::result() {
  response_.outcome = failure_ != Outcome::moved ? failure_ : moved_ ? Outcome::moved : Outcome::at_rest;
  response_.residual_slip_m = residual_.value_or(displacement());
  response_.connection_failed = laws && laws->broken(law_state.sides);
  response_.end_time_s = cursor.time();
  if (!std::isnan(settings.acceleration_height_m)) {  // it does not turn, and meets no blows
    response_.peak_acceleration_at_height_mps2 = response_.peak_acceleration_mps2;
    response_.largest_blow_mps = 0;
  }
  return response_;
}

}  // namespace freestand::dynamics
