// A channel at instants between its samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace freestand::study {

// Linear between the samples.
inline std::vector<double> at_times(const std::vector<double>& time, const std::vector<double>& values, double start,
                                    double step, std::size_t count) {
  std::vector<double> out;
  std::size_t k = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = start + step * static_cast<double>(i);
    while (k + 1 < time.size() && time[k] < t) ++k;
    const double share = std::clamp((t - time[k - 1]) / (time[k] - time[k - 1]), 0.0, 1.0);
    out.push_back(values[k - 1] + share * (values[k] - values[k - 1]));
  }
  return out;
}

}  // namespace freestand::study
