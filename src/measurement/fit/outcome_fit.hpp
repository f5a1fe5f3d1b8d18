// Fits to tests that say only whether the specimen overturned. The score (Brier's) of such tests is a flight of steps in
// most numbers, and each step costs thousands of samples. So outcomes are tabulated (outcome_table.hpp) at points that
// close in on the best: first over the whole range on coarse places, then twice over the box of the best points so far.
// Everything else is read off the last table: the fit to all tests; predictions for tests left out, the mean over fits to
// the other folds, resampled (bagging), as one fit alone jumps where one sample falls that stood before; and joint draws
// of what the tests leave open (outcome_draws.hpp), from which all intervals are.
#pragma once

#include "measurement/fit/outcome_table.hpp"

namespace freestand::measurement {

struct OutcomeEffort {
  std::size_t wide = 16, near = 12, nearest = 8;  // points of the three rounds, times the count of other numbers
  std::size_t most = 40;                          // points of a round
  std::size_t draws = 200;
  std::size_t seen_tests = 24, screened_tests = 60;  // with which effects are looked at before they are fitted
};

// Do all calibration tests say no more than whether the specimen overturned?
bool outcomes_only(const Dataset&);

// The model fitted to the calibration tests, complete: errors, folds, intervals, misfit. start: a point to begin with; may be
// empty.
ModelFit fit_outcomes(const Bench&, const ModelSpec&, const Values& start, const OutcomeEffort&, const Jobs&);

// The same with the table that it was read off, from which fits to other outcomes of the same tests are read as well.
struct TabulatedFit {
  ModelFit fit;
  OutcomeTable table;
};
TabulatedFit tabulate_outcomes(const Bench&, const ModelSpec&, const Values& start, const OutcomeEffort&, const Jobs&);

// What happened to the tests of the table in the first column, 1 where one fell; behind it sets drawn from the fit's probabilities.
Eigen::MatrixXf outcome_sets(const Bench&, const TabulatedFit&, std::uint64_t stream, std::size_t sets);

// Is it enough? Each set is fitted again by the rows of the table.
OutcomeMisfit outcome_misfit(const Bench&, const TabulatedFit&);

// Models with one more effect each, from their coarse tables on (outcome_screen.hpp). `without`: fitted.
std::vector<TabulatedFit> tabulate_outcomes(const Bench&, const ModelFit& without,
                                            const std::vector<OutcomeTable*>& coarse, const OutcomeEffort&,
                                            const Jobs&);

// At the best point of each table, on all calibration tests, without folds and intervals; left-out errors are nan.
std::vector<ModelFit> read_outcomes(const Bench&, const std::vector<OutcomeTable*>& coarse, const Jobs&);

}  // namespace freestand::measurement
