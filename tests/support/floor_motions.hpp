// Floor motions for the tests, made by hand from their definitions.
#pragma once

#include <freestand/floor_motion.hpp>
#include <vector>

namespace freestand::test {

// Constant acceleration for duration_s, then still.
FloorMotion rectangular_pulse(double acceleration_mps2, double duration_s);

// Constant acceleration over each of the intervals: steps[i] holds for durations[i].
FloorMotion staircase(const std::vector<double>& durations_s, const std::vector<double>& horizontal_mps2,
                      const std::vector<double>& vertical_mps2 = {});

// One period of a sine, unit amplitude and unit period: Taylor polynomials of the closed form, exact to 1e-15.
FloorMotion one_sine();

// The same motion, only its knots doubled: every segment cut into halves. For tests that the knots do not matter.
FloorMotion with_halved_segments(const FloorMotion& motion);

}  // namespace freestand::test
