// Samples under laws that go along in packs: a row for each number, a slot for each sample. Those of a group are in the same
// mode and have a tape in common, but for its numbers.
#pragma once

#include <freestand/specimen.hpp>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

inline constexpr int law_slots = 32;
inline constexpr int law_order = 7;

enum class Row : int {
  // Standing<Real>
  corner,
  height,
  gyration2,
  half_base,
  mu_k,
  mu_s,
  mass,
  leg_rate,
  leg_damping,
  pivot,
  sigma,
  theta,
  omega,
  xi,
  w,
  path,
  deflection,
  right_gap,
  right_across,
  right_up,
  left_gap,
  left_across,
  left_up,
  // A blow on the other corner
  other_corner,
  inertia,  // about this corner, and about the other one [m2]
  other_inertia,
  kept,  // Housner's ratio there, and of the blow after
  kept_next,
  told_rotation,  // as in Rig
  rest_rotation,
  // Stance<Real>
  right_arm,
  left_arm,
  over_height,
  // Sizes
  over_angle,
  over_rotation,
  over_length,
  over_speed,
  longest_step_s,
  // FloorCursor
  scale,
  vertical_scale,
  stretch,
  push,
  gravity,
  start,
  offset,
  // Peaks
  peak_slip,
  peak_slip_right,
  peak_slip_left,
  slid_path,
  peak_rotation,
  peak_acceleration,
  force_zero,   // as in Rig
  touching,     // an upright block that is nearer to a wall than this touches it
  beside_wall,  // as in wall.hpp [m]
  state         // first of the effects' own
};
inline constexpr int row_count = static_cast<int>(Row::state) + max_states;

struct LawRows {
  const Laws* laws = nullptr;
  bool turns = false, slips = false, can_slip = false, can_rock = false;
  bool slip_by_side = false;
  ImpactLaw impact = ImpactLaw::housner;
  double tolerance = 0;
  int lanes = 0;
  alignas(64) double numbers[row_count][law_slots] = {};
  // Of the tape, by node; of its kinks: +1 or -1, the side on which each lane is, and 1 where it may still turn, else 0.
  alignas(64) double value[max_nodes][law_slots] = {}, shift[max_nodes][law_slots] = {};
  alignas(64) double side[max_kinks][law_slots] = {}, turns_yet[max_kinks][law_slots] = {};
  // Where the present segment of the motion ends; its coefficients; how many segments there are to go, this one included.
  const double *knot[law_slots] = {}, *horizontal[law_slots] = {}, *vertical[law_slots] = {};
  int vertical_stride[law_slots] = {}, segments[law_slots] = {};
  // Steps within the segment; blows that the packs have gone through, those that count as impacts, and how many more may follow.
  int steps[law_slots] = {}, blows[law_slots] = {}, told[law_slots] = {}, room[law_slots] = {};
  int struck[law_slots] = {};  // 1: just so, it is not yet told how it goes on

  double* row(Row which) { return numbers[static_cast<int>(which)]; }
};

// Which lanes stopped: before a step in which something may happen, at the end of their motion, or after a blow that leaves open
// how they go on. Bit l: lane first + l.
struct Stopped {
  unsigned before_step, at_end, undecided;
};

// Steps from knot to knot with lanes [first, first + lanes of a pack), until one stops; those beyond rows.lanes stand still.
// series: room for a LawArc<law_order> a lane, filled with the step before which it stopped.
using LawMarch = Stopped (*)(LawRows& rows, int first, double* series);

}  // namespace freestand::dynamics
