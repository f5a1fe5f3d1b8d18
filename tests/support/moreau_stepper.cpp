#include "support/moreau_stepper.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::test {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

MoreauStepper::MoreauStepper(const ContactBody& body, const ContactLaws& laws) : body_(body), laws_(laws) {
  state_.y = body.height_m;
  state_.normal = laws.gravity_mps2;
}

MoreauStepper::Arm MoreauStepper::arm(Corner k, double c, double s) const {
  const double x = k == left ? -body_.left_m : body_.right_m, y = -body_.height_m;
  return {x * c + y * s, -x * s + y * c};
}

MoreauStepper::Arm MoreauStepper::edge_arm(int edge, double c, double s) const {
  const double x = edge / 2 == left ? -body_.left_m : body_.right_m;
  const double y = edge % 2 == lower ? -body_.height_m : body_.height_m;
  return {x * c + y * s, -x * s + y * c};
}

double MoreauStepper::clearance(const State& state, int edge) const {
  const double side = edge / 2 == left ? -1 : 1, face = edge / 2 == left ? -body_.left_m : body_.right_m;
  return laws_.walls[static_cast<std::size_t>(edge / 2)]->gap_m -
         side * (state.x + edge_arm(edge, state.c, state.s).x - face);
}

double MoreauStepper::chain_displacement(double x, double c, double s) const {
  return x - laws_.chain->right_m * (1 - c) + laws_.chain->up_m * s;
}

double MoreauStepper::chain_rise(double y, double c, double s) const {
  return y - body_.height_m - laws_.chain->right_m * s - laws_.chain->up_m * (1 - c);
}

double MoreauStepper::chain_pull(const State& state) const {
  if (!laws_.chain || state.chain_broken) return 0;
  return laws_.chain->pull(chain_displacement(state.x, state.c, state.s), chain_rise(state.y, state.c, state.s));
}

double MoreauStepper::slip_of(const State& state) const {
  const double middle = 0.5 * (body_.right_m - body_.left_m);
  return state.x - middle * (1 - state.c) - body_.height_m * state.s;
}

double MoreauStepper::contact_position(const State& state) const {
  const Corner k = carrier(state);
  return state.x + arm(k, state.c, state.s).x - (k == left ? -body_.left_m : body_.right_m);
}

double MoreauStepper::middle_speed(const State& state) const {
  const double middle = 0.5 * (body_.right_m - body_.left_m);
  return state.v.x - state.v.q * (middle * state.s + body_.height_m * state.c);
}

void MoreauStepper::turn(State& state, double angle) const {
  if (angle == 0) return;
  state.theta += angle;
  if (std::abs(angle) > 1e-3) {
    state.c = std::cos(state.theta);
    state.s = std::sin(state.theta);
    return;
  }
  const double square = angle * angle, c = 1 - square * (0.5 - square / 24), s = angle * (1 - square / 6);
  const double cosine = state.c * c - state.s * s, sine = state.s * c + state.c * s;
  const double norm = 1.5 - 0.5 * (cosine * cosine + sine * sine);
  state.c = norm * cosine;
  state.s = norm * sine;
}

