#include "fragility/variance_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freestand::fragility {
namespace {

// k4/k2^2 of unbiased cumulants (R. A. Fisher, Proc. London Math. Soc. 30, 1930); 0 of fewer than four, or where all are alike.
// The plain moments' m4/m2^2 - 3 of normal numbers is -6/(n + 1) on average, and of others too small by (n - 2)(n - 3)/(n^2 - 1) besides.
double excess_kurtosis(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double second = 0, fourth = 0;
  for (const double value : values) {
    second += std::pow(value - mean, 2) / n;
    fourth += std::pow(value - mean, 4) / n;
  }
  if (n < 4 || !(second > 0)) return 0;
  return (n - 1) / ((n - 2) * (n - 3)) * ((n + 1) * (fourth / (second * second) - 3) + 6);
}

}  // namespace

void VarianceSum::add(double variance, const std::vector<double>& values) {
  const double groups = static_cast<double>(values.size());
  variance_ += variance;
  of_it_ += variance * variance * (2 / (groups - 1) + std::max(0.0, excess_kurtosis(values)) / groups);
}

}  // namespace freestand::fragility
