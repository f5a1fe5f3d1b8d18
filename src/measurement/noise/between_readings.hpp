// What a floor does between its readings. The model takes it for a line or a smooth curve there (floor_readings.hpp), and a history strays
// from what the floor really did. How far, the readings show: left out every second one, those between are missed, and the history strays in
// much the same way, but further. A floor that is smooth between its readings is missed by lines as h^2, by cubics as h^4: 4 and 16 times
// as much at twice the step h, and at h by a third and a fifteenth of what the thinning adds; one that is not, by up to all of it.
#pragma once

#include <vector>

#include "measurement/data/floor_readings.hpp"

namespace freestand::measurement {

struct BetweenReadings {
  double share = 1;  // of what the thinning adds that is missing between all readings: 1/15 to 1
  // With the odd readings moved by this share of the way to what the others say, and with the even ones; empty: no floor was read.
  std::vector<FloorMotion> strayed;
};

// noise_mps2: of the floor's readings.
BetweenReadings between_readings(const FloorReadings&, double noise_mps2);

}  // namespace freestand::measurement
