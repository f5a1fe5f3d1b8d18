// What a floor does between its readings. The model takes it for straight there, and a history strays from what the floor really
// did. How far, the readings show: left out every second one, the history strays further, in much the same way. A floor that is smooth between
// its readings is missed by h^2, four times as much at twice the step h, and by a third of what the thinning adds; one that is not, by up to
// all of it.
#pragma once

#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

struct BetweenReadings {
  std::vector<FloorMotion> thinned;  // without the odd readings, without the even ones; empty: no floor was read
  double share =
      1;  // of what the thinning adds to a history, of either, that is missing between all readings: 1/3 to 1
};

// noise_mps2: of the floor's readings.
BetweenReadings between_readings(const FloorMotion&, double noise_mps2);

}  // namespace freestand::measurement
