// Which effect does the model lack, where all that is known of a test is whether the specimen overturned?
//
// The base is fitted, effects are looked at on the tests that it is least sure of (outcome_screen.hpp), those that promise
// something are fitted with tests left out in ten groups, and once more as a second effect beside the best. Then as of histories, by
// Brier's score (chance_of_outcomes.hpp): an effect is accepted that misses the tests left out by least, and by less than the base, if the
// largest gain of all that were fitted is more than outcomes from the base would give; rivals miss them by less than the base, and their own
// outcomes would give the best its lead; where none of these, or the base if no effect is accepted, is enough for its own outcomes, the
// verdict is `unknown`.
#pragma once

#include "measurement/fit/outcome_fit.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {

Diagnosis diagnose_outcomes(const Bench&, const ModelSpec& base, const std::vector<const dynamics::Effect*>& catalogue,
                            const Values& start, const OutcomeEffort&, const Jobs&);

// Brier's score that the model would have if its probabilities were right, mean of p (1 - p), and how much chance moves
// it: sqrt(sum p (1 - p) (1 - 2 p)^2)/n.
Pooled expected_brier(const std::vector<TestError>&);

}  // namespace freestand::measurement
