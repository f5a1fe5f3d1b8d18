// Stretches of the measured histories in which nothing moves, so that what a sensor shows there is its noise.
#pragma once

#include "measurement/bench.hpp"
#include "measurement/sensor.hpp"

namespace freestand::measurement {

// Of one channel of the calibration tests, at least 0.3 s long. Nothing moves where slip and rotation, smoothed over 0.08 s,
// change by less than five times what white noise of the stated size makes, and where the floor stays below 0.7 of what it
// had reached before anything moved, in the test where that was least: slips too short to be seen begin only above. (What
// holds the block was passed by then, and by no more than 1.4 times in every test.)
// A test that starts on its way is quiet only after its last motion.
// None of an acceleration, which shows the floor's, and none where no noise is stated.
std::vector<QuietStretch> quiet_stretches(const Dataset&, Channel);

}  // namespace freestand::measurement
