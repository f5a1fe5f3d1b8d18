// From a tally to everything that is reported: fits per bin, goodness of fit, surfaces with bands, overturning curve.
#pragma once

#include "base/jobs.hpp"
#include "fragility/goodness.hpp"
#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// A pure function of the tally and its options (seed, resamples ...): the same bits every time. `null` only saves the
// time of simulating the same test statistics again when fits are repeated; it must carry the seed of the options to
// give the same. jobs: demands and curves are fitted by whoever they are given to.
Result fit(const Tally& tally, const Jobs& jobs = run_here);
Result fit(const Tally& tally, EstimatedNull& null, const Jobs& jobs = run_here);

}  // namespace freestand::fragility
