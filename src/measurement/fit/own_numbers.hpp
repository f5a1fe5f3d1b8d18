// Does friction differ from test to test, or the clock of the responses? The model with a number of its own in each
// calibration test: a factor on its friction, or the time by which its responses are stamped late against the floor's channel [s].
#pragma once

#include <optional>

#include "measurement/fit/judge.hpp"

namespace freestand::measurement {

// Of a factor on the friction of one test: where it is sought, and, with more near one, where first.
inline const Free friction_of_one_test = {
    .name = "factor", .lower = 0.5, .upper = 2, .low = 0.8, .high = 1.25, .logarithmic = true};

struct OwnNumbers {
  std::vector<double> of_tests;  // of each calibration test
  double scatter = 0;            // standard deviation: of the factors' logarithms, of the times
  double misfit = 0;             // G with them, summed over the tests
  double worst = 0;              // the largest G of a test over its samples
  bool at_end = false;           // one ends where it was sought no further
};

OwnNumbers own_friction(const Bench&, const Judge&, const ModelFit&, const Jobs&);
OwnNumbers own_clocks(const Bench&, const Judge&, const ModelFit&, const Jobs&);

// The model as it fits with a friction of its own in each test, which stands in ModelSpec::friction_of_test over the friction of all where
// that is a number of the fit.
struct OwnFriction {
  ModelFit fit;
  OwnNumbers of_tests;
};
// All numbers together, by derivatives from where own_friction() ends.
OwnFriction fitted_with_own_friction(const Bench&, const Judge&, const ModelFit&, const OwnNumbers& start, const Jobs&);

// The same from a fit of one friction to all tests that leaves more than a model may, where frictions of their own explain the tests; else none.
std::optional<OwnFriction> with_own_friction_where_it_explains(const Bench&, const ModelFit&, const Jobs&);

// Do they explain the tests, each of them, where the best of all other models leaves least_misfit over so many samples? By more than
// the largest gain that so many numbers make by chance. (One test in another unit is no friction that differs.)
bool explain_tests(const OwnNumbers&, double samples, double least_misfit);

}  // namespace freestand::measurement
