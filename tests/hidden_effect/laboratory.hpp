// Laboratories are not perfect. What may be at fault where a set is measured, one at a time; the specimen and its floor
// stay as they were.
//
//   coloured_noise     slip and rotation sensors whose noise is as large as stated and correlated over 0.3 s
//   drift              a slip sensor that drifts away from zero, evenly, by 3 to 6 times its noise in a test
//   gain               a floor accelerometer that reads 1 to 3 % too much or too little
//   wrong_width        a width that is stated 2 % too large or too small
//   friction_scatter   friction that differs from test to test by 6 % (standard deviation of its logarithm)
//   understated_noise  noise of slip and rotation that is stated half as large as it is
//   overstated_noise   and twice as large
//   late_clock         responses that are written 10 to 25 ms too late, or too early
//   one_late_clock     those of the first test only
//   no_filter          a recorder that reads slower than the floor moves and filters nothing (below 200 Hz; above, no fault)
#pragma once

#include "hidden_effect/make_set.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {

const std::vector<std::string>& laboratory_faults();

// Measures the set once more with that fault. Throws std::invalid_argument on one that does not exist.
void spoil(MadeSet& set, const std::string& fault, KeyedRandom random, double step_s);

}  // namespace freestand::test
