// A floor as its sensor read it, and the motion that the model is shaken by. Between readings that are 5 ms apart or less the floor is taken
// for straight, as between the samples of a record: a line there carries 0.992 of a motion at 10 Hz (sinc^2 of frequency times step), and
// the rest is less than the 1 % to which a gain is known. Between readings that are further apart it is a smooth curve through them, the
// natural cubic spline, in straight pieces of 5 ms or less: recorders filter what is faster than half their rate, and what is left is
// smooth between its readings.
#pragma once

#include <string>
#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

// Is a floor whose readings are so far apart a curve between them?
bool is_smooth(double step_s);

struct FloorReadings {
  std::string name;
  double step_s = 0;
  std::vector<double> horizontal_mps2, vertical_mps2 = {};  // vertical: empty where it was not read

  int pieces() const;  // from one reading to the next: 1 where the floor is straight there, or too short for a curve
  bool smooth() const { return pieces() > 1; }
};

// Of a test whose motion is linear between its knots.
FloorReadings readings_of(const Test&);

// The motion through the readings. Throws Error as piecewise_linear() does.
FloorMotion motion_through(const FloorReadings&);

// Makes it the motion of the test.
void read_floor(Test&, const FloorReadings&);

// At 0, step, 2 step, ... a line, or the natural cubic spline, through values at these places, which increase.
std::vector<double> curve_through(const std::vector<double>& places, const std::vector<double>& values, bool smooth,
                                  double step, std::size_t count);

}  // namespace freestand::measurement