MoreauStepper::Step MoreauStepper::prepare(const State& state, const FloorLine& floor, double t, double dt) const {
  Step step;
  step.t = t;
  step.dt = dt;
  step.near = state.closed;
  step.touching = state.touching;
  State turned = state;
  const auto set_arms = [&](std::array<Arm, 2>& corners, std::array<Arm, edge_count>& edges) {
    turn(turned, 0.5 * dt * state.v.q);
    for (const Corner k : {left, right}) corners[k] = arm(k, turned.c, turned.s);
    for (int edge = 0; state.touching != 0 && edge < edge_count; ++edge)
      edges[edge] = edge_arm(edge, turned.c, turned.s);
  };
  set_arms(step.push, step.wall_push);
  const double middle_c = turned.c, middle_s = turned.s;
  set_arms(step.stop, step.wall_stop);

  const double half = 0.5 * dt, middle = t + half;
  step.a = floor.horizontal(middle) + laws_.push_mps2;
  step.g = laws_.gravity_mps2 + laws_.vertical_scale * floor.vertical(middle);
  const double speed = middle_speed(state);
  step.place.u_m = slip_of(state) + half * speed;
  step.place.path_m = state.path + half * std::abs(state.w);
  step.place.time_s = middle;
  step.speed = std::max(0.0, std::abs(state.w + half * state.w_rate));
  step.age = state.grip == Grip::stuck ? middle - state.stuck_since : 0;

  double force = laws_.force(step.place.u_m, speed + half * state.base_rate);
  if (laws_.contents_ratio != 0) {
    const double W = laws_.contents_radps, at = state.contents + half * state.contents_v;
    step.contents_force = W * W * at + 2 * laws_.contents_damping * W * (state.contents_v + half * state.contents_rate);
    force += laws_.contents_ratio * step.contents_force;
  }
  if (laws_.legs_radps > 0) {
    const double W = laws_.legs_radps;
    step.corner = state.v.x + state.v.q * arm(carrier(state), state.c, state.s).y;
    step.leg_force = -W * (W * (state.legs + half * step.corner) +
                           2 * laws_.legs_damping * (step.corner + half * state.corner_rate));
  }
  double moment = 0;
  if (laws_.chain && !state.chain_broken) {
    const ContactLaws::Chain& chain = *laws_.chain;
    const double pull = chain.pull(chain_displacement(state.x + half * state.v.x, middle_c, middle_s),
                                   chain_rise(state.y + half * state.v.y, middle_c, middle_s));
    const double across = chain.right_m * middle_c + chain.up_m * middle_s,
                 over = chain.up_m * middle_c - chain.right_m * middle_s;
    force -= chain.side * chain.level() * pull;
    step.lift = chain.steep() * pull;
    if (body_.can_tip) moment = -chain.side * chain.level() * pull * over - step.lift * across;
  }
  step.place.normal_g =
      (state.closed[left] && state.closed[right] ? step.g - step.lift : state.normal) / standard_gravity_mps2;
  step.free = {state.v.x + dt * (force / laws_.carried() - step.a), state.v.y + dt * (step.lift - step.g),
               state.v.q + dt * moment / body_.gyration2_m2};
  return step;
}

bool MoreauStepper::advance(State& state, const FloorLine& floor, double t, double dt, std::optional<Grip> forced,
                            Refused& refused) const {
  const State before = state;
  const Step step = prepare(before, floor, t, dt);
  Case c;
  if (forced && before.grip != Grip::none) {
    if (!impulses(step, before, {before.closed[left], before.closed[right], 0}, *forced, c)) return false;
  } else if (!choose(step, state, c, false, refused)) {
    return false;
  }
  move(before, state, step, c);
  return true;
}

