// Impacts: what happens to the velocities when a corner strikes the floor.  [KM05 6.17, 6.32; PHYSICS: plastic,
// Coulomb]
//
// Impulse p = (p_x, p_y) per unit mass on a corner, r from the corner to the centre of mass (contact.hpp):
//   V_x+ - V_x- = p_x,   V_y+ - V_y- = p_y,   k^2 (omega+ - omega-) = r_x p_y - r_y p_x
//   corner's velocity:  w = V_x - omega r_y,   v_n = V_y + omega r_x
#pragma once

#include "dynamics/floor_cursor.hpp"
#include "dynamics/rig.hpp"

namespace freestand::dynamics {

// theta = 0: the raised corner strikes. state.pivot is the corner that carried until now. Sets omega, w, and theta = 0;
// omega = 0 when both corners stay down or the next hop would be too small to tell. False: Painleve's paradox.
//   housner: omega+ = factor (k^2 + h^2 + c_old c_new)/(k^2 + h^2 + c_new^2) omega-, w+ = w-
//            uniform block: 1 - 1.5 sin^2(alpha)
//   coulomb: plastic impulse at the new corner that sticks (|p_x| <= mu_s p_y) or slips (p_x = -sigma mu_k p_y);
//            where the old corner would be pushed into the floor, both stay down
// Of a slipping block the endless row of ever smaller hops is replaced by its limit: under `coulomb` the blow on both
// corners at once, with the friction of all its impulses; under `housner` the sum over its hops; under both nothing, if the slip
// ends within the row. cursor: at the instant.
bool strike(const Rig& rig, State& state, const FloorCursor& cursor);

// The same blow, and of however small a hop its start: omega and w after it, on the corner that struck. False: both corners
// stay down, or Painleve's paradox.
bool strike_and_hop(const Rig& rig, State& state, double time);

// Housner's ratio of the rates after and before an impact in which corner `from` gives over to `to`.
double kept_rate(const Rig& rig, int from, int to);

// End of a flight on one corner (pivot +1 or -1), or flat on both. Plastic, with Coulomb friction, whatever the impact
// law: Housner's law says nothing of a landing. Sets pivot's xi, w, omega. False: Painleve's paradox.
bool land(const Rig& rig, State& state, int pivot, double time);

// An edge of the side face reaches a wall: by the wall's push at that edge it comes back with e times its speed. A slow one
// stays at the wall. On the corner that carries acts a plastic impulse with Coulomb friction; it lifts where the floor would
// have to pull, and then the block is in flight. An upright block is pushed along its whole face, and stays upright.
// speed: at which the edge came [m/s]. False: Painleve's paradox.
bool strike_wall(const Rig& rig, State& state, int side, Edge edge, double time, double& speed);

}  // namespace freestand::dynamics
