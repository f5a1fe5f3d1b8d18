// Baseline of a record: what an instrument's zero and its slow drift added to the acceleration that the floor had.
#pragma once

#include <freestand/floor_motion.hpp>

namespace freestand::motion {

// By its velocity, from which it is taken: a straight line (a constant acceleration, a parabola in the displacement) or a
// parabola (an acceleration that grows linearly).
enum class Baseline { linear, quadratic };

// The motion less the line or parabola from zero at its start that fits its velocity best in the least-squares sense, both
// channels, each for itself. The least squares are exact: of the piecewise polynomial over the whole of time, not of samples.
// What was taken off a record before is not found again. Asked for by name only: no reader and no summary does it by itself.
FloorMotion remove_baseline(FloorMotion motion, Baseline baseline);

}  // namespace freestand::motion
