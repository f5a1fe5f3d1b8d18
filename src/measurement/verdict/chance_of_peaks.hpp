// chance.hpp for tests that say their peaks alone. How far a peak strays is not known beforehand: what counts is by which share the sum S
// of the squared ln ratios falls, each in units of how such peaks scatter (fit/peak_scatter.hpp), and data are made from a model with that scatter.
#pragma once

#include "measurement/fit/peak_scatter.hpp"
#include "measurement/verdict/chance.hpp"

namespace freestand::measurement {

// How the peaks of the calibration tests scatter about a model.
PeakScatter scatter_of_peaks(const Bench&, const ModelFit&, const Jobs&);

// Does any effect help? observed: the largest share of S that a change of the peaks takes away, which an effect makes at one of many
// strengths or as it was fitted, beyond what the base's own numbers can.
Chance chance_of_gain_of_peaks(const Bench&, const ModelFit& base, const std::vector<const ModelFit*>& tried,
                               const Jobs&);

// Can the best be told from a rival? observed: by which share S of the best is below that of the rival.
Chance chance_of_lead_of_peaks(const Bench&, const ModelFit& best, const ModelFit& rival, const Jobs&);

}  // namespace freestand::measurement
