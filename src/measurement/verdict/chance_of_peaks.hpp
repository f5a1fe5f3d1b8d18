// chance.hpp for tests that say their peaks alone. How far a peak strays is not known beforehand: what counts is by which share the
// sum S of the squared ln ratios falls, and data are made from a model with its own scatter, the peaks of one test astray
// together as far as those that were measured are. Peaks that are 0 in both, or of what fell in both, stray in no data.
#pragma once

#include "measurement/verdict/chance.hpp"

namespace freestand::measurement {

// Does any effect help? observed: the largest share of S that a change of the peaks takes away, which an effect makes at one of many
// strengths or as it was fitted, beyond what the base's own numbers can.
Chance chance_of_gain_of_peaks(const Bench&, const ModelFit& base, const std::vector<const ModelFit*>& tried,
                               const Jobs&);

// Can the best be told from a rival? observed: by which share S of the best is below that of the rival.
Chance chance_of_lead_of_peaks(const Bench&, const ModelFit& best, const ModelFit& rival, const Jobs&);

}  // namespace freestand::measurement
