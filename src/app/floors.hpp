// Floors of a building under a record, for `freestand motion`.
#pragma once

#include <freestand/floor_motion.hpp>
#include <string>

#include "motion/building.hpp"

namespace freestand::app {

// Modes of the building, and a row for each of its floors.
std::string floors_text(const FloorMotion& ground, const motion::Building& building);

// The motion of that floor. Throws Error where there is none, or no mode lies in the record's band.
FloorMotion floor_of(const FloorMotion& ground, const motion::Building& building, int storey);

}  // namespace freestand::app
