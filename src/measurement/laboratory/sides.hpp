// Slips that remain, told with their sign turned round. Of histories timing.hpp and quality.hpp see it; of peaks only the side on which each
// test ends is there.
#pragma once

#include <string>

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

// Does the base, refitted to the peaks with all their signs turned round, miss them by less than whatever else was fitted to them as they stand
// (least_score), and do tests end on its side then more often than they do by chance? A floor that tilts turns sides, too, but not
// each into the other one: it explains the peaks itself, or the base would not meet them turned round. Empty: no, or these are no peaks with sides.
std::string sides_turned_round(const Bench&, const ModelFit& base, double least_score, const Effort&, const Jobs&);

}  // namespace freestand::measurement
