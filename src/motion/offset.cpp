#include "motion/offset.hpp"

#include <cmath>

#include "motion/baseline.hpp"
#include "motion/peaks.hpp"

namespace freestand::motion {

Offset offset(const FloorMotion& motion) {
  const FloorMotion level = remove_baseline(motion, Baseline::linear);
  Offset found;
  found.acceleration_mps2 = motion.horizontal_mps2.front() - level.horizontal_mps2.front();
  found.leaving_mps = std::abs(found.acceleration_mps2) * motion.duration_s();
  found.shaking_mps = peaks(level).pgv_mps;
  return found;
}

}  // namespace freestand::motion
