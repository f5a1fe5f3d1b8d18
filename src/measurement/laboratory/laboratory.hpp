// What may be wrong in the laboratory instead of in the model: the base with one more number, the factor by which a dimension
// or a gain differs from what is stated or the time by which the responses are stamped late against the floor's, within three
// of its standard deviations (Dataset::tolerance). Such a model is judged beside those with an effect, so that no effect is
// named for a fault of the laboratory.
#pragma once

#include "measurement/fit/model_fit.hpp"
#include "measurement/fit/stated_numbers.hpp"

namespace freestand::measurement {

struct LaboratoryFault {
  std::string name;  // of the candidate
  ModelSpec model;
};

// Those that change what the base with x predicts of the calibration tests.
std::vector<LaboratoryFault> laboratory_faults(const Bench&, const ModelSpec& base, const Values& x);

}  // namespace freestand::measurement
