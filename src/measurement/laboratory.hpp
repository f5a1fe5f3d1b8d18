// What may be wrong in the laboratory instead of in the model: the base with one more number, near 1, that says by how much
// a dimension or a gain differs from what is stated, within three of its standard deviations (Dataset::tolerance). Such a
// model is judged beside those with an effect, so that no effect is named for a fault of the laboratory.
#pragma once

#include "measurement/model_fit.hpp"

namespace freestand::measurement {

struct LaboratoryFault {
  std::string name;  // of the candidate
  ModelSpec model;
};

inline constexpr const char *width_fault = "width_as_stated", *centre_fault = "centre_height_as_stated",
                            *gain_fault = "floor_gain_as_stated";
bool is_laboratory_fault(const std::string& name);
// "the width is 1.9 % smaller than stated".
std::string fault_sentence(const std::string& name, double factor);

// Those that change what the base with x predicts of the calibration tests.
std::vector<LaboratoryFault> laboratory_faults(const Bench&, const ModelSpec& base, const Values& x);

}  // namespace freestand::measurement
