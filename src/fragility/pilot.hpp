// The slopes of ln EDP over ln IM within each bin, from the first samples.
#pragma once

#include "fragility/tally.hpp"

namespace freestand::fragility {

// Options::pilot_slope and pilot_im from a tally of the first samples, counted without slopes: those of the bin where at
// least minimum_samples of them moved, else the slope over all of them. Goodness of fit is judged on demands less this
// line, so that one pass over the samples is enough; lambda and omega go by the line of all samples.
Options with_pilot(const Tally& first);

}  // namespace freestand::fragility
