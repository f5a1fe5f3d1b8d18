// What the user asks to be done to a record before anything shakes with it, in this order.
#pragma once

#include <freestand/floor_motion.hpp>
#include <optional>

#include "motion/band_pass.hpp"
#include "motion/baseline.hpp"
#include "motion/similitude.hpp"

namespace freestand::motion {

struct Processing {
  std::optional<Baseline> baseline;
  std::optional<BandPass> band;  // in frequencies of the record's own time
  std::optional<Similitude> scale;
};

// The record with all of it done. Throws Error (Exit::data) that names the record where it cannot be.
FloorMotion processed(FloorMotion record, const Processing&);

}  // namespace freestand::motion
