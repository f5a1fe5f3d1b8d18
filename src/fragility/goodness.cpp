#include "fragility/goodness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "base/random.hpp"
#include "base/units.hpp"
#include "fragility/intervals.hpp"

namespace freestand::fragility {
namespace {

constexpr std::array grid{5, 6, 7, 8, 10, 12, 15, 20, 27, 40, 60, 100, 200};
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

// n standard normal numbers of one repeat (Box & Muller).
void draw_normals(std::vector<double>& z, std::uint64_t seed, std::uint64_t repeat) {
  const std::size_t pairs = (z.size() + 1) / 2;
  const std::uint64_t stream = random::stable_hash("fragility/estimated_null") + z.size();
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto [first, second] = random::bits(seed, repeat * pairs + i, stream);
    const double radius = std::sqrt(-2 * std::log(random::unit_interval(first)));
    const double angle = 2 * pi * random::unit_interval(second);
    z[2 * i] = radius * std::cos(angle);
    if (2 * i + 1 < z.size()) z[2 * i + 1] = radius * std::sin(angle);
  }
}

// z -> F(z; mean and deviation estimated from z), increasing.
void estimate_and_transform(std::vector<double>& z) {
  std::sort(z.begin(), z.end());
  const double n = static_cast<double>(z.size());
  double mean = 0, squares = 0;
  for (const double x : z) mean += x / n;
  for (const double x : z) squares += (x - mean) * (x - mean);
  const double scale = 1 / std::sqrt(2 * squares / n);
  for (double& x : z) x = 0.5 * std::erfc(-(x - mean) * scale);
}

double tail(const std::vector<double>& sorted, double value) {
  const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
  return (1 + static_cast<double>(above)) / (1 + static_cast<double>(sorted.size()));
}

// value(grid n) at n: itself on the grid and beyond its end, else interpolated in 1/sqrt(n).
double on_grid(double n, const std::function<double(int)>& value) {
  if (!(n >= grid.front())) return nan;
  const auto above = std::lower_bound(grid.begin(), grid.end(), n);
  if (above == grid.end()) return value(grid.back());
  if (*above == n) return value(*above);
  const int high = *above, low = *(above - 1);
  const double weight = (1 / std::sqrt(n) - 1 / std::sqrt(high)) / (1 / std::sqrt(low) - 1 / std::sqrt(high));
  return weight * value(low) + (1 - weight) * value(high);
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

const EstimatedNull::Sorted& EstimatedNull::at(int n) {
  const auto [entry, is_new] = by_n_.try_emplace(n);
  Sorted& sorted = entry->second;
  if (!is_new) return sorted;
  std::vector<double> z(static_cast<std::size_t>(n));
  for (int repeat = 0; repeat < repeats_; ++repeat) {
    draw_normals(z, seed_, static_cast<std::uint64_t>(repeat));
    estimate_and_transform(z);
    sorted.ks.push_back(ks_scale(n) * ks_statistic(z));
    sorted.ad.push_back(ad_scale(n) * ad_statistic(z));
  }
  std::sort(sorted.ks.begin(), sorted.ks.end());
  std::sort(sorted.ad.begin(), sorted.ad.end());
  return sorted;
}

double EstimatedNull::ks_p(double s, double n) {
  return on_grid(n, [&](int m) { return tail(at(m).ks, ks_scale(n) * s); });
}

double EstimatedNull::ad_p(double a2, double n) {
  return on_grid(n, [&](int m) { return tail(at(m).ad, ad_scale(n) * a2); });
}

double EstimatedNull::ks_critical(double level, double n) {
  return on_grid(n, [&](int m) { return sorted_quantile(at(m).ks, 1 - level) / ks_scale(n); });
}

}  // namespace freestand::fragility
