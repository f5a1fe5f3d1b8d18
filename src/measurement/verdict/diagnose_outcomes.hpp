// Which effect does the model lack, where all that is known of a test is whether the specimen overturned?
//
// The base is fitted, effects are looked at on the tests that it is least sure of (outcome_screen.hpp), those that promise
// something are fitted with tests left out in ten groups, and once more as a second effect beside the best. Judged by
// Brier's score of the tests left out, paired test by test: an effect is accepted that lowers it by more than chance, at
// 97.5 % of Student's t divided by the number of effects that were looked at; a rival of the best lowers it by more than
// its standard error and cannot be told from the best at 97.5 %. Where no effect is accepted and
// the base is surer than it may be, something is missing that no effect explains: the verdict is `unknown`.
#pragma once

#include "measurement/fit/outcome_fit.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {

Diagnosis diagnose_outcomes(const Bench&, const ModelSpec& base, const std::vector<const dynamics::Effect*>& catalogue,
                            const Values& start, const OutcomeEffort&, const Jobs&);

// Brier's score that the model would have if its probabilities were right, mean of p (1 - p), and how much chance moves
// it: sqrt(sum p (1 - p) (1 - 2 p)^2)/n.
Pooled expected_brier(const std::vector<TestError>&);

// Is Brier's score as large as the model's own probabilities make it in one set of twenty at most? Of 2000 sets drawn from them: the
// sum is skewed where they are near 0 or 1. Then the model lacks something, whoever asks.
bool surer_than_it_may_be(const std::vector<TestError>&);

// Is the difference above 0 by more than chance, when it is the best of so many?
bool beyond_chance(const Pooled& difference, std::size_t tests, std::size_t tried);

}  // namespace freestand::measurement
