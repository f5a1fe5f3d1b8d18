#include "dynamics/integration.hpp"

#include <algorithm>

#include "dynamics/impact.hpp"
#include "dynamics/law_range.hpp"
#include "dynamics/overturned.hpp"

namespace freestand::dynamics {
namespace {
// Ten thousand steps that come no further than this, times p, stand before a place where a law has no value: at that pace a motion of a
// minute would take 1e7 of them, minutes for one sample.
constexpr double least_progress = 0.1;
// Waits are halved for a grip that is no polynomial down to this, times p: in it a force that changes by g over 1/p changes by
// 1e-6 g, which moves nothing by more than 1e-12 of the block's size before the next look.
constexpr double shortest_wait = 1e-6;
constexpr int wait_order = max_floor_degree + 1;  // witnesses at rest are the floor's own polynomials

// Horizontal velocity of the centre of mass relative to the floor.
double centre_speed(const Rig& rig, const State& state) {
  if (state.mode == Mode::flight) return state.vx;
  const int pivot = state.pivot == 0 ? 1 : state.pivot;
  const Rotation<double> rotation = rotation_by(state.theta);
  const double lever = rig.offset(pivot) * rotation.sine + rig.h * rotation.cosine;
  return state.w + lever * state.omega;
}

// Velocity relative to the floor of the point that is followed.
Velocity<double> point_velocity(const Rig& rig, const State& state) {
  const Rotation<double> rotation = rotation_by(state.theta);
  Velocity<double> centre{state.vx, state.vy, state.omega};
  if (state.mode != Mode::flight) {
    const double c = state.pivot == 0 ? 0 : rig.offset(state.pivot);
    const Arm<double> r{rig.h * rotation.sine - c * rotation.cosine, rig.h * rotation.cosine + c * rotation.sine};
    centre = at_centre(r, state.w, state.omega);
  }
  const double qx = rig.point->qx(rotation), qy = rig.point->qy(rotation);
  return {centre.vx + state.omega * qy, centre.vy - state.omega * qx, state.omega};
}

}  // namespace

bool admissible(const Specimen& specimen, const Shaking& shaking, const FloorInput& floor, const Settings& settings) {
  const Block& b = specimen.block;
  for (const auto& use : specimen.effects)
    for (const double parameter : use.parameters)
      if (!std::isfinite(parameter)) return false;
  if (!(floor.gravity_factor > 0)) return false;
  for (const double size : {b.left_m, b.right_m, b.height_m, b.gyration2_m2, shaking.stretch, settings.tolerance})
    if (!(size > 0) || !std::isfinite(size)) return false;
  for (const double number :
       {specimen.friction.mu_s, specimen.friction.mu_k, specimen.impact.factor, settings.free_vibration_s})
    if (!(number >= 0) || !std::isfinite(number)) return false;
  const double ratio = specimen.friction.ratio_across;
  if (ratio != 1 && (!(ratio > 0) || !std::isfinite(ratio) || !std::isfinite(specimen.friction.axis_rad) ||
                     specimen.model != Model::slide || !shaking.motion || shaking.motion->cross_mps2.empty()))
    return false;
  return can_start(specimen) && std::isfinite(shaking.scale) && std::isfinite(shaking.vertical_scale) &&
         shaking.motion && shaking.motion->degree >= 0 && shaking.motion->degree <= max_floor_degree &&
         specimen.friction.mu_s >= specimen.friction.mu_k && specimen.impact.factor <= 1;
}

Integration::Integration(const Setup& setup, const Settings& settings_, History* history, bool as_under_laws)
    : rig(setup.specimen, settings_, setup.floor, as_under_laws),
      shaking(setup.shaking),
      settings(settings_),
      cursor(shaking, rig.g, rig.push),
      peaks(settings),
      recorder(history, rig),
      p_(setup.specimen.block.p_radps()) {
  if (rig.laws && !rig.laws->sound()) stop(Outcome::not_finite);
  if (rig.laws) state.sides = rig.laws->initial_sides();
  if (!finished_ && !setup.specimen.start.upright_at_rest()) start_from(setup.specimen.start);
}

Rig::AtRest Integration::laws_at_rest() const {
  if (!rig.laws) return {};
  const double now = cursor.time();
  Rig::AtRest rest;
  const bool changes = rig.laws->change_at_rest();
  if (changes) rest.until = cursor.run_end_s();
  rest.known = !rig.laws->uses(Input::normal) || shaking.vertical_scale == 0;
  rest.factor = std::numeric_limits<double>::infinity();
  for (const int sigma : {-1, 1}) {
    const LawRange range = law_range(rig, state, now, changes ? rest.until : now, sigma);
    rest.force = std::max(rest.force, range.force.magnitude());
    rest.lift = std::max(rest.lift, range.lift.upper);
    rest.moment = std::max(rest.moment, range.moment.magnitude());
    rest.factor = std::min(rest.factor, range.factor.lower);
    rest.known &= range.known;
  }
  return rest;
}

void Integration::wait() {
  if (cursor.motion_over()) return resolve(Witness::regular);  // settles() found that the still floor does not hold it
  Rig::AtRest rest = laws_at_rest();
  while (!cursor.motion_over()) {
    if (cursor.time() >= rest.until) rest = laws_at_rest();
    if (!peaks.follow_rest() && cursor.at_knot() && pass_over_quiet_floor(rest)) continue;
    // What holds a block at rest under laws that do not change is linear in a record.
    const bool event =
        shaking.motion->degree == 1 && rest.constant() ? look_ahead<2>(rest) : look_ahead<wait_order>(rest);
    if (event) return;
  }
}

// When the floor stands still its push is gone, and what laws or a slope pull may go.
bool Integration::ends_with_the_motion() const {
  if (!rig.laws) return false;
  FirstEvent now(0, rig.rest_rotation);
  with_contact_arc<wait_order>(rig, state, cursor.time(), cursor.local<wait_order>(),
                               [&](const auto& arc) { for_each_witness(rig, state, arc, now); });
  return now.found().any;
}

// The floor mostly shakes hardest just before rest ends: seen from there, few segments hold a new peak.
bool Integration::pass_over_quiet_floor(const Rig::AtRest& rest) {
  const std::size_t from = cursor.segment();
  FloorCursor passed = cursor;
  if (!cursor.pass_over([&](const FloorCursor::Bound& floor) { return stays_put(floor, rest); })) return false;
  watch_.steps = 0;
  for (; recorder.wanted() && passed.segment() != cursor.segment(); passed.next_segment()) record_rest(passed);
  cursor.look_back(
      from, [&](const FloorCursor::Bound& floor) { return !peaks.may_exceed(floor.shaken, floor.v); },
      [&](const FloorCursor& at) { peaks.observe_rest(rig, at.local<wait_order>(), at.left()); });
  return true;
}

bool Integration::stays_put(const FloorCursor::Bound& floor, const Rig::AtRest& rest) const {
  return floor.end <= rest.until && rig.stays_put(floor.a, floor.v, rest);
}

void Integration::record_rest(const FloorCursor& at) {
  if (!recorder.wanted()) return;
  if (shaking.motion->degree == 1)
    recorder.rest(state, at.local<1>(), at.time(), at.left());
  else
    recorder.rest(state, at.local<wait_order>(), at.time(), at.left());
}

// Along the segment, to the instant at which rest ends or as far as the series follow the grip. True: it has ended.
template <int N>
bool Integration::look_ahead(const Rig::AtRest& rest) {
  const FloorCursor::Bound bound = cursor.segment_bound();
  const Floor<double, N> floor = cursor.local<N>();
  if (!peaks.follow_rest() && stays_put(bound, rest)) {
    peaks.observe_rest(rig, floor, cursor.left());
    record_rest(cursor);
    next_segment();
    return false;
  }
  Found found;
  bool to_knot = true;
  with_contact_arc<N>(rig, state, cursor.time(), floor, [&](const auto& arc) {
    const auto first_event = [&](double h) {
      FirstEvent first(h, rig.rest_rotation);
      for_each_witness(rig, state, arc, first);
      return first.found();
    };
    const auto missed = [&](double tau) {
      const Floor<double, 1> there{{floor.a.at(tau), 0}, {floor.g.at(tau), 0}};
      return grip_missed(rig, state, cursor.time() + tau, there, arc, tau);
    };
    found = first_event(cursor.left());
    while (found.tau * p_ > shortest_wait && !(missed(found.tau) <= settings.tolerance * rig.g)) {
      found = first_event(0.5 * found.tau);
      to_knot = false;
    }
    if (found.tau > 0) peaks.observe(rig, state, arc, found.tau);
    recorder.record(state, arc, floor, cursor.time(), found.tau);
  });
  cursor.advance(found.tau);
  if (found.tau > 0) left_instant(found.tau);
  if (found.any) resolve(found.witness);
  if (!found.any && to_knot) next_segment();
  return found.any;
}

void Integration::left_instant(double tau) {
  state.doubt = 1;
  if (tau > rig.instant_s) state.left_kinks();
  if (state.released) state.wall = 0;
  state.released = false;
  if (!state.at_wall()) return;
  // Steps keep the edge at the wall to their own accuracy: it is put back.
  const bool aloft = state.mode == Mode::flight;
  if (aloft && state.edge == Edge::face) return lie_against(state.wall);
  (aloft ? state.x : state.xi) += state.wall * edge_now(rig, state, state.wall, state.edge).gap;
}

// Contents on springs keep their own velocity when the block's changes at once.
void Integration::keep_contents_velocity(double speed_before) {
  const double jump = centre_speed(rig, state) - speed_before;
  for (std::size_t i = 0; i < max_states; ++i)
    if (rig.laws->relative_velocity[i]) state.states[i] -= jump;
}

// Another event may fall on the very instant of a stop, or of an impact.
void Integration::stop_slip() {
  stand_still(rig, state);
  // An edge of a leaning block stops with the slip, unless it is at the floor itself but for round-off of the height.
  const bool leans = state.pivot != 0 && state.at_wall();
  if (leans && edge_now(rig, state, state.wall, state.edge).height > 1e-6 * rig.top) state.omega = 0;
}

bool Integration::strikes_too(double at_once) const {
  return state.pivot != 0 && state.pivot * state.theta <= at_once && state.pivot * state.omega < 0;
}

void Integration::count_impact() {
  if (rig.hop_rotation(state.pivot, state.omega) >= rig.told_rotation) ++peaks.response().impacts;
}

void Integration::resolve(Witness witness) {
  if (state.sigma != 0 || state.mode == Mode::flight || is_clearance(witness)) state.still_since = cursor.time();
  const State from = state;
  const double speed_before = rig.laws ? centre_speed(rig, state) : 0;
  bool impact = false, at_floor = false, regular = true;
  switch (witness) {
    case Witness::impact:
      impact = at_floor = true;
      count_impact();
      regular = strike_floor();
      break;
    case Witness::above_right:
    case Witness::above_left:
      impact = at_floor = true;
      ++peaks.response().impacts;
      regular = land_on(witness == Witness::above_right ? 1 : -1);
      break;
    case Witness::slipping:
      stop_slip();
      state.left_kinks();  // the slip may go on another way
      break;
    case Witness::upright:
      state.mode = Mode::overturned;
      chose(from, false);
      return stop(Outcome::overturned);
    default:
      if (is_clearance(witness)) {
        impact = true;
        regular = meet_wall(at_wall(witness).side, at_wall(witness).edge);
      }
      if (is_kink(witness)) state.turn_kink(static_cast<int>(witness) - static_cast<int>(Witness::kink));
      break;
  }
  if (is_kink(witness) && state.sigma * slip_speed(rig, state) <= 0) stop_slip();
  // A corner that begins to rise is at the floor, or under it by round-off.
  if (state.pivot * state.theta < 0 && state.pivot * state.omega >= 0) state.theta = 0;
  // A law may look at the rotation itself (a chain without slack): its kink is known to the tolerance of the step.
  if (regular && !at_floor && strikes_too(is_kink(witness) ? rig.rest_rotation : 0)) {
    impact = true;
    count_impact();
    regular = strike_floor();
  }
  const bool beside_walls = regular && rig.laws && rig.laws->walls.any();
  if (beside_walls && !impact) impact = comes_through_wall();  // a kink at the wall itself
  if (beside_walls && impact) regular = meet_walls_too();
  if (impact && rig.point) {
    const Velocity<double> before = point_velocity(rig, from), after = point_velocity(rig, state);
    double& most = peaks.response().largest_blow_mps;
    most = std::fmax(most, std::hypot(after.vx - before.vx, after.vy - before.vy));
  }
  if (impact && rig.laws) keep_contents_velocity(speed_before);
  if (impact) state.left_kinks();  // speeds jump, and what was about to turn may turn back
  if (!regular) return stop_without_mode();
  choose(from, impact);
}

void Integration::choose(const State& from, bool impact) {
  if (!choose_mode(rig, cursor, state) && !choose_beside_wall()) return stop_without_mode();
  chose(from, impact);
}

bool Integration::choose_beside_wall() {
  for (const int corner : sides(state))
    if (sinks(corner) && land_on(corner) && choose_mode(rig, cursor, state)) return true;
  const State open = state;
  for (const int side : sides(open)) {
    state = open;
    if (rests_at_wall(side) && choose_mode(rig, cursor, state)) return true;
  }
  return false;
}

bool Integration::land_on(int corner) {
  if (!land(rig, state, corner, cursor.time())) return false;
  return state.theta != 0 || state.omega * state.pivot >= 0 || strike_floor();
}

// A blow of a wall that lifts one corner of an upright block throws the other one at the floor on which it stands.
bool Integration::sinks(int corner) const {
  if (state.mode != Mode::flight) return false;
  const Flight<double, 1> flight = flight_arc<1>(rig, state, cursor.local<1>());
  const Series<double, 1>& gap = corner > 0 ? flight.gap_right : flight.gap_left;
  return gap[0] <= rig.rest_height && gap[1] < 0;
}

void Integration::stop_without_mode() {
  stop(rig.can_rock && forces_have_values() ? Outcome::painleve : Outcome::not_finite);
}

bool Integration::forces_have_values() const {
  const Floor<double, max_floor_degree> floor = cursor.local<max_floor_degree>();
  if (!std::isfinite(floor.a[0]) || !std::isfinite(floor.g[0])) return false;
  return !rig.laws ||
         (law_values(rig, state, cursor.time(), -1).finite() && law_values(rig, state, cursor.time(), 1).finite());
}

void Integration::chose(const State& from, bool impact) {
  const bool news = impact || from.mode != state.mode || from.pivot != state.pivot || from.sigma != state.sigma;
  if (news) recorder.event(cursor.time(), from.mode, state, impact);
  if (state.mode != Mode::rest) moved_ = true;
  if (news) rest_since_ = cursor.time();
  if (from.mode != Mode::flight) took_off_from_ = state.x;
  if (from.mode == Mode::flight && state.mode != Mode::flight) unslid_ += std::abs(from.x - took_off_from_);
  peaks.response().events += news;
  if (news && rig.laws && rig.laws->walls.any()) {
    peaks.came_to(cursor.time(), rig.brief_s);
    if (peaks.waits() || within_reach_of_wall(rig, state, beside_wall(rig)))
      peaks.event_beside_wall(impact, cursor.time());
  }
  if (++resolved_ >= settings.event_limit && !finished_) stop(Outcome::step_limit);
}

void Integration::went_through(int blows, int told, int kinks) {
  peaks.response().impacts += told;
  peaks.response().events += blows;
  resolved_ += blows + kinks;
}

void Integration::stop(Outcome outcome) {
  outcome_ = outcome;
  finished_ = true;
}

void Integration::stop_when_done() {
  const double values[] = {state.theta, state.omega, state.xi, state.w, state.x, state.y, state.vx, state.vy};
  for (const double value : values)
    if (!(std::abs(value) < beyond_all_bounds)) return stop(Outcome::not_finite);
  if (!peaks.finite()) return stop(Outcome::not_finite);
  peaks.came_to(cursor.time(), rig.brief_s);
  if (watch_.stalls(cursor.time(), least_progress / p_)) return stop(Outcome::step_limit);
  if (!cursor.motion_over()) return;
  const bool out_of_time = cursor.time() >= shaking.duration_s() + settings.free_vibration_s;
  if (settles() || leans_for_good() || out_of_time) stop(moved_ ? Outcome::moved : Outcome::at_rest);
}

bool Integration::settles() const {
  if (state.mode != Mode::rest) return false;
  if (waits()) return !ends_with_the_motion();
  return cursor.time() >= std::fmax(rest_since_, shaking.duration_s()) + rig.laws->settling_s;
}

// On a floor that does not move, and with laws that do not change.
bool Integration::leans_for_good() const {
  return state.at_wall() && state.mode == Mode::rock && !rig.laws->evolve_at_rest() && !rig.laws->change_at_rest();
}

double Integration::slip() const {
  if (state.mode == Mode::flight) return midpoint_in_flight(rig, state.x, state.theta);
  const int side = (state.theta > 0) - (state.theta < 0);
  // Legs come back upright under a block that rests.
  const double sway = state.mode == Mode::rest ? state.deflection : 0;
  return state.xi - sway + side * rig.half_base() * rotation_by(state.theta).versine;
}

// What stands presses on the floor, though nothing happens to it any more.
void Integration::feel_standing() {
  if (!peaks.follow_rest() || state.mode == Mode::flight || state.mode == Mode::overturned) return;
  if (outcome_ != Outcome::at_rest && outcome_ != Outcome::moved) return;
  with_contact_arc<2>(rig, state, cursor.time(), cursor.local<2>(), [&](const auto& arc) {
    peaks.observe(rig, state, arc, 0);
    if (state.mode == Mode::rest) peaks.ring_down(rig, arc);
  });
}

Response Integration::result() {
  feel_standing();
  peaks.tell_fatigue();
  Response& response = peaks.response();
  response.outcome = outcome_;
  response.residual_slip_m = slip();
  response.residual_rotation_rad = state.theta;
  response.end_time_s = cursor.motion_over() ? std::fmax(cursor.time(), hops_end_) : cursor.time();
  response.connection_failed = rig.laws && rig.laws->broken(state.sides);
  if (response.connection_failed) peaks.broke_at(rig.laws->strength);
  if (outcome_ == Outcome::overturned)
    leave_out_fall(response, rig.half_base(), rig.offset(state.theta < 0 ? -1 : 1), rig.h, unslid_);
  if (outcome_ == Outcome::at_rest || outcome_ == Outcome::moved || outcome_ == Outcome::overturned)
    recorder.hold(state, slip(), shaking.duration_s(), shaking);
  return response;
}

}  // namespace freestand::dynamics
