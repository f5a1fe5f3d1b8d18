// Where a block may well come: places at which the formulas of a study are looked at before the first sample.
#pragma once

#include <vector>

#include "formula/formula.hpp"

namespace freestand::study {

using Place = formula::Inputs;
enum Coordinate : std::size_t { u, v, theta, omega, t, path, normal, side, sigma, speed, rest };

inline std::vector<Place> places() {
  std::vector<Place> all;
  for (const double at_u : {0.0, 0.1, -0.1, 0.3, -0.3, 1.0, -1.0})
    for (const double at_v : {0.0, 0.2, -0.2, 2.0, -2.0})
      for (const double at_theta : {0.0, 0.1, -0.1})
        for (const double at_t : {0.0, 20.0})
          for (const double slid : {0.0, 1.0})
            all.push_back({at_u, at_v, at_theta, 0, at_t, slid, 1, 0, 0, 0, at_v == 0 ? at_t : 0});
  return all;
}

}  // namespace freestand::study
