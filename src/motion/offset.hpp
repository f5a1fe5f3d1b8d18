// An offset of a record: a constant acceleration that the floor did not have, left by an instrument's zero.
#pragma once

#include <freestand/floor_motion.hpp>

namespace freestand::motion {

struct Offset {
  double acceleration_mps2 = 0;  // whose velocity, a straight line from 0, fits the floor's best
  double leaving_mps = 0;        // its part of the floor's speed at the end of the record
  double shaking_mps = 0;        // the greatest speed of the floor without it

  // A floor comes back to rest: what is left over at the end cannot be more than what the shaking itself reached.
  bool doubtful() const { return leaving_mps > shaking_mps; }
};

// Of the horizontal channel.
Offset offset(const FloorMotion&);

}  // namespace freestand::motion
