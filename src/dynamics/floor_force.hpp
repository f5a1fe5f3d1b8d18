// The force of the floor on the block's base, per unit mass, along the floor.
//
// An upright block that is pressed against a wall has two supports: friction takes what it can, and the wall the rest.
#pragma once

#include "dynamics/law_arc.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {

// Walls that an upright block touches and that hold it where it stands: towards them it neither slips nor tips.
struct Held {
  bool right = false, left = false;
};
inline Held held_by_walls(const Rig& rig, const State& state) {
  if (state.pivot != 0) return {};
  return {touches_upright(rig, state, 1), touches_upright(rig, state, -1)};
}
// Those that take what friction cannot.
inline Held helped_by_walls(const Rig& rig, const State& state) {
  return state.sigma == 0 && rig.can_slip ? held_by_walls(rig, state) : Held{};
}

template <int N>
double floor_force_at(const Rig&, const State&, const Arc<double, N>& arc, double t) {
  return arc.fx.at(t);
}
template <int N>
double floor_force_at(const Rig& rig, const State& state, const LawArc<N>& arc, double t) {
  const Held held = helped_by_walls(rig, state);
  double force = arc.fx.at(t);
  if (held.right) force = std::fmax(force, -arc.limit_left.at(t));
  if (held.left) force = std::fmin(force, arc.limit_right.at(t));
  return force;
}

// y about the place `by`.
template <int N>
Series<double, N> moved(Series<double, N> y, double by) {
  for (int i = 0; i < N; ++i)
    for (int k = N - 1; k >= i; --k) y[k] += by * y[k + 1];
  return y;
}

// max(peak, max over [0, tau] of |force|).
template <int N>
double peak_floor_force(const Rig&, const State&, const Arc<double, N>& arc, double tau, double peak) {
  return max_abs(arc.fx, tau, peak);
}
template <int N>
double peak_floor_force(const Rig& rig, const State& state, const LawArc<N>& arc, double tau, double peak) {
  const Held held = helped_by_walls(rig, state);
  if (!held.right && !held.left) return max_abs(arc.fx, tau, peak);
  // Piece by piece: where friction is enough, and where it is at its limit.
  const ZeroTolerance zero{0, rig.force_zero};
  for (double from = 0; from <= tau;) {
    const Series<double, N> force = moved(arc.fx, from);
    const Series<double, N> left = moved(arc.limit_left, from), right = moved(arc.limit_right, from);
    const Series<double, N> over_left = combination(1.0, left, 1.0, force),
                            under_right = combination(1.0, right, -1.0, force);
    const bool by_right = held.right && sign_after(over_left, zero) < 0,
               by_left = held.left && sign_after(under_right, zero) < 0;
    double to = tau - from;
    if (held.right) first_root(scaled(by_right ? -1.0 : 1.0, over_left), to, zero, to);
    if (held.left) first_root(scaled(by_left ? -1.0 : 1.0, under_right), to, zero, to);
    peak = max_abs(by_right ? left : by_left ? right : force, to, peak);
    if (!(to > 0)) break;
    from += to;
    if (from >= tau) break;
  }
  return peak;
}

}  // namespace freestand::dynamics
