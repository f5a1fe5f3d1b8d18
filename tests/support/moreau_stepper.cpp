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

double MoreauStepper::slip() const {
  const double middle = 0.5 * (body_.right_m - body_.left_m);
  return state_.x - middle * (1 - state_.c) - body_.height_m * state_.s;
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
  State turned = state;
  turn(turned, 0.5 * dt * state.v.q);
  for (const Corner k : {left, right}) step.push[k] = arm(k, turned.c, turned.s);
  turn(turned, 0.5 * dt * state.v.q);
  for (const Corner k : {left, right}) step.stop[k] = arm(k, turned.c, turned.s);

  const double half = 0.5 * dt, middle = t + half;
  step.a = floor.horizontal(middle) + laws_.push_mps2;
  step.g = laws_.gravity_mps2 + laws_.vertical_scale * floor.vertical(middle);
  const double speed = middle_speed(state), centre = 0.5 * (body_.right_m - body_.left_m);
  step.place.u_m = state.x - centre * (1 - state.c) - body_.height_m * state.s + half * speed;
  step.place.path_m = state.path + half * std::abs(state.w);
  step.place.time_s = middle;
  step.place.normal_g = (state.closed[left] && state.closed[right] ? step.g : state.normal) / standard_gravity_mps2;
  step.speed = std::max(0.0, std::abs(state.w + half * state.w_rate));
  step.age = middle - state.stuck_since;

  double force = laws_.force(step.place.u_m, speed + half * state.base_rate);
  if (laws_.contents_ratio != 0) {
    const double W = laws_.contents_radps, at = state.contents + half * state.contents_v;
    step.contents_force = W * W * at + 2 * laws_.contents_damping * W * (state.contents_v + half * state.contents_rate);
    force += laws_.contents_ratio * step.contents_force;
  }
  if (laws_.legs_radps > 0) {
    const double W = laws_.legs_radps, corner = state.v.x + state.v.q * arm(carrier(state), state.c, state.s).y;
    step.leg_force =
        -W * (W * (state.legs + half * corner) + 2 * laws_.legs_damping * (corner + half * state.corner_rate));
  }
  step.free = {state.v.x + dt * (force / laws_.carried() - step.a), state.v.y - dt * step.g, state.v.q};
  return step;
}

// Largest ratio of tangential to normal impulse of a contact that is stuck in this case.
double MoreauStepper::holding(const Step& step, const Case& c) const {
  return laws_.holding(step.place, step.age, c.tangential < 0 ? 1 : -1);
}

// Both closed: the base is flat, lift speeds zero means Y' = 0 and theta' = 0.
void MoreauStepper::both_corners(const Step& step, const State& state, Grip grip, bool pressed, Case& c) const {
  const double total = -step.free.y, M = laws_.carried();
  const bool on_legs = laws_.legs_radps > 0;
  c.tangential = on_legs ? step.dt * step.leg_force : -M * step.free.x;
  if (pressed)
    c.tangential = std::clamp(c.tangential, -holding(step, c) * total, holding(step, c) * total);
  else if (grip != Grip::stuck)
    c.tangential = -direction(grip) * laws_.sliding(step.place, step.speed, direction(grip)) * total;
  c.wall = pressed ? -M * step.free.x - c.tangential : 0;
  const double moment = body_.height_m * c.tangential - step.free.q * body_.gyration2_m2;  // b_l N_l - b_r N_r
  c.normal[left] = (moment + body_.right_m * total) / (body_.left_m + body_.right_m);
  c.normal[right] = total - c.normal[left];
  c.next = {step.free.x + (c.tangential + c.wall) / M, 0, 0};
  if (pressed || (grip == Grip::stuck && !on_legs)) c.next.x = 0;
  c.slip = c.next.x;
  sway(step, state, grip, c);
}

