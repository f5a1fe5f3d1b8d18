// Fits that have not seen some of the tests: searched for anew by the others alone. Ranges and landmarks are those that
// the tests seen reach, starts are fits of other models that have not seen the rest either, screening and descents know
// of no other test. So what is predicted for a test left out would be the same whatever had been measured in it.
//
// But where that search ends more than one percent of the error above what the tests seen find at the fit to all, it has
// stuck, which says nothing of the model: there it goes down from that fit, by the tests seen alone.
#pragma once

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

// base: the model that the fits have grown from. Fills fold_x, left_out, intervals.
void search_left_out(const Bench&, const ModelSpec& base, std::vector<ModelFit*>, const Effort&, const Jobs&);

// The same without the search: down from the fit to all, by the tests seen alone.
void descend_left_out(const Bench&, std::vector<ModelFit*>, const Effort&, const Jobs&);

}  // namespace freestand::measurement
