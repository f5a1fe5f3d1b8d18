// What comes back from one integration.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace freestand {

// Contact state x friction state, and the absorbing end.
enum class Mode : int { rest, slide, rock, slide_rock, flight, overturned };
const char* name(Mode mode);

// How a sample ended. Failure is data: counted and reported, never thrown, never averaged in silently.
enum class Outcome : int {
  at_rest,     // never moved; on legs that give way: no leg let go and no foot slipped, however the block swayed
  moved,       // moved and stood
  overturned,  // |theta| passed pi/2
  painleve,    // no consistent motion: friction too high for a slipping corner
  step_limit,  // more events or steps than the settings allow, or steps that do not come forward
  not_finite   // a state that is not a number, or beyond all bounds
};
inline constexpr int outcome_count = 6;
const char* name(Outcome outcome);
const char* failure(Outcome outcome);  // why the computation broke off, in words; "" where it did not

struct Response {
  Outcome outcome = Outcome::at_rest;
  double peak_slip_m = 0;  // max |u|, u = displacement of the base's midpoint relative to the floor; of a block that
                           // overturned without its fall (dynamics/overturned.hpp); the size of the vector where the
                           // floor moves in both horizontal directions
  // max u and max -u, of a sample with Settings::slip_by_side; else nan.
  double peak_slip_right_m = std::numeric_limits<double>::quiet_NaN();
  double peak_slip_left_m = std::numeric_limits<double>::quiet_NaN();
  double residual_slip_m = 0;        // u at the end (signed)
  double residual_cross_slip_m = 0;  // the same across it, of a floor that moves in both horizontal directions
  double slid_path_m = 0;            // integral of |slip speed of the contact|
  double peak_rotation_rad = 0;      // max |theta|
  double residual_rotation_rad = 0;
  // Max of the vector sum of the centre of mass's total acceleration; blows left out, but no hop, however short (small_hops.cpp).
  // Beside a wall what lasts less than 1.5e-3/p before or after a blow is left out too (Peaks::event_beside_wall).
  double peak_acceleration_mps2 = 0;
  // The same of the point at Settings::acceleration_height_m, and the largest jump of its velocity in a blow of the floor or of
  // a wall; without that height nan.
  double peak_acceleration_at_height_mps2 = std::numeric_limits<double>::quiet_NaN();
  double largest_blow_mps = std::numeric_limits<double>::quiet_NaN();
  // Of a sample with Settings::contact_forces, else nan; over the mass, blows left out. Largest forces of the floor on the
  // block, along the floor and up, both corners together, and of one chain; and of the spring of what moves inside, over its own
  // mass: its total acceleration.
  double peak_contact_horizontal_mps2 = std::numeric_limits<double>::quiet_NaN();
  double peak_contact_vertical_mps2 = std::numeric_limits<double>::quiet_NaN();
  double peak_chain_force_mps2 = std::numeric_limits<double>::quiet_NaN();
  double peak_contents_acceleration_mps2 = std::numeric_limits<double>::quiet_NaN();
  // Of legs that flex (effect flexible_legs): the largest sway of the block over its foot, and the amplitude of the one cycle of it that
  // tires them as much as all its cycles together (dynamics/rainflow.hpp).
  double peak_leg_deflection_m = std::numeric_limits<double>::quiet_NaN();
  double leg_fatigue_m = std::numeric_limits<double>::quiet_NaN();
  bool connection_failed = false;  // of a chain to the wall
  int impacts = 0;                 // rocking impacts and landings
  int wall_hits = 0;               // blows of walls, or of a neighbour
  double wall_speed_mps = 0;       // largest speed of an edge at such a blow, towards what it strikes
  int events = 0;                  // all mode changes and impacts
  double end_time_s =
      0;  // when it is at rest for good (not before the motion ends; after the last of its endless hops), or overturned
};

// One change of mode, for tests, histories and error reports.
struct Event {
  double time_s;
  Mode from, to;
  int pivot;  // after the event: +1 right corner, -1 left corner, 0 both or none
  bool impact;
};

// One point of a history.
struct HistoryPoint {
  double time_s, floor_acceleration_mps2, slip_m, slip_velocity_mps, rotation_rad, rotation_rate_radps;
  Mode mode;
  // Where History::forces. Total acceleration of the block's point at Settings::acceleration_height_m, else of its centre of
  // mass: to the right, and up.
  double acceleration_mps2 = 0, vertical_acceleration_mps2 = 0;
  // Force of the floor on the block over its mass, to the right and up, both corners together; of model bouc_wen with the
  // forces of laws.
  double contact_x_mps2 = 0, contact_y_mps2 = 0;
  double cross_slip_m = 0, cross_slip_velocity_mps = 0, floor_cross_acceleration_mps2 = 0;  // where History::cross
};

struct History {
  double step_s = 0.005;  // output step; 0: events only
  std::vector<HistoryPoint> points;
  std::vector<Event> events;
  bool forces =
      false;  // asked for: accelerations and the force of the floor too, which fits of many histories do without
  bool cross = false;  // the floor moves in both horizontal directions, and slip is a vector
};

}  // namespace freestand