// lift = lift_free + nn N + nt T; slip = slip_free + tn N + tt T + P/M, P that of the wall.
bool MoreauStepper::one_corner(const Step& step, Corner k, Grip grip, bool pressed, Case& c) const {
  const Arm &f = step.push[k], &r = step.stop[k];
  const double k2 = body_.gyration2_m2, M = laws_.carried();
  const double nn = 1 + r.x * f.x / k2, nt = -r.x * f.y / k2, tn = -r.y * f.x / k2, tt = 1 / M + r.y * f.y / k2;
  const double lift = step.free.y - step.free.q * r.x, slip = step.free.x + step.free.q * r.y;
  const bool on_legs = laws_.legs_radps > 0, sticks = grip == Grip::stuck && !pressed;
  double& N = c.normal[k];
  if (sticks && on_legs) {
    c.tangential = step.dt * step.leg_force;
    N = -(lift + nt * c.tangential) / nn;
  } else if (sticks) {
    const double det = nn * tt - nt * tn;
    if (det == 0) return false;
    N = (-lift * tt + slip * nt) / det;
    c.tangential = (-slip * nn + lift * tn) / det;
  } else {
    const int sigma = pressed ? (laws_.wall_gap_m > 0 ? 1 : -1) : direction(grip);
    const double mu =
        pressed ? laws_.holding(step.place, step.age, sigma) : laws_.sliding(step.place, step.speed, sigma);
    const double w = nn - sigma * mu * nt;
    if (w == 0) return false;
    N = -lift / w;
    c.tangential = -sigma * mu * N;
    if (pressed) c.wall = -M * (slip + tn * N + tt * c.tangential);
  }
  c.next.x = step.free.x + (c.tangential + c.wall) / M;
  c.next.y = step.free.y + N;
  c.next.q = step.free.q + (f.y * c.tangential - f.x * N) / k2;
  c.slip = grip == Grip::stuck ? 0 : c.next.x + c.next.q * r.y;
  return true;
}

// Deflection of the legs of a slipping foot under the force of this step, and the speed of the foot at its end: y tends
// to -f_x/W^2 at the rate W/(2 z).
void MoreauStepper::sway(const Step& step, const State& state, Grip grip, Case& c) const {
  const double W = laws_.legs_radps, z = laws_.legs_damping;
  if (W == 0 || step.blow) return;
  if (grip == Grip::stuck) {
    c.slip = 0;
    return;
  }
  const double rest = -c.tangential / (step.dt * W * W), left_over = z > 0 ? std::exp(-0.5 * W / z * step.dt) : 0.0;
  c.legs = rest + (state.legs - rest) * left_over;
  c.slip -= z > 0 ? -0.5 * W / z * (c.legs - rest) : (c.legs - state.legs) / step.dt;
}

bool MoreauStepper::impulses(const Step& step, const State& state, bool with_left, bool with_right, Grip grip,
                             bool pressed, Case& c) const {
  c = {};
  if (with_left && with_right) {
    both_corners(step, state, grip, pressed, c);
    return true;
  }
  if (!one_corner(step, with_left ? left : right, grip, pressed, c)) return false;
  sway(step, state, grip, c);
  return true;
}

bool MoreauStepper::allowed(const Step& step, const State& state, Grip grip, bool pressed, bool with_left,
                            bool with_right, const Case& c) const {
  constexpr double round_off = 1e-14;
  const std::array<bool, 2> with{with_left, with_right};
  if (c.total() < 0) return false;
  for (const Corner k : {left, right}) {
    if (body_.can_tip && with[k] && c.normal[k] < 0) return false;
    if (!with[k] && step.near[k] && c.next.y - c.next.q * step.stop[k].x < -round_off) return false;
  }
  if (pressed) return c.wall * laws_.wall_gap_m <= 0;
  // A foot on legs slips on until it stands still; then it sticks, whatever the legs ask of it next.
  if (grip == Grip::stuck && laws_.legs_radps > 0 && direction(state.grip) != 0) return true;
  if (grip == Grip::stuck) return !body_.can_slip || std::abs(c.tangential) <= holding(step, c) * c.total();
  const int sigma = direction(grip);
  if (state.wall == sigma) return false;
  // A foot that begins to slip under legs goes where they push it.
  if (laws_.legs_radps > 0 && state.grip == Grip::stuck) return sigma * step.leg_force <= 0;
  return sigma * c.slip > 0;
}

