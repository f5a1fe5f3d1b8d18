// Floors of a building under a record, for `freestand motion`.
#pragma once

#include <freestand/floor_motion.hpp>
#include <string>
#include <vector>

#include "motion/building_response.hpp"

namespace freestand::app {

class Floors {
 public:
  // The two outlive it. Throws Error where no mode lies in the record's band.
  Floors(const FloorMotion& ground, const motion::Building& building);

  // Modes of the building, and a row for each of its floors.
  std::string text();
  FloorMotion motion_of(int storey);

 private:
  const FloorMotion& ground_;
  const motion::Building& building_;
  std::vector<motion::Mode> modes_;
  motion::BuildingResponse response_;
};

}  // namespace freestand::app
