// Does friction differ from test to test? The model with a factor on its friction for each calibration test by itself.
#pragma once

#include "measurement/judge.hpp"

namespace freestand::measurement {

struct OwnFriction {
  std::vector<double> factors;  // of each calibration test
  double scatter = 0;           // standard deviation of their logarithms
  double misfit = 0;            // G with them, summed over the tests
};

OwnFriction own_friction(const Bench&, const Judge&, const ModelFit&, const Jobs&);

}  // namespace freestand::measurement
