// Where the tests would be measured if they were done again: the predictions of many draws of the numbers, each under the floor
// motion with its noise once more, and the sensor's noise on top.
#pragma once

#include "measurement/fit/posterior.hpp"

namespace freestand::measurement {

// 90 of 100 readings lie between, at each time of a history: from the predictions' median as far as 45 of 100 of them, and the sensor's noise,
// reach to either side, as independent errors do. Empty: not measured.
struct Band {
  std::vector<double> lower, upper;
  bool holds(std::size_t k, double value) const { return lower[k] <= value && value <= upper[k]; }
};
using Bands = std::vector<Band>;  // one a channel

// Of each test; none where the posterior has no draws, or no history was measured.
std::vector<Bands> predicted_bands(const Bench&, const ModelSpec&, const Posterior&, const Jobs&);

// Share of a test's readings, of all channels together, that lie in their bands; nan where there are none.
double share_within(const Test&, const Bands&);

}  // namespace freestand::measurement
