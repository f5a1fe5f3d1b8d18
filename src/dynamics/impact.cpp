#include "dynamics/impact.hpp"

#include <cmath>
#include <limits>

#include "dynamics/impulse.hpp"
#include "dynamics/law_values.hpp"
#include "dynamics/row_of_hops.hpp"
#include "dynamics/wall.hpp"
#include "dynamics/witness.hpp"

namespace freestand::dynamics {
namespace {

Arm<double> arm(const Rig& rig, int pivot, double theta) {
  Arc<double, 1> arc;
  start_arc(arc, rig.corner(pivot), theta, 0.0, 0.0, 0.0);
  return {arc.rx[0], arc.ry[0]};
}

double slip(const Arm<double>& r, const Velocity<double>& v) { return v.vx - v.omega * r.ry; }

// Friction in a blow. Effects see it with the weight as normal force and the slip speed before it; legs pass on none.
struct Grip {
  const Rig& rig;
  double left = 1, right = 1;  // factors on friction against a slip to the left, and to the right

  double mu_s(int sigma) const { return rig.mu_s * (sigma > 0 ? right : left); }
  double mu_k(int sigma) const { return rig.mu_k * (sigma > 0 ? right : left); }
};

Grip grip(const Rig& rig, const State& state, double time) {
  if (!rig.laws) return {rig};
  if (rig.laws->legs.frequency_radps > 0) return {rig, 0, 0};
  return {rig, law_values(rig, state, time, -1).factor, law_values(rig, state, time, 1).factor};
}

// The corner slips in direction sigma while it is stopped vertically. False: no push can stop it.
bool slide_through(const Grip& grip, const Arm<double>& r, const Velocity<double>& before, int sigma,
                   Velocity<double>& after) {
  const double k2 = grip.rig.k2, sigma_mu = sigma * grip.mu_k(sigma);
  const double q = r.rx + sigma_mu * r.ry;
  const double d = k2 + r.rx * q;
  if (!(d > 0)) return false;
  const double py = -(before.vy + before.omega * r.rx) * k2 / d;
  after = {before.vx - sigma_mu * py / grip.rig.carried_mass(), before.vy + py, before.omega + py * q / k2};
  return true;
}

// Plastic impulse on one corner: stick if friction holds, else the slip that keeps its direction.
bool plastic(const Grip& grip, const Arm<double>& r, const Velocity<double>& before, Velocity<double>& after,
             double& w) {
  after = stick(grip.rig.k2, grip.rig.carried_mass(), r, before);
  w = 0;
  const auto [px, py] = impulse(grip.rig.carried_mass(), before, after);
  const int first = px < 0 ? 1 : -1;  // friction opposes the slip
  if (!grip.rig.can_slip || std::abs(px) <= grip.mu_s(first) * py) return true;
  for (const int sigma : {first, -first}) {
    if (!slide_through(grip, r, before, sigma, after)) continue;
    w = slip(r, after);
    if (sigma * w >= 0) return true;
  }
  return false;
}

// Both corners take the blow: the block stays flat, friction of both acts.
void stay_flat(const Grip& grip, State& state, double vx, double vy) {
  const int sigma = vx > 0 ? 1 : -1;
  const double push = std::abs(vy) / grip.rig.carried_mass(), speed = std::abs(vx);
  state.theta = state.omega = 0;
  if (!grip.rig.can_slip || speed <= grip.mu_s(sigma) * push)
    state.w = 0;
  else
    state.w = sigma * std::fmax(speed - grip.mu_k(sigma) * push, 0.0);
}

// A block that comes down flat, fast across, lands on the corner ahead alone and turns over it, where the floor would have
// to pull at the other one for it to stay flat.
bool tips(const Grip& grip, State& state, const Velocity<double>& before) {
  const Rig& rig = grip.rig;
  if (!rig.can_rock || before.vx == 0) return false;
  const int ahead = before.vx > 0 ? 1 : -1;
  const Arm<double> r = arm(rig, ahead, 0.0);
  Velocity<double> after{};
  double w = 0;
  if (!plastic(grip, r, before, after, w) || !(after.omega * ahead > 0)) return false;
  state.pivot = ahead;
  state.omega = after.omega;
  state.w = w;
  return true;
}

bool on_legs(const Rig& rig) { return rig.laws && rig.laws->legs.frequency_radps > 0; }

// Slip speed at the end of the endless row of hops that starts in `state`, impacts leaving the slip as it is. A hop turns rate r
// into -r, and with it the slip by 2 h r + 2 sigma mu_k |c| |r| (its friction beyond that of sliding): two geometric
// series, one hop on either corner in turn. On legs the same goes for the base, whose motion no friction ends: it is the foot
// that slips, and that hands on its friction as long as it does.
double slip_after_hops(const Grip& grip, const State& state, double time) {
  const Rig& rig = grip.rig;
  const double ratio = kept_rate(rig, state.pivot, -state.pivot);  // rate of the second hop to that of the first
  const double rows = 1 / (1 - ratio * kept_rate(rig, -state.pivot, state.pivot));
  const double slip = slip_speed(rig, state), rate = state.omega;
  const int sigma = slip > 0 ? 1 : -1;
  const double mu_k = !on_legs(rig) ? grip.mu_k(sigma)
                      : slip == 0   ? 0
                                    : rig.mu_k * law_values(rig, state, time, sigma).factor;
  const double arms = std::abs(rig.offset(state.pivot)) + ratio * std::abs(rig.offset(-state.pivot));
  const double after = state.w + rows * (2 * rig.h * rate * (1 - ratio) + 2 * sigma * mu_k * arms * std::abs(rate));
  return on_legs(rig) || sigma * after > 0 ? after : 0;
}

// The row of hops starts in `state`, slipping. On legs the base always moves, and what slips is the foot.
bool slip_outlasts_hops(const Grip& friction, State state, double time, const Floor<double, 1>& floor) {
  const Rig& rig = friction.rig;
  if (state.omega == 0 || on_legs(rig)) return true;
  state.mode = Mode::slide_rock;
  const auto start = [&](int pivot, double w) {
    state.pivot = pivot;
    state.sigma = w > 0 ? 1 : -1;
    state.w = state.foot = w;
    return with_contact_arc<1>(rig, state, time, floor, [](const auto& arc) {
      return HopStart{arc.omega[1], arc.w[1]};
    });
  };
  const auto blow = [&](int pivot, double& rate, double& w) {
    if (rig.impact.law == ImpactLaw::housner) {
      rate *= kept_rate(rig, pivot, -pivot);
      return rate != 0;
    }
    Velocity<double> after{};
    const Velocity<double> before = at_centre(arm(rig, pivot, 0.0), w, rate);
    if (!plastic(friction, arm(rig, -pivot, 0.0), before, after, w)) return false;
    rate = after.omega;
    return rate * pivot < 0;
  };
  return outlasts_hops(state.pivot, state.omega, state.w, start, blow);
}

// On the corner of the upright block where it is less, until the floor's segment ends. w: slip.
double given_ahead(const Rig& rig, const State& state, const FloorCursor& cursor, double w) {
  State hop = state;
  hop.mode = w == 0 ? Mode::rock : Mode::slide_rock;
  hop.sigma = w == 0 ? 0 : w > 0 ? 1 : -1;
  hop.w = hop.foot = w;
  hop.theta = hop.omega = 0;
  double given = std::numeric_limits<double>::infinity();
  for (const int pivot : {1, -1}) {
    hop.pivot = pivot;
    with_contact_arc<2>(rig, hop, cursor.time(), cursor.local<2>(), [&](const auto& arc) {
      const double least = dynamics::given_ahead(-pivot * arc.omega[1], -2 * pivot * arc.omega[2], cursor.left());
      given = std::fmin(given, least);
    });
  }
  return given;
}

// The row of hops that starts on `pivot` is over. Where a slip ends within it, the floor may tip the block as it may one that sticks.
bool ends_hops(const Grip& friction, State state, const FloorCursor& cursor, int pivot, double rate) {
  const Rig& rig = friction.rig;
  const double rotation = rig.hop_rotation(pivot, rate);
  if (on_legs(rig)) return rotation < rig.rest_rotation;
  const double kept = std::fmax(kept_rate(rig, 1, -1), kept_rate(rig, -1, 1));
  return row_is_over(rotation, rig.rest_rotation, rate, kept, [&] {
    const double given = given_ahead(rig, state, cursor, state.w);
    if (state.w == 0) return given;
    state.pivot = pivot;
    state.omega = rate;
    if (slip_outlasts_hops(friction, state, cursor.time(), cursor.local<1>())) return given;
    return std::fmin(given, given_ahead(rig, state, cursor, 0.0));
  });
}

}  // namespace

double kept_rate(const Rig& rig, int from, int to) {
  const double kept =
      (rig.k2 + rig.carried_mass() * rig.h * rig.h + rig.offset(from) * rig.offset(to)) / rig.inertia(to);
  return rig.impact.factor * std::fmax(kept, 0.0);
}

bool strike(const Rig& rig, State& state, const FloorCursor& cursor) {
  const double time = cursor.time();
  const Floor<double, 1> floor = cursor.local<1>();
  const Grip friction = grip(rig, state, time);
  const int old_pivot = state.pivot, new_pivot = -state.pivot;
  const double omega = state.omega;
  state.theta = 0;
  state.wall = 0;
  bool over = state.w == 0 && ends_hops(friction, state, cursor, new_pivot, omega);
  if (over) {
    // Whatever the blow leaves.
  } else if (rig.impact.law == ImpactLaw::housner) {
    state.omega = kept_rate(rig, old_pivot, new_pivot) * omega;
    over = ends_hops(friction, state, cursor, new_pivot, state.omega);
    if (over && state.w != 0) {
      state.pivot = new_pivot;
      state.w = slip_outlasts_hops(friction, state, time, floor) ? slip_after_hops(friction, state, time) : 0;
    }
  } else {
    const Velocity<double> before = at_centre(arm(rig, old_pivot, 0.0), state.w, omega);
    Velocity<double> after{};
    double w = 0;
    if (!plastic(friction, arm(rig, new_pivot, 0.0), before, after, w)) return false;
    const bool hops = after.omega * new_pivot > 0;
    if (hops) {
      state.omega = after.omega;
      state.w = w;
      state.pivot = new_pivot;
    }
    over = !hops || ends_hops(friction, state, cursor, new_pivot, after.omega);
    if (!hops || (over && w != 0)) {
      const bool stops = hops && !slip_outlasts_hops(friction, state, time, floor);
      stay_flat(friction, state, before.vx, before.vy);
      if (stops) state.w = 0;
    }
  }
  if (over) state.omega = 0;
  state.pivot = state.omega == 0 ? 0 : new_pivot;
  return true;
}

bool strike_and_hop(const Rig& rig, State& state, double time) {
  const int from = state.pivot, to = -from;
  state.theta = 0;
  state.wall = 0;
  if (rig.impact.law == ImpactLaw::housner) {
    state.omega *= kept_rate(rig, from, to);
  } else {
    Velocity<double> after{};
    const Velocity<double> before = at_centre(arm(rig, from, 0.0), state.w, state.omega);
    if (!plastic(grip(rig, state, time), arm(rig, to, 0.0), before, after, state.w)) return false;
    state.omega = after.omega;
  }
  state.pivot = to;
  return state.omega * to > 0;
}

bool land(const Rig& rig, State& state, int pivot, double time) {
  const Velocity<double> before{state.vx, state.vy, state.omega};
  const bool flat = state.theta == 0 && state.omega == 0;
  const Arm<double> r = flat ? Arm<double>{} : arm(rig, pivot, state.theta);
  state.mode = flat ? Mode::slide : Mode::slide_rock;
  state.wall = 0;
  state.pivot = flat ? 0 : pivot;
  state.xi = flat ? state.x : state.x - r.rx - rig.offset(pivot);
  state.w = slip(r, before);
  state.foot = 0;  // the blow stops a foot under legs, which has no mass
  // In the air there was no friction, and none of its kinks was followed.
  if (rig.laws) state.sides = law_values(rig, state, time, state.w < 0 ? -1 : 1).sides;
  const Grip friction = grip(rig, state, time);
  if (flat && tips(friction, state, before)) return true;
  if (flat) {
    stay_flat(friction, state, before.vx, before.vy);
    return true;
  }
  Velocity<double> after{};
  if (!plastic(friction, r, before, after, state.w)) return false;
  state.omega = after.omega;
  return true;
}

namespace {

// A push at height l over the centre of mass that changes the speed there by dv, of a block on a corner that it lifts.
bool lifts(const Rig& rig, State& state, const Arm<double>& r, const Velocity<double>& before, double l, double dv) {
  const double M = rig.carried_mass(), push = dv / (1 / M + l * l / rig.k2), turn = l * push / rig.k2;
  if (!rig.can_slip || !(r.rx * turn > 0)) return false;
  state.x = rig.offset(state.pivot) + state.xi + r.rx;
  state.y = r.ry;
  state.vx = before.vx + push / M;
  state.vy = before.vy;
  state.omega = before.omega + turn;
  state.mode = Mode::flight;
  state.pivot = state.sigma = 0;
  return true;
}

// The corner carries the push: it sticks, or slips with friction. `speed`: of the edge after it, along x.
bool carries(const Grip& grip, State& state, const Arm<double>& r, const Velocity<double>& before, const EdgeNow& edge,
             double speed, double dv) {
  const double M = grip.rig.carried_mass(), k2 = grip.rig.k2, l = edge.height - r.ry;
  int first = state.w < 0 ? -1 : 1;
  if (edge.height > 0) {
    const Velocity<double> after = at_centre(r, 0.0, speed / edge.height);
    const double along = M * (after.vx - before.vx), py = after.vy - before.vy;
    const double push = (k2 * (after.omega - before.omega) - r.rx * py + r.ry * along) / edge.height;
    const double px = along - push;
    first = px < 0 ? 1 : -1;
    if (!grip.rig.can_slip || std::abs(px) <= grip.mu_s(first) * py) {
      state.omega = after.omega;
      state.w = 0;
      return true;
    }
  }
  for (const int sigma : {first, -first}) {
    const double sigma_mu = sigma * grip.mu_k(sigma);
    const double d = k2 + r.rx * (r.rx + sigma_mu * r.ry) + l * (M * l + sigma_mu * r.rx);
    if (!(d > 0)) continue;
    const double turn = l * M * dv / d, w = speed - edge.height * (before.omega + turn);
    if (-r.rx * turn >= 0 && sigma * w >= 0) {
      state.omega = before.omega + turn;
      state.w = w;
      return true;
    }
  }
  return false;
}

}  // namespace

bool strike_wall(const Rig& rig, State& state, int side, Edge edge, double time, double& speed) {
  const Wall& wall = rig.laws->walls.on(side);
  const bool aloft = state.mode == Mode::flight;
  const bool upright = state.theta == 0 && state.omega == 0;
  const EdgeNow now = edge_now(rig, state, side, edge);
  speed = std::fmax(now.speed, 0.0);
  if (now.speed <= -rig.slow()) return true;
  const bool stays = wall.restitution * speed < rig.slow();
  const double after = stays ? 0.0 : -side * wall.restitution * speed, dv = after - side * now.speed;
  (aloft ? state.x : state.xi) += side * now.gap;  // known to the accuracy of the step
  state.wall = stays ? side : 0;
  state.released = false;
  state.edge = upright ? Edge::face : edge;
  if (upright) {
    (aloft ? state.x : state.xi) = side * wall.gap_m;
    (aloft ? state.vx : state.w) = after;
    state.foot = state.w;
    if (!aloft) state.wall = 0;
  } else if (!aloft && std::abs(dv) < rig.slow()) {
    // An edge that is low over the floor hardly moves however fast the block turns.
    if (state.w == 0 && std::abs(state.omega) * rig.top < rig.slow()) state.omega = 0;
    state.w = state.foot = -now.height * state.omega;
  } else if (aloft) {
    const double M = rig.carried_mass(), push = dv / (1 / M + now.height * now.height / rig.k2);
    state.vx += push / M;
    state.omega += now.height * push / rig.k2;
  } else {
    const Arm<double> r = arm(rig, state.pivot, state.theta);
    const Velocity<double> before = at_centre(r, state.w, state.omega);
    if (!lifts(rig, state, r, before, now.height - r.ry, dv) &&
        !carries(grip(rig, state, time), state, r, before, now, after, dv))
      return false;
    if (state.mode != Mode::flight) state.foot = state.w;
  }
  return true;
}

}  // namespace freestand::dynamics
