#include "dynamics/integration.hpp"

#include "dynamics/impact.hpp"

namespace freestand::dynamics {
namespace {
constexpr int wait_order = max_floor_degree + 1;  // witnesses at rest are the floor's own polynomials
}

bool admissible(const Specimen& specimen, const Shaking& shaking, const Settings& settings) {
  const Block& b = specimen.block;
  for (const double size : {b.left_m, b.right_m, b.height_m, b.gyration2_m2, shaking.stretch, settings.tolerance})
    if (!(size > 0) || !std::isfinite(size)) return false;
  for (const double number :
       {specimen.friction.mu_s, specimen.friction.mu_k, specimen.impact.factor, settings.free_vibration_s})
    if (!(number >= 0) || !std::isfinite(number)) return false;
  return std::isfinite(shaking.scale) && std::isfinite(shaking.vertical_scale) && shaking.motion &&
         shaking.motion->degree >= 0 && shaking.motion->degree <= max_floor_degree &&
         specimen.friction.mu_s >= specimen.friction.mu_k;
}

Integration::Integration(const Specimen& specimen, const Shaking& shaking_, const Settings& settings_, History* history)
    : rig(specimen, settings_),
      shaking(shaking_),
      settings(settings_),
      cursor(shaking, rig.g),
      recorder(history, rig) {}

void Integration::wait() {
  const auto quiet = [&](FloorCursor::Bound bound) {
    return !recorder.wanted() && !peaks.may_exceed(bound.a, bound.v) && rig.stays_put(bound.a, bound.v);
  };
  while (!cursor.motion_over()) {
    if (cursor.run_starts_here() && quiet(cursor.run_bound())) {
      cursor.next_run();
      continue;
    }
    if (quiet(cursor.segment_bound())) {
      cursor.next_segment();
      continue;
    }
    const auto floor = cursor.local<wait_order>();
    const auto arc = contact_arc<wait_order>(rig, state, floor);
    FirstEvent first(cursor.left());
    for_each_witness(rig, state, arc, first);
    const Found found = first.found();
    if (found.tau > 0) peaks.observe(rig, state, arc, found.tau);
    recorder.record(state, arc, floor, cursor.time(), found.tau);
    cursor.advance(found.tau);
    if (found.tau > 0) state.doubt = 1;
    if (found.any) return resolve(found.witness);
    cursor.next_segment();
  }
}

void Integration::resolve(Witness witness) {
  const State from = state;
  bool impact = false, regular = true;
  switch (witness) {
    case Witness::impact:
      impact = true;
      if (rig.hop_rotation(state.pivot, state.omega) >= rig.told_rotation) ++peaks.response().impacts;
      regular = strike(rig, state);
      break;
    case Witness::above_right:
    case Witness::above_left:
      impact = true;
      ++peaks.response().impacts;
      regular = land(rig, state, witness == Witness::above_right ? 1 : -1);
      if (regular && state.theta == 0 && state.omega * state.pivot < 0) regular = strike(rig, state);
      break;
    case Witness::slipping:
      state.w = 0;
      break;
    case Witness::upright:
      state.mode = Mode::overturned;
      chose(from, false);
      return stop(Outcome::overturned);
    default:
      break;
  }
  if (!regular || !choose_mode(rig, cursor, state)) return stop(Outcome::painleve);
  chose(from, impact);
}

void Integration::chose(const State& from, bool impact) {
  const bool news = impact || from.mode != state.mode || from.pivot != state.pivot || from.sigma != state.sigma;
  if (news) recorder.event(cursor.time(), from.mode, state, impact);
  if (state.mode != Mode::rest) moved_ = true;
  peaks.response().events += news;
  if (++resolved_ >= settings.event_limit && !finished_) stop(Outcome::step_limit);
}

void Integration::stop(Outcome outcome) {
  outcome_ = outcome;
  finished_ = true;
}

void Integration::stop_when_done() {
  const double values[] = {state.theta, state.omega, state.xi, state.w, state.x, state.y, state.vx, state.vy};
  for (const double value : values)
    if (!std::isfinite(value)) return stop(Outcome::not_finite);
  if (!peaks.finite()) return stop(Outcome::not_finite);
  if (!cursor.motion_over()) return;
  const bool out_of_time = cursor.time() >= shaking.duration_s() + settings.free_vibration_s;
  if (state.mode == Mode::rest || out_of_time) stop(moved_ ? Outcome::moved : Outcome::at_rest);
}

double Integration::slip() const {
  if (state.mode == Mode::flight) return midpoint_in_flight(rig, state.x, state.theta);
  const double half = std::sin(0.5 * state.theta);
  const int side = (state.theta > 0) - (state.theta < 0);
  return state.xi + side * rig.half_base() * 2 * half * half;
}

Response Integration::result() {
  Response& response = peaks.response();
  response.outcome = outcome_;
  response.residual_slip_m = slip();
  response.residual_rotation_rad = state.theta;
  response.end_time_s = cursor.time();
  if (outcome_ == Outcome::at_rest || outcome_ == Outcome::moved || outcome_ == Outcome::overturned)
    recorder.hold(state, response.residual_slip_m, shaking.duration_s(), shaking);
  return response;
}

}  // namespace freestand::dynamics
