// What may be wrong in the laboratory instead of in the model: the base with one more number, the factor by which a dimension
// or a gain differs from what is stated or the time by which the responses are stamped late against the floor's, within three
// of its standard deviations (Dataset::tolerance). Such a model is judged beside those with an effect, so that no effect is
// named for a fault of the laboratory.
#pragma once

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

struct LaboratoryFault {
  std::string name;  // of the candidate
  ModelSpec model;
};

inline constexpr const char *width_fault = "width_as_stated", *centre_fault = "centre_height_as_stated",
                            *gain_fault = "floor_gain_as_stated", *clock_fault = "clock_as_stated";
bool is_laboratory_fault(const std::string& name);
// "the width is 1.9 % smaller than stated". number: the factor, or the time [s].
std::string fault_sentence(const std::string& name, double number);
// "the responses are stamped 0.012 s late against the floor's channel".
std::string clock_sentence(const std::string& whose, double late_s);

// Those that change what the base with x predicts of the calibration tests.
std::vector<LaboratoryFault> laboratory_faults(const Bench&, const ModelSpec& base, const Values& x);

// What a laboratory states with a tolerance, and a model takes as stated; as a free number, within three standard deviations.
struct StatedNumber {
  const char* name;  // of the fault
  Number ModelSpec::*number;
  double deviation;
  const char* unit = "1";
};
std::vector<StatedNumber> stated_numbers(const Tolerance&, const ModelSpec&);
void let_free(ModelSpec&, const StatedNumber&);

}  // namespace freestand::measurement
