// What a floor does between its readings. The model takes it for a line or a smooth curve there (floor_readings.hpp), and a history strays
// from what the floor really did. How far, the readings show: left out every second one, the history strays further, in much the same way.
// A floor that is smooth between its readings is missed by lines as h^2, by cubics as h^4: 4 and 16 times as much at twice the step h, and
// at h by a third and a fifteenth of what the thinning adds; one that is not, by up to all of it.
#pragma once

#include <vector>

#include "measurement/data/floor_readings.hpp"

namespace freestand::measurement {

struct BetweenReadings {
  std::vector<FloorMotion> thinned;  // without the odd readings, without the even ones; empty: no floor was read
  double share =
      1;  // of what the thinning adds to a history, of either, that is missing between all readings: 1/15 to 1
};

// noise_mps2: of the floor's readings.
BetweenReadings between_readings(const FloorReadings&, double noise_mps2);

}  // namespace freestand::measurement
