// Medians of measured values, and how far they can be trusted when values come in groups.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace freestand::test {

// Linear between the sorted values; part in [0, 1].
inline double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  const double at = part * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }

struct Interval {
  double low, high;
};

// 95 % interval of the median when whole groups are drawn again: values of one group are not independent. group[i] is
// that of values[i].
inline Interval interval_of_median(const std::vector<double>& values, const std::vector<int>& group) {
  constexpr int draws = 1000;
  const int last = *std::max_element(group.begin(), group.end());
  std::vector<std::vector<double>> of_group(static_cast<std::size_t>(last) + 1);
  for (std::size_t i = 0; i < values.size(); ++i) of_group[static_cast<std::size_t>(group[i])].push_back(values[i]);
  std::erase_if(of_group, [](const auto& one) { return one.empty(); });
  std::vector<double> medians;
  unsigned long long state = 20170601;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<double> sample;
    for (std::size_t i = 0; i < of_group.size(); ++i) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      const auto& one = of_group[(state >> 33) % of_group.size()];
      sample.insert(sample.end(), one.begin(), one.end());
    }
    medians.push_back(median(sample));
  }
  return {quantile(medians, 0.025), quantile(medians, 0.975)};
}

}  // namespace freestand::test
