// The noise of a signal, from its third differences.
#pragma once

#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

// Standard deviation of the white noise on a measured acceleration, from its third differences in the quiet parts
// [the unit of the signal]. Not above what the signal itself does there, and not below what its resolution makes (resolution.hpp).
double sensor_noise(const std::vector<double>& signal);

// The same of an acceleration that is read more than 5 ms apart: in shorter windows, since third differences of so few readings a cycle are
// the motion itself, and what is quiet may be short.
double slow_noise(const std::vector<double>& signal, double step_s);

// Of the floor's acceleration under a test [m/s2]: as stated, or else by the above; 0 of a pulse, and of tests without histories.
double floor_noise_mps2(const Dataset&, const Test&);

}  // namespace freestand::measurement
