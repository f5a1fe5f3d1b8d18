// The floor motion, of those that were run, that would tell models apart of which only outcomes are known.
#pragma once

#include <string>
#include <vector>

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

struct OutcomeSuggestion {
  std::string test;                      // whose motion
  double scale = 1;                      // on it; negative: turned round
  std::vector<double> probability = {};  // of overturning, of each model
  int repeats = 0;                       // that part the two nearest by two standard errors
  std::string sentence = {};
};

// models: as fitted, two and more; names: of them, for the sentence. The motions of the calibration tests of which the
// first model is least sure are tried, both ways round and at several strengths.
OutcomeSuggestion suggest_outcomes(const Bench&, const std::vector<ModelFit>& models,
                                   const std::vector<std::string>& names, const Jobs&);

}  // namespace freestand::measurement
