// Probability that a specimen overturns, when no two placements of it are alike.
#pragma once

#include "measurement/bench.hpp"

namespace freestand::measurement {

// Share of the placements that overturn, of each of these tests: ln(width) is normal about the model's with
// ModelSpec::placement_scatter, and stands at the middles of nine equally likely parts. All samples go as one batch.
std::vector<double> overturning_probabilities(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                              std::span<const double> x);

}  // namespace freestand::measurement
