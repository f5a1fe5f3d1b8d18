// From a tally to everything that is reported: fits per bin, goodness of fit, surfaces with bands, overturning curve.
#pragma once

#include "base/jobs.hpp"
#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// A pure function of the tally and its options (seed, resamples ...): the same bits every time. jobs: demands and curves are fitted by whoever they are given to.
Result fit(const Tally& tally, const Jobs& jobs = run_here);

}  // namespace freestand::fragility
