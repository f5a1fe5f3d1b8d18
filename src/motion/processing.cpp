#include "motion/processing.hpp"

#include <utility>

namespace freestand::motion {

FloorMotion processed(FloorMotion record, const Processing& wanted) {
  if (wanted.baseline) record = remove_baseline(std::move(record), *wanted.baseline);
  if (wanted.band) record = band_pass(record, *wanted.band);
  if (wanted.scale) record = at_scale(std::move(record), *wanted.scale);
  return record;
}

}  // namespace freestand::motion
