// Options that cannot be used are refused before anything is counted.
#pragma once

#include "fragility/options.hpp"

namespace freestand::fragility {

// Throws Error listing every problem, one a line.
void validate(const Options& options);

// `count` bins of equal width from low to high, as count + 1 edges. Throws Error unless count >= 1 and low < high.
std::vector<double> equal_width_edges(double low, double high, int count);

// Bins that hold the same number of the given values (those that are not finite are left out). Fewer bins come back
// where values repeat so often that edges coincide. Throws Error with fewer than two different values.
std::vector<double> equal_count_edges(std::vector<double> values, int count);

}  // namespace freestand::fragility
