// Samples under laws that go along in packs: a row for each number, a slot for each sample. Those of a group are in the same
// mode and have a tape in common, but for its numbers.
#pragma once

#include <freestand/response.hpp>
#include <freestand/specimen.hpp>

#include "dynamics/floor_cursor.hpp"
#include "dynamics/laws.hpp"

namespace freestand::dynamics {

inline constexpr int law_slots = 32;

// Steps on records: the floor is linear between knots that lie close together. Those on pulses, whose pieces are longer and of
// higher degree; they know no vertical channel.
struct OnRecords {
  static constexpr int order = 7, degree = 1, vertical_degree = 1;
};
struct OnPulses {
  static constexpr int order = 10, degree = max_floor_degree, vertical_degree = 0;
};

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
  still_since,
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
  instant,
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
  vertical_scale,
  stretch,
  push,
  gravity,
  start,
  offset,
  end,   // of the time given, after the motion
  over,  // 1: the motion is over
  // Peaks
  peak_slip,
  peak_slip_right,
  peak_slip_left,
  slid_path,
  peak_rotation,
  peak_acceleration,
  force_zero,  // as in Rig
  turn_zero,
  touching,     // an upright block that is nearer to a wall than this touches it
  beside_wall,  // as in wall.hpp [m]
  // OutputTimes
  output_step,  // of the history [s]
  next_output,  // instant of its next point [s]; infinite: no history
  state         // first of the effects' own
};
inline constexpr int row_count = static_cast<int>(Row::state) + max_states;

// What has happened to a sample at this instant; how it goes on is not yet told.
enum class Just : int { nothing, struck, turned };

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
  alignas(64) double met[max_kinks][law_slots] = {};  // 1: at this instant (kinks.hpp)
  // The present segment of the motion: where it ends, in the motion's own time, its coefficients and those of a vertical channel;
  // and what makes coefficient k one of seconds, scale / stretch^k.
  alignas(64) double knot[law_slots] = {}, horizontal[max_floor_degree + 1][law_slots] = {};
  alignas(64) double vertical[2][law_slots] = {}, unit[max_floor_degree + 1][law_slots] = {};
  // Where they come from; how many coefficients a segment has; segments to go, this one included.
  FloorCursor::Place place[law_slots] = {};
  int coefficients[law_slots] = {}, segments[law_slots] = {};
  // Steps within the segment; blows that the packs have gone through, those that count as impacts, kinks that have turned, and how many
  // events there may be.
  int steps[law_slots] = {}, blows[law_slots] = {}, told[law_slots] = {}, kinked[law_slots] = {}, room[law_slots] = {};
  Just just[law_slots] = {};
  // What is written of each: null, or its history, and how many points of it lie behind.
  History* history[law_slots] = {};
  long points[law_slots] = {};
  Mode mode[law_slots] = {};

  double* row(Row which) { return numbers[static_cast<int>(which)]; }
  // The coefficients of the segment at which lane i is.
  void read_segment(int i) {
    const FloorCursor::Place& at = place[i];
    knot[i] = *at.knot_at_end;
    for (int k = 0; k < coefficients[i]; ++k) horizontal[k][i] = at.horizontal[k];
    if (at.vertical) vertical[0][i] = at.vertical[0], vertical[1][i] = at.vertical[1];
  }
};

// Compiled for any machine, as what packs do not share with it must be.
HistoryPoint& add_point(History&);
void add_blow(History&, double time_s, int pivot);  // of a block that rocks on

// Which lanes stopped: before a step in which something may happen, or whose forces the pack did not find, at the end of their motion,
// or after a blow or a kink that leaves open how they go on. Bit l: lane l.
struct Stopped {
  unsigned before_step, unsolved, at_end, undecided;
  unsigned any() const { return before_step | unsolved | at_end | undecided; }
};

// Steps with the first pack of lanes, until one stops; those beyond rows.lanes stand still.
// series: room for a LawArc of the motion's order a lane, filled with the step before which it stopped.
using LawMarch = Stopped (*)(LawRows& rows, double* series);

}  // namespace freestand::dynamics
