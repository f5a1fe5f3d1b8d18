// Curves over all intensities: of overturning, and of a demand above a capacity.
#pragma once

#include "fragility/groups.hpp"
#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// Probit regression on ln IM of the counts in fine cells of IM (probit.hpp), with everything that says how good it is
// from resampled motions. Cells with IM <= 0 do not enter the fit.
FragilityFunction overturning_function(const Tally& tally, const Resampling& resampling);
FragilityFunction fragility_function(const Tally& tally, std::size_t edp, std::size_t capacity,
                                     const Resampling& resampling);

// Its misfit is chance, but it may be off by more than Options::adequate: too few motions to tell. It does not stand for the counts.
bool not_refuted(const FragilityFunction&);

// Annual rates by the curve are not those of the counts, by more than chance explains (small_shares.hpp), however near it is in probability.
bool rates_differ(const FragilityFunction&);

}  // namespace freestand::fragility
