#include "decision/by_counts.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freestand::decision {
namespace {

// The mean of a curve over the intensities of a bin, spread evenly in their logarithm about their mean.
double mean_over_bin(const LognormalFragility& curve, double from, double to, double mean) {
  if (!(from > 0) || !std::isfinite(to)) return curve(mean);
  constexpr int points = 32;
  std::vector<double> im;
  for (int i = 0; i < points; ++i) im.push_back(from * std::pow(to / from, (i + 0.5) / points));
  const double shift = mean * points / std::accumulate(im.begin(), im.end(), 0.0);
  double sum = 0;
  for (const double one : im) sum += curve(one * shift) / points;
  return sum;
}

}  // namespace

fragility::LeftOut by_stratum(const std::vector<double>& left_out, const fragility::Result& result) {
  const auto border = left_out.begin() + std::min<std::ptrdiff_t>(result.left_out_records, std::ssize(left_out));
  return {{left_out.begin(), border}, {border, left_out.end()}};
}

Rate banded(double value, const std::vector<double>& left_out, const std::vector<double>& resampled,
            const fragility::Result& result) {
  fragility::Interval band = fragility::jackknife_of_positive(value, by_stratum(left_out, result), result.confidence);
  if (std::isnan(band.lower))
    band = fragility::percentile_interval(resampled, value, result.confidence, result.motions);
  return {value, band.lower, band.upper};
}

ByCounts::ByCounts(const HazardCurve& hazard, const fragility::Result& result, const fragility::EdpResult& edp,
                   std::size_t capacity, const Range& swept)
    : hazard_(hazard), result_(result), edp_(edp) {
  const std::size_t capacities = edp.capacity.size();
  for (std::size_t i = 0; i < result.im.size(); ++i) {
    const double p = edp.surface.probability[i * capacities + capacity];
    if (!std::isfinite(p) || !(result.im[i] > 0)) continue;
    at_.push_back(i * capacities + capacity);
    bin_.push_back(i);
    table_.im.push_back(result.im[i]);
    table_.probability.push_back(p);
  }
  table_.known = {swept.from, std::numeric_limits<double>::infinity()};
}

std::vector<double> ByCounts::weights(const Range& range) const {
  std::vector<double> weight = rate_weights(hazard_, table_, range);
  if (!(range.to > hazard_.last())) return weight;
  const auto next = static_cast<std::size_t>(std::upper_bound(table_.im.begin(), table_.im.end(), hazard_.last()) -
                                             table_.im.begin());
  const std::size_t low = next == 0 ? 0 : next - 1, high = std::min(next, table_.im.size() - 1);
  const double share =
      low == high ? 0 : std::log(hazard_.last() / table_.im[low]) / std::log(table_.im[high] / table_.im[low]);
  weight[low] += (1 - share) * hazard_.annual_rate.back();
  weight[high] += share * hazard_.annual_rate.back();
  return weight;
}

double ByCounts::rate(const std::vector<double>& weight) const {
  return std::inner_product(weight.begin(), weight.end(), table_.probability.begin(), 0.0);
}

Rate ByCounts::banded() {
  const std::vector<double> weight = weights();
  const std::vector<double> resampled = rates(weight, edp_.surface.resampled);
  double below = 0, above = 0;
  for (std::size_t i = 0; i < at_.size(); ++i) {
    if (!same(i)) continue;
    const fragility::Interval limits = rising_limits(i);
    below += std::pow(weight[i] * (table_.probability[i] - limits.lower), 2);
    above += std::pow(weight[i] * (limits.upper - table_.probability[i]), 2);
  }
  Rate found = decision::banded(rate(weight), rates(weight, edp_.surface.left_out), resampled, result_);
  if (std::isnan(found.lower)) return found;
  found.lower = std::max(0.0, found.lower - std::sqrt(below));
  found.upper = std::min(hazard_.annual_rate.front(), found.upper + std::sqrt(above));
  return found;
}

std::vector<double> ByCounts::rates_left_out() const { return rates(weights(), edp_.surface.left_out); }

double ByCounts::rate_of(const LognormalFragility& curve) const {
  const std::vector<double> weight = weights();
  double sum = 0;
  for (std::size_t i = 0; i < bin_.size(); ++i) {
    const std::size_t b = bin_[i];
    const bool by_law = !edp_.binary && edp_.bins[b].status == fragility::BinStatus::fitted;
    sum += weight[i] * (by_law ? curve(table_.im[i])
                               : mean_over_bin(curve, result_.im_edge[b], result_.im_edge[b + 1], table_.im[i]));
  }
  return sum;
}

double ByCounts::rate_below(const HazardCurve& hazard, const Range& range) const {
  const double p = table_.probability.front();
  if (!(p > 0) || !(range.from < range.to)) return 0;
  const auto larger =
      std::find_if(table_.probability.begin(), table_.probability.end(), [p](double other) { return other > p; });
  if (larger == table_.probability.end())
    return p * (hazard.rate(std::max(range.from, hazard.first())) - hazard.rate(range.to));
  // A share of 1 is that of all samples of the bin: half a sample less.
  const auto next = static_cast<std::size_t>(larger - table_.probability.begin());
  const double n = static_cast<double>(std::max<std::int64_t>(edp_.bins[bin_[next]].n, 1));
  const double low = gsl_cdf_ugaussian_Pinv(p), high = gsl_cdf_ugaussian_Pinv(std::min(*larger, 1 - 0.5 / n));
  if (!(high > low)) return p * (hazard.rate(std::max(range.from, hazard.first())) - hazard.rate(range.to));
  const double dispersion = std::log(table_.im[next] / table_.im[0]) / (high - low);
  return annual_rate(hazard, {table_.im[0] * std::exp(-low * dispersion), dispersion}, range);
}

// Of a row in which nothing was counted: its upper limit, or that of a row at a higher intensity where it is less. Of one in which all
// was counted the lower limit alike.
fragility::Interval ByCounts::rising_limits(std::size_t i) {
  const double own_lower = edp_.surface.lower[at_[i]], own_upper = edp_.surface.upper[at_[i]];
  fragility::Interval limits{own_lower, own_upper};
  if (table_.probability[i] == 0)
    for (std::size_t j = i; j < at_.size(); ++j) limits.upper = std::min(limits.upper, edp_.surface.upper[at_[j]]);
  if (table_.probability[i] == 1)
    for (std::size_t j = 0; j <= i; ++j) limits.lower = std::max(limits.lower, edp_.surface.lower[at_[j]]);
  bounded_by_others_ = bounded_by_others_ || limits.lower > own_lower || limits.upper < own_upper;
  return limits;
}

// Of each resample, or of each group left out: `again` is [of them, im, capacity].
std::vector<double> ByCounts::rates(const std::vector<double>& weight, const std::vector<double>& again) const {
  const std::size_t size = edp_.surface.probability.size();
  std::vector<double> found(size == 0 ? 0 : again.size() / size, 0);
  for (std::size_t r = 0; r < found.size(); ++r)
    for (std::size_t i = 0; i < at_.size(); ++i) found[r] += weight[i] * again[r * size + at_[i]];
  return found;
}

bool ByCounts::same(std::size_t i) const {
  const std::size_t size = edp_.surface.probability.size();
  for (std::size_t at = at_[i]; at < edp_.surface.resampled.size(); at += size)
    if (edp_.surface.resampled[at] != table_.probability[i]) return false;
  return true;
}

}  // namespace freestand::decision
