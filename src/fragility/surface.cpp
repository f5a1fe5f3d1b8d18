#include "fragility/surface.hpp"

#include <algorithm>
#include <cmath>

#include "fragility/intervals.hpp"
#include "fragility/lognormal.hpp"

namespace freestand::fragility {
namespace {

enum Quantity : Eigen::Index { n, still, over, moved, sum_ln, sum_ln2, first_exceeding };

// [group, quantity]
Eigen::MatrixXd by_group(const Tally& tally, std::size_t edp, std::size_t bin) {
  const std::size_t groups = tally.layout().groups, capacities = tally.layout().capacity_count[edp];
  Eigen::MatrixXd table(static_cast<Eigen::Index>(groups), first_exceeding + static_cast<Eigen::Index>(capacities));
  for (std::size_t g = 0; g < groups; ++g) {
    const Counts c = tally.counts(edp, bin, g);
    const auto row = static_cast<Eigen::Index>(g);
    table(row, n) = static_cast<double>(c.n);
    table(row, still) = static_cast<double>(c.still);
    table(row, over) = static_cast<double>(c.over);
    table(row, moved) = static_cast<double>(c.moved);
    table(row, sum_ln) = c.sum_ln;
    table(row, sum_ln2) = c.sum_ln2;
    for (std::size_t k = 0; k < capacities; ++k)
      table(row, first_exceeding + static_cast<Eigen::Index>(k)) = static_cast<double>(tally.exceeding(edp, bin, g, k));
  }
  return table;
}

double standard_deviation(const std::vector<double>& values) {
  double count = 0, sum = 0, squares = 0;
  for (const double v : values)
    if (std::isfinite(v)) {
      ++count;
      sum += v;
    }
  if (count < 2) return unknown;
  for (const double v : values)
    if (std::isfinite(v)) squares += (v - sum / count) * (v - sum / count);
  return std::sqrt(squares / (count - 1));
}

// One row of a surface.
struct Point {
  double probability = unknown, lower = unknown, upper = unknown;
};

Point empirical_point(const Eigen::MatrixXd& totals, Eigen::Index column, std::int64_t hits, const BinFit& bin,
                      double confidence) {
  const double p = static_cast<double>(hits) / static_cast<double>(bin.n);
  std::vector<double> values;
  for (Eigen::Index r = 0; r < totals.rows(); ++r) values.push_back(totals(r, column) / totals(r, n));
  const Interval band = percentile_interval(values, p, confidence, bin.motions);
  const Interval exact = clopper_pearson(hits, bin.n, confidence);
  if (std::isnan(band.lower)) return {p, unknown, unknown};
  return {p, std::min(band.lower, exact.lower), std::max(band.upper, exact.upper)};
}

struct Parts {
  std::vector<double> p_over, p_still, lambda, omega;  // [resample]
};

Parts resampled_parts(const Eigen::MatrixXd& totals) {
  Parts parts;
  for (Eigen::Index r = 0; r < totals.rows(); ++r) {
    const double stood = totals(r, n) - totals(r, over);
    const LognormalFit fit = fit_lognormal(totals(r, moved), totals(r, sum_ln), totals(r, sum_ln2));
    const bool usable = fit.omega > 0;
    parts.p_over.push_back(totals(r, over) / totals(r, n));
    parts.p_still.push_back(stood > 0 ? totals(r, still) / stood : 0);
    parts.lambda.push_back(usable ? fit.lambda : unknown);
    parts.omega.push_back(usable ? fit.omega : unknown);
  }
  return parts;
}

Point fitted_point(const Parts& parts, const BinFit& bin, double capacity, double confidence) {
  Point point;
  point.probability = three_part_exceedance(bin.p_over, bin.p_still, bin.lambda, bin.omega, capacity);
  std::vector<double> values;
  for (std::size_t r = 0; r < parts.lambda.size(); ++r)
    values.push_back(
        three_part_exceedance(parts.p_over[r], parts.p_still[r], parts.lambda[r], parts.omega[r], capacity));
  const Interval band = percentile_interval(values, point.probability, confidence, bin.motions);
  point.lower = band.lower;
  point.upper = band.upper;
  if (std::isnan(band.lower)) return point;
  if (bin.n_over == 0)
    point.upper =
        std::max(point.upper, three_part_exceedance(bin.p_over_upper, bin.p_still, bin.lambda, bin.omega, capacity));
  if (bin.n_still == 0)
    point.lower =
        std::min(point.lower, three_part_exceedance(bin.p_over, bin.p_still_upper, bin.lambda, bin.omega, capacity));
  return point;
}

}  // namespace

Surface surface(const Tally& tally, std::size_t edp, const Resampling& resampling, std::vector<BinFit>& bins) {
  const Options& options = tally.options();
  const std::vector<double> capacity = capacities(options.edps[edp]);
  const std::size_t size = bins.size() * capacity.size();
  Surface result;
  result.probability.assign(size, unknown);
  result.lower = result.upper = result.empirical = result.probability;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    BinFit& bin = bins[b];
    if (bin.status == BinStatus::too_few) continue;
    const Eigen::MatrixXd groups = by_group(tally, edp, b), totals = resampling.totals(groups);
    const bool has_fit = bin.status == BinStatus::fitted || bin.status == BinStatus::rejected;
    const bool use_fit =
        bin.status == BinStatus::fitted || (bin.status == BinStatus::rejected && !options.empirical_fallback);
    const Parts parts = has_fit ? resampled_parts(totals) : Parts{};
    if (has_fit && bin.motions > 1) {
      bin.lambda_se_motions = standard_deviation(parts.lambda);
      bin.omega_se_motions = standard_deviation(parts.omega);
    }
    for (std::size_t c = 0; c < capacity.size(); ++c) {
      const Eigen::Index column = first_exceeding + static_cast<Eigen::Index>(c);
      const auto hits = static_cast<std::int64_t>(groups.col(column).sum());
      const Point point = use_fit ? fitted_point(parts, bin, capacity[c], options.confidence)
                                  : empirical_point(totals, column, hits, bin, options.confidence);
      const std::size_t at = b * capacity.size() + c;
      result.probability[at] = point.probability;
      result.lower[at] = point.lower;
      result.upper[at] = point.upper;
      result.empirical[at] = static_cast<double>(hits) / static_cast<double>(bin.n);
    }
  }
  return result;
}

}  // namespace freestand::fragility
