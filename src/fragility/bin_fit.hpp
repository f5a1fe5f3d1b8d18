// The fit of each IM bin of one demand parameter.
#pragma once

#include <vector>

#include "fragility/goodness.hpp"
#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// Counts, intervals, lognormal fit and goodness of fit of every bin of an EDP, with the false discovery control over
// the bins and the status that follows. lambda_se_motions and omega_se_motions are left to the surface, which
// resamples.
std::vector<BinFit> fit_bins(const Tally& tally, std::size_t edp, EstimatedNull& null);

}  // namespace freestand::fragility
