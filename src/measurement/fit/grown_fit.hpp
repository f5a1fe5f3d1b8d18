// Fits of whole models to the calibration tests, complete: settled (least_squares.hpp), with tests left out and intervals. A model with
// effects grows by one after the other, since its error has many valleys: each starts where the model without it stood, its own numbers
// all over their range.
#pragma once

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

// From nothing.
ModelFit grown_fit(const Bench&, const ModelSpec&, const Jobs&);

// From numbers that are known.
ModelFit fit_from(const Bench&, const ModelSpec&, const Values& known, const Jobs&);

// With one more effect, its numbers behind those of `before`.
ModelFit fit_with_effect(const Bench&, const ModelFit& before, const ModelSpec& after, const Jobs&);

}  // namespace freestand::measurement
