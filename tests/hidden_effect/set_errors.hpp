// How far models are from the tests of a made set [noise units, root mean square over time and channels].
#pragma once

#include <vector>

#include "hidden_effect/make_set.hpp"

namespace freestand::test {

// Of a history from what was measured in the test.
double error_of(const MadeSet& set, const MadeTest& test, const TruthHistory& history);

// Of the specimen with these effects and the mu that suits them best, from the truth without noise, over all tests.
double error_with(const MadeSet& set, const std::vector<TruthEffect>& effects);

// Least error of those models that lack one of the hidden effects: how far each of them shows. An effect of no catalogue
// also with a static friction in its place, which would do for a contact that ages little.
double weakest_error(const MadeSet& set);

}  // namespace freestand::test
