// The noise of a signal, from its third differences.
#pragma once

#include <vector>

namespace freestand::measurement {

// Standard deviation of the white noise on a measured acceleration, from its third differences in the quiet parts
// [the unit of the signal]. Not above what the signal itself does there, and not below what its resolution makes (resolution.hpp).
double sensor_noise(const std::vector<double>& signal);

}  // namespace freestand::measurement
