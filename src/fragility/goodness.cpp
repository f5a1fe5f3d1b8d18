#include "fragility/goodness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "fragility/estimated_null_table.hpp"

namespace freestand::fragility {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double kolmogorov_series(double x) {
  if (x < 0.2) return 1;
  double sum = 0, sign = 1;
  for (int k = 1; k <= 100; ++k, sign = -sign) {
    const double term = std::exp(-2.0 * k * k * x * x);
    sum += sign * term;
    if (term < 1e-17) break;
  }
  return std::clamp(2 * sum, 0.0, 1.0);
}

double textbook_scale(double n) { return std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n); }
double ks_scale(double n) { return std::sqrt(n) - 0.01 + 0.85 / std::sqrt(n); }
double ad_scale(double n) { return 1 + 0.75 / n + 2.25 / (n * n); }

using estimated_null::chances;
using estimated_null::sizes;
using Row = std::array<double, chances.size()>;

double logit(double p) { return std::log(p / (1 - p)); }

// The probability to exceed a value and the value that is exceeded with a probability: straight lines between the tabulated ones, in the
// logarithm of the value and the logit of the probability, in which the table hardly bends.
double chance_above(const Row& quantiles, double value) {
  const auto above = std::lower_bound(quantiles.begin(), quantiles.end(), value);
  if (above == quantiles.begin()) return chances.front();
  if (above == quantiles.end()) return chances.back();
  const auto i = static_cast<std::size_t>(above - quantiles.begin());
  const double share = std::log(value / quantiles[i - 1]) / std::log(quantiles[i] / quantiles[i - 1]);
  return 1 / (1 + std::exp(-std::lerp(logit(chances[i - 1]), logit(chances[i]), share)));
}

double quantile_above(const Row& quantiles, double chance) {
  const auto i = static_cast<std::size_t>(
      std::lower_bound(chances.begin() + 1, chances.end() - 1, chance, std::greater<>{}) - chances.begin());
  const double share = (logit(chance) - logit(chances[i - 1])) / (logit(chances[i]) - logit(chances[i - 1]));
  return std::exp(std::lerp(std::log(quantiles[i - 1]), std::log(quantiles[i]), share));
}

// What the tables say of n: for a tabulated one and beyond the last of them their own row, else interpolated in 1/sqrt(n).
template <class Value>
double at_size(const estimated_null::Quantiles& table, double n, const Value& value) {
  if (!(n >= sizes.front())) return nan;
  const auto next = static_cast<std::size_t>(std::lower_bound(sizes.begin(), sizes.end(), n) - sizes.begin());
  if (next == sizes.size()) return value(table.back());
  if (sizes[next] == n) return value(table[next]);
  const double high = 1 / std::sqrt(sizes[next]), low = 1 / std::sqrt(sizes[next - 1]);
  return std::lerp(value(table[next]), value(table[next - 1]), (1 / std::sqrt(n) - high) / (low - high));
}

}  // namespace

double ks_statistic(std::span<const double> sorted_u) {
  const double n = static_cast<double>(sorted_u.size());
  double largest = 0;
  for (std::size_t i = 0; i < sorted_u.size(); ++i) {
    const double below = static_cast<double>(i) / n, above = static_cast<double>(i + 1) / n;
    largest = std::max({largest, above - sorted_u[i], sorted_u[i] - below});
  }
  return largest;
}

double ad_statistic(std::span<const double> sorted_u) {
  const double n = static_cast<double>(sorted_u.size());
  constexpr double least = std::numeric_limits<double>::min();
  double sum = 0;
  for (std::size_t i = 0; i < sorted_u.size(); ++i) {
    const double k = static_cast<double>(i), u = sorted_u[i];
    sum += (2 * k + 1) * std::log(std::max(u, least)) + (2 * (n - k) - 1) * std::log(std::max(1 - u, 1e-17));
  }
  return -n - sum / n;
}

double kolmogorov_p(double s, double n) { return kolmogorov_series(textbook_scale(n) * s); }

double kolmogorov_critical(double level, double n) {
  double low = 0.2, high = 5;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (kolmogorov_series(middle) > level ? low : high) = middle;
  }
  return high / textbook_scale(n);
}

double estimated_ks_p(double s, double n) {
  return at_size(estimated_null::ks, n, [&](const Row& row) { return chance_above(row, ks_scale(n) * s); });
}

double estimated_ad_p(double a2, double n) {
  return at_size(estimated_null::ad, n, [&](const Row& row) { return chance_above(row, ad_scale(n) * a2); });
}

double estimated_ks_critical(double level, double n) {
  return at_size(estimated_null::ks, n, [&](const Row& row) { return quantile_above(row, level) / ks_scale(n); });
}

}  // namespace freestand::fragility
