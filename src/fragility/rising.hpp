// A curve that never falls, nearest to one that does.
#pragma once

#include <vector>

namespace freestand::fragility {

// The non-falling values with the smallest weighted squares of changes (neighbours that fall are pooled to their weighted
// mean, until none does).
std::vector<double> risen(const std::vector<double>& values, const std::vector<double>& weights);

}  // namespace freestand::fragility
