// The model that tests of fits and verdicts begin with.
#pragma once

#include "measurement/predict/model.hpp"

namespace freestand::test {

// Friction is free within [0.03, 1.2].
inline measurement::ModelSpec free_friction() {
  measurement::ModelSpec model;
  model.mu_k.free = 0;
  model.free = {
      {.name = "friction.mu", .unit = "1", .lower = 0.03, .upper = 1.2, .low = 0.03, .high = 1.2, .logarithmic = true}};
  return model;
}

}  // namespace freestand::test
