#include "measurement/fit/odd_one.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "measurement/levels.hpp"

namespace freestand::measurement {

std::optional<OddOne> odd_one(const std::vector<double>& numbers) {
  const auto n = static_cast<double>(numbers.size());
  if (n < 3) return {};
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0), mean = sum / n;
  double squares = 0;
  for (const double one : numbers) squares += std::pow(one - mean, 2);
  const auto furthest = std::ranges::max_element(numbers, {}, [&](double one) { return std::abs(one - mean); });
  const double square = std::pow(*furthest - mean, 2);
  const double g2 = square * (n - 1) / squares;  // in squared standard deviations
  const double left = std::pow(n - 1, 2) - n * g2;
  const double p = left > 0 ? std::min(1.0, 2 * n * gsl_cdf_tdist_Q(std::sqrt(n * (n - 2) * g2 / left), n - 2)) : 0;
  if (!(squares > 0) || p > chance_level) return {};
  return OddOne{.which = static_cast<std::size_t>(furthest - numbers.begin()),
                .off = *furthest - (sum - *furthest) / (n - 1),
                .scatter_of_others = std::sqrt(std::max(0.0, squares - square * n / (n - 1)) / (n - 2)),
                .p = p};
}

}  // namespace freestand::measurement
