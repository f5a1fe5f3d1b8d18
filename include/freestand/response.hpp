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
  at_rest,     // never moved
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
                           // overturned without its fall (dynamics/overturned.hpp)
  // max u and max -u, of a sample with Settings::slip_by_side; else nan.
  double peak_slip_right_m = std::numeric_limits<double>::quiet_NaN();
  double peak_slip_left_m = std::numeric_limits<double>::quiet_NaN();
  double residual_slip_m = 0;    // u at the end (signed)
  double slid_path_m = 0;        // integral of |slip speed of the contact|
  double peak_rotation_rad = 0;  // max |theta|
  double residual_rotation_rad = 0;
  // Max of the vector sum of the centre of mass's total acceleration; blows left out, but no hop, however short (small_hops.cpp).
  double peak_acceleration_mps2 = 0;
  bool connection_failed = false;  // of a chain to the wall
  int impacts = 0;                 // rocking impacts and landings
  int wall_hits = 0;               // blows of walls
  double wall_speed_mps = 0;       // largest speed of an edge at such a blow
  int events = 0;                  // all mode changes and impacts
  double end_time_s = 0;           // when the integration could stop: at rest for good, or overturned
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
};

struct History {
  double step_s = 0.005;  // output step; 0: events only
  std::vector<HistoryPoint> points;
  std::vector<Event> events;
};

}  // namespace freestand
