// What sensors record of the response, one channel each.
#pragma once

#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

enum class Channel { slip, rotation, block_acceleration };
inline constexpr int channel_count = 3;
const char* name(Channel);  // "slip_m" ...

const std::vector<double>& history(const Test&, Channel);
// Those of it that were read; what stands on straight lines between them tells nothing of the sensor.
std::vector<double> readings(const Test&, Channel);
double noise(const Noise&, Channel);

}  // namespace freestand::measurement
