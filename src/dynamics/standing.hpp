// A block on the floor, as the equations with laws read it: one sample, or those of a pack.
#pragma once

#include "dynamics/wall.hpp"

namespace freestand::dynamics {

// Which mode samples are in: they turn about a corner, or not, and slip, or not. Of a pack the degrees of the floor's polynomials are
// known besides, across and along gravity.
struct AnyKind {
  bool turns_, slips_;
  bool turns() const { return turns_; }
  bool slips() const { return slips_; }
};
template <bool turning, bool slipping, class Motion>
struct Kind {
  static constexpr int degree = Motion::degree, vertical_degree = Motion::vertical_degree;
  static constexpr bool turns() { return turning; }
  static constexpr bool slips() { return slipping; }
};

// A block on one corner or on both, as the equations read it: one sample, or those of a pack.
template <class Real>
struct Standing {
  Corner<Real> body;           // the corner that it stands on; the right one where it stands on both
  Real half_base;              // B on the right corner, -B on the left one, 0 on both [m]
  Real mu_k, mu_s;             // [1]
  Real mass;                   // M [1]
  Real leg_rate, leg_damping;  // W [rad/s], z [1]
  Real pivot, sigma;           // as in State
  Real theta, omega, xi, w, path, deflection, foot;
  Real states[max_states];
  Real time;         // [s]
  Real still_since;  // as in State [s]
  ToWall<Real> right_wall, left_wall;
};

// What the equations of one sample keep for themselves; those of a pack are read where the pack is.
template <class Real>
struct OwnStanding {};
template <>
struct OwnStanding<double> {
  Standing<double> own;
};

inline Standing<double> standing_of(const Rig& rig, const State& state, double time) {
  const int pivot = state.pivot != 0 ? state.pivot : 1;
  Standing<double> at{};
  at.body = rig.corner(pivot);
  at.half_base = state.pivot * rig.half_base();
  at.mu_k = rig.mu_k;
  at.mu_s = rig.mu_s;
  at.mass = rig.laws->carried_mass;
  at.leg_rate = rig.laws->legs.frequency_radps;
  at.leg_damping = rig.laws->legs.damping;
  at.pivot = state.pivot;
  at.sigma = state.sigma;
  at.theta = state.theta;
  at.omega = state.omega;
  at.xi = state.xi;
  at.w = state.w;
  at.path = state.path;
  at.deflection = state.deflection;
  at.foot = state.foot;
  at.time = time;
  at.still_since = state.still_since;
  for (int i = 0; i < rig.laws->states; ++i) at.states[i] = state.states[static_cast<std::size_t>(i)];
  if (!rig.laws->walls.any()) return at;
  for (const int side : {1, -1})
    (side > 0 ? at.right_wall : at.left_wall) =
        to_wall(rig, side, lever_over_corner(rig, pivot, side, touching_edge(state.pivot, side)));
  return at;
}

}  // namespace freestand::dynamics
