// Exceedance surfaces of one demand parameter, with bands from resampled motions.
#pragma once

#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// IM x C. A row is the three-part fit of its bin, or the plain fraction of samples above C where the bin has no fit or
// (with Options::empirical_fallback) fails goodness of fit, or empty where it has too few samples. Also sets the
// standard errors of the bins by resampling.
//
// A row of plain fractions has the interval of a share with motions as the unit (clusters.hpp), and a fitted row in which
// nothing overturned (or nothing stood still) carries that limit. Measured on made-up studies with strong differences between motions: bands of nominal 95 % hold the truth in 87 to
// 92 % of the cases with 8 motions, 90 to 95 % with 20, 93 to 95 % with 40 or more.
Surface surface(const Tally& tally, std::size_t edp, const Resampling& resampling, std::vector<BinFit>& bins);

// IM x axis x C, plain fractions.
AxisSurface axis_surface(const Tally& tally, std::size_t edp, std::size_t axis);

}  // namespace freestand::fragility
