// Which mode comes next: the one whose accelerations and contact forces are consistent just after the instant.
//
// The candidates are few and each is tried in full: its Taylor series must keep every inequality of its mode (forces
// push, friction stays in its cone, slip goes its way, corners do not sink in). No single inequality decides; at a jump
// of a(t) slide-rock may start where the pure-slide and the pure-rock test both say otherwise [Shenton 1996; Scalia &
// Sumbatyan 1996]. Where mu_s > mu_k lets two candidates stand, the stuck one is taken.
#pragma once

#include "dynamics/floor_cursor.hpp"
#include "dynamics/rig.hpp"

namespace freestand::dynamics {

// Order of the series in which candidates are judged, and events watched for by the reference.
inline constexpr int judge_order = max_floor_degree + 3;

// Sets mode, pivot and sigma from theta, omega, w (and x, y on take-off), and whether a wall at which an edge is pushes. Flat
// and not turning (theta = omega = 0): both corners are down. What is in flight stays there. False: no mode is consistent,
// Painleve's paradox.
bool choose_mode(const Rig& rig, const FloorCursor& cursor, State& state);

// Position and velocity of the centre of mass when the last corner leaves the floor.
void take_off(const Rig& rig, State& state);

}  // namespace freestand::dynamics
