// Where the stepper cuts its steps, and what happens there: blows of no duration.
#include <algorithm>
#include <cmath>

#include "support/moreau_stepper.hpp"

namespace freestand::test {
namespace {

constexpr double instant = 1e-13;  // [s]

Corner other(Corner k) { return k == left ? right : left; }

// First time in [0, dt] at which a quantity falls through zero, taken as the parabola with these ends and first rate.
double crossing(double start, double rate, double end, double dt) {
  if (start <= 0 && rate <= 0) return 0;
  const double bend = (end - start - rate * dt) / (dt * dt);
  const double root = std::sqrt(std::max(0.0, rate * rate - 4 * bend * start));
  const double time = rate < 0 ? 2 * start / (root - rate) : bend < 0 ? (rate + root) / (-2 * bend) : dt;
  return std::clamp(time, 0.0, dt);
}

}  // namespace

bool MoreauStepper::step(const FloorLine& floor, double t, double dt) {
  closing_speed_ = felt_ = 0;
  landed_nearly_flat_ = false;
  strikes_ = {};
  const double end = t + dt;
  for (int cut = 0; cut < 60; ++cut) {
    Refused refused;
    State after = state_;
    if (!advance(after, floor, t, end - t, {}, refused)) return false;
    const Event event = first_event(state_, after, t, end - t, refused);
    if (event.kind == Event::Kind::none) {
      state_ = after;
      felt_ = std::max(felt_, state_.felt);
      return true;
    }
    if (event.after > instant) {
      std::optional<Grip> forced;
      if (event.kind == Event::Kind::slip_end || event.kind == Event::Kind::grip_break) forced = state_.grip;
      if (!advance(state_, floor, t, event.after, forced, refused)) return false;
      felt_ = std::max(felt_, state_.felt);
    }
    t += event.after;
    meet(event, t, dt);
    if (end - t < instant) return true;
  }
  // Rattling: both corners down, whatever is left of the step.
  if (state_.closed[left] != state_.closed[right] && std::abs(state_.theta) < 1e-9) lie_down();
  Refused refused;
  return advance(state_, floor, t, end - t, {}, refused);
}

MoreauStepper::Event MoreauStepper::first_event(const State& before, const State& after, double t, double dt,
                                                const Refused& refused) const {
  Event event;
  const auto earlier = [&](Event::Kind kind, double time, int edge = -1) {
    if (event.kind == Event::Kind::none || time < event.after) event = {kind, time, edge};
  };
  for (const Corner k : {left, right}) {
    if (before.closed[k]) continue;
    const double end = gap(after, k);
    const double rate = before.v.y - before.v.q * arm(k, before.c, before.s).x;
    if (end < 0) earlier(Event::Kind::closing, crossing(gap(before, k), rate, end, dt));
  }
  const bool carried = before.grip != Grip::none && after.grip != Grip::none;
  for (int edge = 0; edge < edge_count && laws_.walled(); ++edge) {
    if (!laws_.walls[static_cast<std::size_t>(edge / 2)] || (before.touching >> edge & 1U) != 0) continue;
    const double start = clearance(before, edge), end = clearance(after, edge);
    const double rate = -into_wall(before, edge);
    if (end < 0 && end < start) earlier(Event::Kind::wall, crossing(start, rate, end, dt), edge);
  }
  if (laws_.chain && !before.chain_broken && chain_pull(after) > laws_.chain->strength_mps2) {
    const double start = chain_pull(before), rise = chain_pull(after) - start;
    earlier(Event::Kind::chain_break, std::clamp(dt * (laws_.chain->strength_mps2 - start) / rise, 0.0, dt));
  }
  for (const ContactLaws::Tether& tether : laws_.tethers) {
    // Its dashpot pulls from the first instant: a jump.
    const double side = tether.slack_m < 0 ? -1 : 1, slack = std::abs(tether.slack_m);
    const double start = slack - side * slip_of(before), end = slack - side * slip_of(after);
    if (!(start > 0 && end < 0)) continue;
    const double time = crossing(start, -side * middle_speed(before), end, dt);
    if (time > instant) earlier(Event::Kind::tether, time);
  }
  // The speed of a foot without mass jumps with the forces, at a blow for one, and may turn there for an instant.
  const int way = direction(before.grip);
  if (way != 0 && carried && after.grip != before.grip && std::isfinite(refused.slip)) {
    const double start = laws_.legs_radps > 0 ? refused.first_slip : before.w;
    earlier(Event::Kind::slip_end, start * way <= 0 ? 0 : std::clamp(dt * start / (start - refused.slip), 0.0, dt));
  } else if (laws_.legs_radps > 0 && way != 0 && carried && before.struck && after.first_w * way < 0) {
    earlier(Event::Kind::slip_end, 0);
  }
  if (before.grip == Grip::stuck && carried && std::isfinite(before.margin)) {
    const double time = grip_breaks_after(before, after.grip == Grip::stuck ? after.margin : refused.margin, t, dt);
    if (time > instant && time < dt) earlier(Event::Kind::grip_break, time);
  }
  return event;
}

// The margin of grip falls on a line through its values in the middle of the last step and of this one.
double MoreauStepper::grip_breaks_after(const State& before, double margin, double t, double dt) const {
  const double rate = (margin - before.margin) / (t + 0.5 * dt - before.margin_time);
  if (!(rate < 0)) return dt;
  return before.margin_time - before.margin / rate - t;
}

void MoreauStepper::meet(const Event& event, double t, double dt) {
  switch (event.kind) {
    case Event::Kind::closing:
      return collide(t, dt);
    case Event::Kind::wall:
      return meet_wall(event.edge, t, dt);
    case Event::Kind::chain_break:
      state_.chain_broken = true;
      return;
    case Event::Kind::slip_end:
      if (laws_.legs_radps == 0) state_.v.x -= state_.w;
      return hold(t);
    default:
      state_.margin = std::numeric_limits<double>::quiet_NaN();
  }
}

// The contact sticks where it is.
void MoreauStepper::hold(double t) {
  state_.grip = Grip::stuck;
  state_.w = state_.w_rate = 0;
  state_.margin = std::numeric_limits<double>::quiet_NaN();
  state_.foot = contact_position(state_) - (laws_.legs_radps > 0 ? state_.legs : 0);
  state_.stuck_since = t;
}

void MoreauStepper::lie_down() {
  const double position = contact_position(state_);
  const double speed = state_.v.x - state_.v.q * body_.height_m;
  state_.theta = state_.s = 0;
  state_.c = 1;
  state_.closed = {true, true};
  state_.x = position;
  state_.y = body_.height_m;
  state_.v = {speed, 0, 0};
}

void MoreauStepper::collide(double t, double dt) {
  constexpr double touching = 1e-9;  // [m]
  const State before = state_;
  Step step;
  step.t = t;
  step.near = state_.closed;
  step.blow = true;
  bool any = false;
  for (const Corner k : {left, right}) {
    step.push[k] = step.stop[k] = arm(k, state_.c, state_.s);
    const double speed = -(state_.v.y - state_.v.q * step.stop[k].x);
    if (state_.closed[k] || gap(state_, k) > touching || speed < 0) continue;
    step.near[k] = any = true;
    closing_speed_ = std::max(closing_speed_, speed);
  }
  if (!any) return;
  constexpr double nearly = 1e-7;  // [m]
  if (before.grip == Grip::none && state_.theta != 0 && gap(state_, left) < nearly && gap(state_, right) < nearly)
    landed_nearly_flat_ = true;
  const bool flat = step.near[left] && step.near[right], struck = state_.grip != Grip::none;
  if (flat && struck) {
    // The base meets the floor: from here on it is flat to the last bit.
    state_.x = contact_position(state_);
    state_.y = body_.height_m;
    state_.theta = state_.s = 0;
    state_.c = 1;
    for (const Corner k : {left, right}) step.push[k] = step.stop[k] = arm(k, 1, 0);
  }
  step.touching = state_.touching;
  for (int e = 0; step.touching != 0 && e < edge_count; ++e)
    step.wall_push[e] = step.wall_stop[e] = edge_arm(e, state_.c, state_.s);
  if (flat && struck && body_.housner) {
    strike(carrier(before));
  } else {
    step.free = state_.v;
    look_about(step, t);
    Case c;
    Refused refused;
    if (!choose(step, state_, c, true, refused)) return;
    if (state_.grip == Grip::none) return;
    state_.v = c.next;
    state_.w = c.slip;
    if (laws_.legs_radps > 0) {
      // Legs keep the grip of the foot as it was; a foot in the air has none and sticks.
      state_.grip = before.grip == Grip::none ? Grip::stuck : before.grip;
      state_.w = before.w;
    }
    if (state_.closed[left] && state_.closed[right]) {
      state_.theta = state_.s = 0;
      state_.c = 1;
      state_.y = body_.height_m;
    }
    if (state_.grip == Grip::stuck && before.grip != Grip::stuck) hold(t);
  }
  if (state_.closed[left] != state_.closed[right] && state_.theta == 0 && short_hop(dt)) lie_down();
  state_.margin = std::numeric_limits<double>::quiet_NaN();
  state_.struck = true;
  state_.stuck_since = t;
  state_.w_rate = state_.corner_rate = state_.base_rate = 0;
  state_.contents_v -= state_.v.x - before.v.x;
}

// Housner's impact: the rate that angular momentum about the new corner keeps, and the slip goes on.
void MoreauStepper::strike(Corner from) {
  const Corner to = other(from);
  const double h = body_.height_m, along = body_.gyration2_m2 + laws_.carried() * h * h;
  const double arm_to = to == left ? body_.left_m : body_.right_m;
  const double kept = (along - body_.left_m * body_.right_m) / (along + arm_to * arm_to);
  const double slip = state_.v.x - h * state_.v.q;
  const double rate = body_.impact_factor * std::max(0.0, kept) * state_.v.q;
  state_.touching = 0;  // what this presses into a wall strikes it next
  state_.closed = {to == left, to == right};
  state_.v = {slip + h * rate, rate * (to == left ? -arm_to : arm_to), rate};
}

// Whether the hop that begins flat on one corner lasts a hundredth of a step at most.
bool MoreauStepper::short_hop(double dt) const {
  const double h = body_.height_m, lever = state_.closed[left] ? body_.left_m : body_.right_m;
  const double inertia = body_.gyration2_m2 + laws_.carried() * h * h + lever * lever;
  return 200 * std::abs(state_.v.q) * inertia < laws_.gravity_mps2 * lever * dt;
}

// Into its wall, of an edge.
double MoreauStepper::into_wall(const State& state, int edge) const {
  return (edge / 2 == left ? -1 : 1) * (state.v.x + state.v.q * edge_arm(edge, state.c, state.s).y);
}

// What the laws see in a blow: the weight as normal force, the speed at which the contact came.
void MoreauStepper::look_about(Step& step, double t) const {
  const Corner k = state_.grip == Grip::none && !step.near[left] ? right
                   : state_.grip == Grip::none                   ? left
                                                                 : carrier(state_);
  const bool flies = state_.grip == Grip::none;
  step.speed = std::abs(flies ? state_.v.x + state_.v.q * step.stop[k].y : state_.w);
  step.place.u_m = slip();
  step.place.path_m = state_.path;
  step.place.time_s = t;
  step.place.normal_g = laws_.gravity_mps2 / standard_gravity_mps2;
}

void MoreauStepper::meet_wall(int edge, double t, double dt) {
  const double speed = into_wall(state_, edge);
  const unsigned bit = 1U << edge, face = 3U << (edge & ~1);
  if (!(speed > 0)) {  // it stands there, and something begins to push it
    state_.touching |= standing(state_) ? face : bit;
    return;
  }
  const State before = state_;
  double back = laws_.walls[static_cast<std::size_t>(edge / 2)]->restitution * speed;
  if (back < standard_gravity_mps2 * dt) back = 0;
  if (standing(state_)) {
    strikes_.face = true;
    state_.v.x = (edge / 2 == left ? 1 : -1) * back;
    if (back == 0) state_.touching |= face;
  } else {
    (edge % 2 == lower ? strikes_.lower : strikes_.upper) = true;
    if (!strike_edge(edge, back, t)) return;
    if (back != 0) state_.touching &= ~bit;
  }
  strikes_.in_flight = strikes_.in_flight || before.grip == Grip::none;
  if (state_.grip != Grip::none) {
    state_.w = state_.closed[left] && state_.closed[right] ? state_.v.x : state_.w;
    if (state_.grip != Grip::stuck || standing(state_))
      state_.grip = state_.w > 0 ? Grip::to_right : state_.w < 0 ? Grip::to_left : Grip::stuck;
    if (state_.grip == Grip::stuck && before.grip != Grip::stuck) hold(t);
  }
  state_.margin = std::numeric_limits<double>::quiet_NaN();
  state_.struck = true;
  state_.stuck_since = t;
  state_.w_rate = state_.corner_rate = state_.base_rate = 0;
  state_.contents_v -= state_.v.x - before.v.x;
}

// The edge leaves its wall at the speed `back`; the corners and the other edges that carry take part.
bool MoreauStepper::strike_edge(int edge, double back, double t) {
  Step step;
  step.t = t;
  step.blow = true;
  step.near = state_.closed;
  step.touching = state_.touching | 1U << edge;
  step.struck = edge;
  step.rebound = back;
  for (const Corner k : {left, right}) step.push[k] = step.stop[k] = arm(k, state_.c, state_.s);
  for (int e = 0; e < edge_count; ++e) step.wall_push[e] = step.wall_stop[e] = edge_arm(e, state_.c, state_.s);
  step.free = state_.v;
  look_about(step, t);
  Case c;
  Refused refused;
  if (!choose(step, state_, c, true, refused)) return false;
  state_.v = c.next;
  state_.w = c.slip;
  return true;
}

}  // namespace freestand::test
