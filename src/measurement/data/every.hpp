// Each so many of a series of values, the first one included.
#pragma once

#include <cstddef>
#include <vector>

namespace freestand::measurement {

inline std::vector<double> every(int so_many, const std::vector<double>& values) {
  std::vector<double> some;
  for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(so_many)) some.push_back(values[i]);
  return some;
}

}  // namespace freestand::measurement
