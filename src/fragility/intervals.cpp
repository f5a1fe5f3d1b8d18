#include "fragility/intervals.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace freestand::fragility {
namespace {

// From so many hits and misses on the limits of the score interval are those of the exact one to 1e-3 of its width
// (tests/fragility/intervals_test.cpp), and take no bisection.
constexpr double many = 100000;

// By bisection: the distribution function of GSL converges wherever it is asked here, its inverse does not.
double beta_quantile(double p, double a, double b) {
  double low = 0, high = 1;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = (low + high) / 2;
    (gsl_cdf_beta_P(middle, a, b) < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Wilson's score limit at a count that was corrected for continuity.
double score_limit(double k, double n, double side, double tail) {
  const double z = gsl_cdf_ugaussian_Qinv(tail), p = k / n;
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return (p + z * z / (2 * n) + side * half) / (1 + z * z / n);
}

}  // namespace

Interval exact_interval(double k, double n, double confidence) {
  if (!(n > 0)) return {0, 1};
  const double tail = (1 - confidence) / 2;
  if (std::min(k, n - k) > many) return {score_limit(k - 0.5, n, -1, tail), score_limit(k + 0.5, n, +1, tail)};
  return {k <= 0 ? 0 : beta_quantile(tail, k, n - k + 1), k >= n ? 1 : beta_quantile(1 - tail, k + 1, n - k)};
}

Interval clopper_pearson(std::int64_t hits, std::int64_t trials, double confidence) {
  return exact_interval(static_cast<double>(hits), static_cast<double>(trials), confidence);
}

double standard_deviation(const std::vector<double>& values) {
  double count = 0, sum = 0, squares = 0;
  for (const double v : values)
    if (std::isfinite(v)) {
      ++count;
      sum += v;
    }
  if (count < 2) return std::numeric_limits<double>::quiet_NaN();
  for (const double v : values)
    if (std::isfinite(v)) squares += (v - sum / count) * (v - sum / count);
  return std::sqrt(squares / (count - 1));
}

double sorted_quantile(const std::vector<double>& sorted, double p) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double position = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

PercentileLimits::PercentileLimits(std::vector<double> values, double estimate, int groups)
    : values_(std::move(values)) {
  std::erase_if(values_, [](double value) { return !std::isfinite(value); });
  if (values_.size() < 2 || groups < 2 || std::isnan(estimate)) return;
  groups_ = groups;
  std::sort(values_.begin(), values_.end());
  const double n = static_cast<double>(values_.size());
  const auto [first, last] = std::equal_range(values_.begin(), values_.end(), estimate);
  const double below = static_cast<double>((first - values_.begin()) + (last - values_.begin())) / (2 * n);
  bias_ = gsl_cdf_ugaussian_Pinv(std::clamp(below, 0.5 / n, 1 - 0.5 / n));
}

double PercentileLimits::reach(double tail) const {
  return std::sqrt(groups_ / (groups_ - 1)) * gsl_cdf_tdist_Qinv(tail, groups_ - 1);
}

double PercentileLimits::at(double z) const { return sorted_quantile(values_, gsl_cdf_ugaussian_P(2 * bias_ + z)); }

Interval percentile_interval(std::vector<double> values, double estimate, double confidence, int groups) {
  const PercentileLimits limits(std::move(values), estimate, groups);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!limits.known()) return {nan, nan};
  const double tail = (1 - confidence) / 2;
  return {limits.lower(tail), limits.upper(tail)};
}

std::vector<bool> benjamini_hochberg(const std::vector<double>& p, double level) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isnan(p[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::size_t rejected = 0;
  for (std::size_t rank = 1; rank <= order.size(); ++rank)
    if (p[order[rank - 1]] <= level * static_cast<double>(rank) / static_cast<double>(order.size())) rejected = rank;
  std::vector<bool> result(p.size(), false);
  for (std::size_t rank = 0; rank < rejected; ++rank) result[order[rank]] = true;
  return result;
}

}  // namespace freestand::fragility