void MoreauStepper::move(const State& before, State& state, const Step& step, const Case& c) const {
  const double dt = step.dt, end = step.t + dt;
  const bool on_legs = laws_.legs_radps > 0;
  state.v = c.next;
  state.x += 0.5 * dt * (before.v.x + state.v.x);
  state.y += 0.5 * dt * (before.v.y + state.v.y);
  turn(state, 0.5 * dt * (before.v.q + state.v.q));
  const bool slipping = direction(state.grip) != 0;
  state.w = slipping ? c.slip : 0;
  state.w_rate = slipping ? (state.w - before.w) / dt : 0;
  state.first_w = on_legs && slipping ? c.first_slip() : state.w;
  state.struck = false;
  if (state.closed[left] && state.closed[right]) {
    state.theta = state.s = 0;
    state.c = 1;
  }
  if (state.grip == Grip::none) {
    if (on_legs) state.legs *= laws_.legs_damping > 0 ? std::exp(-0.5 * laws_.legs_radps / laws_.legs_damping * dt) : 0;
  } else {
    const Corner k = carrier(state);
    const Arm r = arm(k, state.c, state.s);
    state.y = -r.y;
    if (state.grip == Grip::stuck && before.grip != Grip::stuck) {
      state.foot = contact_position(state) - (on_legs ? state.legs : 0);
      state.stuck_since = end;
    }
    if (state.grip == Grip::stuck && on_legs) state.legs = contact_position(state) - state.foot;
    if (state.grip == Grip::stuck && !on_legs) state.x += state.foot - contact_position(state);
    if (slipping) {
      if (on_legs) state.legs = c.legs;
      state.path += 0.5 * dt * std::abs(before.w + state.w);
    }
    const double corner = before.v.x + before.v.q * arm(k, before.c, before.s).y;
    state.corner_rate = (state.v.x + state.v.q * r.y - corner) / dt;
  }
  // What touches a wall and may move stays at it.
  for (int edge = 0; state.touching != 0 && edge < edge_count && state.grip != Grip::stuck; ++edge)
    if ((state.touching >> edge & 1U) != 0) state.x += (edge / 2 == left ? -1 : 1) * clearance(state, edge);
  state.base_rate = (middle_speed(state) - middle_speed(before)) / dt;
  state.normal = c.total() / dt;
  state.acceleration = (state.v.x - before.v.x) / dt + step.a;
  constexpr double shortest = 1e-9;  // [s]: of pieces under it the speeds tell nothing
  if (dt > shortest)
    state.felt =
        std::hypot(state.acceleration - laws_.push_mps2, (state.v.y - before.v.y) / dt + step.g - laws_.gravity_mps2);
  if (laws_.contents_ratio != 0) {
    state.contents_rate = -state.acceleration - step.contents_force;
    state.contents_v += dt * state.contents_rate;
    state.contents += 0.5 * dt * (before.contents_v + state.contents_v);
  }
  state.margin = nothing;
  if (state.grip == Grip::stuck && laws_.frictional_jump() && body_.can_slip) {
    state.margin = margin(step, c);
    state.margin_time = step.t + 0.5 * dt;
  }
}

bool MoreauStepper::rest(const FloorLine& floor, double t, double dt) {
  if (!state_.closed[left] || !state_.closed[right] || state_.grip != Grip::stuck) return false;
  if (!laws_.steady_at_rest() || chain_pull(state_) != 0) return false;
  ContactLaws::Place place;
  place.u_m = slip();
  place.path_m = state_.path;
  const double force = laws_.force(place.u_m, 0), h = body_.height_m, ends[] = {t, t + dt};
  double f[2], g[2];
  for (const int i : {0, 1}) {
    f[i] = floor.horizontal(ends[i]) + laws_.push_mps2 - force;
    g[i] = laws_.gravity_mps2 + laws_.vertical_scale * floor.vertical(ends[i]);
    if (!(g[i] > 0)) return false;
    if (body_.can_tip && !(h * f[i] + body_.right_m * g[i] > 0 && body_.left_m * g[i] - h * f[i] > 0)) return false;
  }
  const double least = std::min(g[0], g[1]);
  place.normal_g = least / standard_gravity_mps2;
  const double to_left = std::max(f[0], f[1]), to_right = -std::min(f[0], f[1]);
  if (body_.can_slip &&
      !(to_left < laws_.holding(place, 0, -1) * least && to_right < laws_.holding(place, 0, 1) * least))
    return false;
  state_.margin = nothing;
  state_.acceleration = floor.horizontal(t + dt) + laws_.push_mps2;
  felt_ = std::max(std::hypot(floor.horizontal(t), g[0] - laws_.gravity_mps2),
                   std::hypot(floor.horizontal(t + dt), g[1] - laws_.gravity_mps2));
  state_.normal = g[1];
  return true;
}

}  // namespace freestand::test
