// What a comparison says, one plain sentence a finding; the weightiest first.
#pragma once

#include "measurement/compare.hpp"

namespace freestand::measurement {

std::vector<std::string> findings(const Bench&, const ModelSpec&, std::span<const double> x, const Comparison&,
                                  const Quality&);

// Of the fitted numbers, those that the tests leave open: the interval is nearly all of the range, or ends at one of its
// bounds.
std::vector<std::string> undetermined(const ModelFit&);

}  // namespace freestand::measurement
