// Channels that are off zero although nothing can have moved yet: an offset of the sensor, or a record that begins late.
#pragma once

#include <optional>

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

// Mean of a channel (slip or rotation) over its first samples, 200 at most, as long as the floor since then has not moved anything by
// half the noise: a block at rest slips at most by the integral of the floor's velocity without its signs, and turns at
// most by that over half its height. 0 where that mean is within the noise of
// one sample (as stated, or as it scatters), and five times that of a mean; and where the floor's channel is dead.
double start_offset(const Bench&, std::size_t test, Channel);

// Does a channel (slip or rotation) move, beyond doubt, while the floor's shows nothing but its noise, and shakes later? Or, in its first
// half second, farther than the floor has by then, where a block follows?
bool moves_before_floor(const Bench&, std::size_t test, Channel);

// Mean of the floor's acceleration [m/s2], where it is one and the same before the shaking and after it: over the first and
// the last twentieth of the record its means are five times their standard errors, and differ at most by half. 0: no offset.
double floor_offset_mps2(const std::vector<double>& floor_mps2);
// The set with these subtracted; an empty one where no floor has an offset.
std::optional<Dataset> without_floor_offsets(const Dataset&);

}  // namespace freestand::measurement
