// Where the floor's noise turns the base's histories elsewhere, any history is one that the base may show, and no gain of an effect refutes it.
// But where such a motion goes nobody foretells. Of a model that was fitted without a test, D is the mean square of its distance to the history
// measured there [noise units]; were the base true, the measured history would be one more of the base's under the floor's noise, and each
// of them would lie as far. observed: -sum over the tests of ln D, against sets of such histories, one drawn for each test. Of the base's with
// its own numbers, and with those that stand beside the effect: the larger p counts, so that the effect is what brings them near.
#pragma once

#include "measurement/verdict/chance.hpp"

namespace freestand::measurement {

// with: the best of so many effects tried, fitted with tests left out; holds the base's numbers first.
Chance chance_of_foretelling(const Bench&, const ModelFit& base, const ModelFit& with, std::size_t tries, const Jobs&);

}  // namespace freestand::measurement
