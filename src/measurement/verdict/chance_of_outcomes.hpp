// chance.hpp for tests that say only whether the specimen overturned: outcomes are drawn from the probabilities of a fitted model, and every
// model is fitted to them again by the rows of the table that it was read off. What counts are mean Brier scores.
#pragma once

#include "measurement/fit/outcome_fit.hpp"
#include "measurement/verdict/chance.hpp"

namespace freestand::measurement {

// By how much each model tried, which holds the base's numbers first, lowers the base's score of tests left out: of what happened, and behind
// that of each set from the base. (The rows lie nearest where what happened is fitted best: by fits to all tests chance would seem to gain less
// than it does, p <= 0.05 in 6 of 60 sets.)
std::vector<Eigen::VectorXf> gains_of_outcomes(const Bench&, const TabulatedFit& base,
                                               const std::vector<const TabulatedFit*>& tried, const Jobs&);

// Does any effect help? observed: the largest gain of these, one at least.
Chance chance_of_gain_of_outcomes(const std::vector<Eigen::VectorXf>& gains);

// Can the best be told from a rival? observed: the score of the rival less that of the best.
Chance chance_of_lead_of_outcomes(const Bench&, const TabulatedFit& best, const TabulatedFit& rival, const Jobs&);

// Is a model enough (outcome_misfit.hpp)? observed: 1 less the smaller of the two p values of its score and of how many fell.
Chance chance_of_misfit(const OutcomeMisfit&);

}  // namespace freestand::measurement
