// Where the tests would be measured if they were done again: the predictions of many draws of the numbers, each under the floor
// motion with its noise once more, and the sensor's noise on top.
//
// The mean of these predictions errs least in the mean square, where draws and noise are as they say: the history of the best numbers
// is one of the many that could have come out, and of a test that fans out it may be far from most.
#pragma once

#include "measurement/fit/posterior.hpp"

namespace freestand::measurement {

// 90 of 100 readings lie between, at each time of a history: from the predictions' median as far as 45 of 100 of them, and the sensor's noise,
// reach to either side, as independent errors do. mean: of the predictions. Empty: not measured.
struct Band {
  std::vector<double> lower, mean, upper;
  bool holds(std::size_t k, double value) const { return lower[k] <= value && value <= upper[k]; }
};
using Bands = std::vector<Band>;  // one a channel

// Of each test; none where the posterior has no draws, or no history was measured.
std::vector<Bands> predicted_bands(const Bench&, const ModelSpec&, const Posterior&, const Jobs&);

// How far the mean of the predictions is from the test; nan where there are none.
TestError error_of_mean(const Bench&, std::size_t test, const Bands&);

// Share of a test's readings, of all channels together, that lie in their bands; nan where there are none.
double share_within(const Bench&, const Test&, const Bands&);

}  // namespace freestand::measurement
