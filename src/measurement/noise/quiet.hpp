// Stretches of the measured histories in which nothing moves, so that what a sensor shows there is its noise.
#pragma once

#include "measurement/data/channel.hpp"
#include "measurement/noise/sensor.hpp"

namespace freestand::measurement {

// The floor below which not even slips too short to be seen begin: 0.7 of two bounds on what holds the block, what carries it while it
// slips, its own acceleration then, and the floor that had been reached before anything moved, in the test where that was least. (0.7:
// friction at the start of a slip may be less than in its middle, by what the laws of the catalogue say as they are met in practice.)
// Infinite where nothing moves.
double floor_without_slip_mps2(const Dataset&);

// Of one channel of the calibration tests, at least 0.3 s long. Nothing moves where slip and rotation, smoothed over 0.08 s,
// change by less than five times what white noise of the stated size makes, and where the floor stays below that.
// A test that starts on its way is quiet only after its last motion.
// None where no noise is stated. Of an acceleration, which shows the floor's, what is left over that, over the noise of both, while the floor
// stays within five times its noise: more of it legs and gains would show.
std::vector<QuietStretch> quiet_stretches(const Dataset&, Channel);

}  // namespace freestand::measurement