bool MoreauStepper::choose(const Step& step, State& state, Case& chosen, bool closing, Refused& refused) const {
  bool lifts = true;
  for (const Corner k : {left, right})
    lifts = lifts && (!step.near[k] || step.free.y - step.free.q * step.stop[k].x >= 0);
  if (lifts) {
    chosen = {};
    chosen.next = step.free;
    state.closed = {false, false};
    state.grip = Grip::none;
    return true;
  }
  std::array<Grip, 3> order{Grip::stuck, Grip::to_right, Grip::to_left};
  if (!closing && state.grip == Grip::to_right) order = {Grip::to_right, Grip::stuck, Grip::to_left};
  if (!closing && state.grip == Grip::to_left) order = {Grip::to_left, Grip::stuck, Grip::to_right};
  static constexpr std::array<std::array<bool, 2>, 3> sets{{{true, true}, {true, false}, {false, true}}};
  for (const Grip grip : order)
    for (const bool pressed : {false, true})
      for (const auto& [with_left, with_right] : sets) {
        if ((with_left && !step.near[left]) || (with_right && !step.near[right])) continue;
        if (pressed && (grip != Grip::stuck || state.wall == 0)) continue;
        if (!body_.can_slip && grip != Grip::stuck) continue;
        if (!body_.can_tip && !(with_left && with_right)) continue;
        if (!impulses(step, state, with_left, with_right, grip, pressed, chosen)) continue;
        if (allowed(step, state, grip, pressed, with_left, with_right, chosen)) {
          state.closed = {with_left, with_right};
          state.grip = grip;
          return true;
        }
        if (grip == state.grip && state.closed == std::array<bool, 2>{with_left, with_right} && !pressed) {
          refused.slip = chosen.slip;
          if (grip == Grip::stuck) refused.margin = margin(step, chosen);
        }
      }
  return false;
}

bool MoreauStepper::advance(State& state, const FloorLine& floor, double t, double dt, std::optional<Grip> forced,
                            Refused& refused) const {
  const State before = state;
  Step step = prepare(before, floor, t, dt);
  Case c;
  // Friction that depends on the normal force, which depends on it where the block rocks.
  const bool one = before.closed[left] != before.closed[right];
  for (int round = laws_.pressure_exponent != 0 && one ? 4 : 1; round > 0; --round) {
    state = before;
    if (forced && before.grip != Grip::none) {
      if (!impulses(step, before, before.closed[left], before.closed[right], *forced, false, c)) return false;
    } else if (!choose(step, state, c, false, refused)) {
      return false;
    }
    step.place.normal_g = c.total() / (dt * standard_gravity_mps2);
  }
  move(before, state, step, c);
  return true;
}

double MoreauStepper::margin(const Step& step, const Case& c) const {
  return (holding(step, c) * c.total() - std::abs(c.tangential)) / step.dt;
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
  if (state.closed[left] && state.closed[right]) {
    state.theta = state.s = 0;
    state.c = 1;
  }
  if (state.grip == Grip::none) {
    state.wall = 0;
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
      if (state.wall != direction(state.grip)) state.wall = 0;
    }
    const double corner = before.v.x + before.v.q * arm(k, before.c, before.s).y;
    state.corner_rate = (state.v.x + state.v.q * r.y - corner) / dt;
  }
  state.base_rate = (middle_speed(state) - middle_speed(before)) / dt;
  state.normal = c.total() / dt;
  state.acceleration = (state.v.x - before.v.x) / dt + step.a;
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
  if (!state_.closed[left] || !state_.closed[right] || state_.grip != Grip::stuck || state_.wall != 0) return false;
  if (!laws_.steady_at_rest()) return false;
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
  state_.normal = g[1];
  return true;
}

}  // namespace freestand::test
