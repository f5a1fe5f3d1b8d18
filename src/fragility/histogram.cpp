#include "fragility/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/units.hpp"

namespace freestand::fragility {

int ln_cell(double ln_value) {
  const double cell = std::floor(ln_value / ln_cell_width) - ln_lowest / ln_cell_width + 1;
  return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(ln_cell_count - 1)));
}

double ln_cell_edge(int cell) { return ln_lowest + (cell - 1) * ln_cell_width; }

namespace {

// Sum over k = 0 ... count - 1 of (2 (first + k) + 1) ln u(t), t = (k + 1/2)/count: term by term, or, of many, as the
// integral of 2 (first + count t) ln u(t) by Gauss's three points.
template <class Probability>
double weighted_logs(double first, double count, const Probability& u) {
  const auto term = [&](double t) {
    return 2 * (first + count * t) * std::log(std::max(u(t), std::numeric_limits<double>::min()));
  };
  constexpr int many = 8;  // the sum of so many midpoints is the integral but for a 24 * 64th of u's bend within a cell
  double sum = 0;
  if (count <= many) {
    for (int k = 0; k < static_cast<int>(count); ++k) sum += term((k + 0.5) / count);
    return sum;
  }
  const double off = 0.5 * std::sqrt(0.6);
  return count * (5 * term(0.5 - off) + 8 * term(0.5) + 5 * term(0.5 + off)) / 18;
}

}  // namespace

HistogramGoodness histogram_goodness(std::span<const std::int64_t> count, double lambda, double omega,
                                     const std::vector<Cut>& cuts) {
  const double scale = 1 / (omega * std::sqrt(2.0));
  const auto normal = [&](double x) { return 0.5 * std::erfc(-(x - lambda) * scale); };
  struct Part {
    double share, below;
  };
  std::vector<Part> parts;
  double all = 0, lowest = std::numeric_limits<double>::infinity();
  for (const Cut& cut : cuts) all += cut.weight;
  for (const Cut& cut : cuts) {
    parts.push_back({cut.weight / all, normal(cut.ln_threshold)});
    if (cut.weight > 0) lowest = std::min(lowest, cut.ln_threshold);
  }
  if (parts.empty()) parts.push_back({1, 0}), lowest = -lowest;
  const auto cdf = [&](double x) {
    const double p = normal(x);
    double sum = 0;
    for (const Part& part : parts)
      if (p > part.below) sum += part.share * (p - part.below) / (1 - part.below);
    return sum;
  };
  const double n = static_cast<double>(std::accumulate(count.begin(), count.end(), std::int64_t{0}));
  double before = 0, ks = 0, logs = 0;
  for (int cell = 0; cell < ln_cell_count; ++cell) {
    const double here = static_cast<double>(count[static_cast<std::size_t>(cell)]);
    if (here == 0) continue;
    const double left = std::max(ln_cell_edge(cell), lowest), width = ln_cell_edge(cell) + ln_cell_width - left;
    // Steps and the distribution function are both straight within a cell: they part most at its first or last sample.
    const double first = cdf(left + 0.5 / here * width), last = cdf(left + (here - 0.5) / here * width);
    ks = std::max(
        {ks, first - before / n, (before + 1) / n - first, last - (before + here - 1) / n, (before + here) / n - last});
    const auto place = [&](double t) { return cdf(left + t * width); };
    logs += weighted_logs(before, here, place) +
            weighted_logs(n - before - here, here, [&](double t) { return 1 - place(1 - t); });
    before += here;
  }
  const double outside = static_cast<double>(count.front() + count.back()) / n;
  const double bent = ln_cell_width * ln_cell_width / (8 * omega * omega * std::sqrt(2 * pi * std::exp(1.0)));
  return {ks, -n - logs / n, bent + outside};
}

}  // namespace freestand::fragility
