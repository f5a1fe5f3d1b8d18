#include "fragility/surface.hpp"

#include <algorithm>
#include <cmath>

#include "fragility/bin_sums.hpp"
#include "fragility/intervals.hpp"
#include "fragility/lognormal.hpp"
#include "fragility/share_interval.hpp"

namespace freestand::fragility {
namespace {

// One point of a surface.
struct Point {
  double probability = unknown, lower = unknown, upper = unknown;
};

// Share of the samples above a capacity, its counts in the given column of the groups' table.
Point empirical_point(const Eigen::MatrixXd& groups, Eigen::Index column, const MotionGroups& motions,
                      double confidence) {
  std::vector<GroupShare> shares;
  for (Eigen::Index g = 0; g < groups.rows(); ++g) shares.push_back({groups(g, 0), groups(g, column)});
  const Interval band = share_interval(shares, motions, confidence);
  return {groups.col(column).sum() / groups.col(0).sum(), band.lower, band.upper};
}

struct Parts {
  std::vector<double> p_over, p_never, lambda, omega;  // [resample]
};

Parts resampled_parts(const Eigen::MatrixXd& totals, const BinSums::InCells& ln_im, double im, double still_threshold) {
  Parts parts;
  for (Eigen::Index r = 0; r < totals.rows(); ++r) {
    const BinSums sums(totals.row(r));
    const ThresholdFit fit = law_of(sums, ln_im, im, still_threshold).at;
    const bool usable = fit.omega > 0;
    parts.p_over.push_back(sums.over / sums.n);
    parts.p_never.push_back(usable ? fit.never : unknown);
    parts.lambda.push_back(usable ? fit.lambda : unknown);
    parts.omega.push_back(usable ? fit.omega : unknown);
  }
  return parts;
}

// P = over + (1 - over) Q, with Q what was fitted and nothing that overturned in the bin.
double upper_beside_none_over(const PercentileLimits& limits, double over_upper, double tail) {
  return largest_beside_nothing(tail, [&](double share, double rest) {
    const double over = 1 - std::pow(1 - over_upper, share);
    return over + (1 - over) * limits.upper(rest);
  });
}

// P = over + (1 - never) (P - over), with none of those that stood without any demand.
double lower_beside_none_never(const PercentileLimits& limits, double over, double never_upper, double tail) {
  return -largest_beside_nothing(tail, [&](double share, double rest) {
    return -over - std::pow(1 - never_upper, share) * (limits.lower(rest) - over);
  });
}

Point fitted_point(const Parts& parts, const BinFit& bin, double capacity, double confidence, bool censored) {
  Point point{three_part_exceedance(bin.p_over, bin.p_never, bin.lambda, bin.omega, capacity)};
  std::vector<double> values;
  for (std::size_t r = 0; r < parts.lambda.size(); ++r)
    values.push_back(
        three_part_exceedance(parts.p_over[r], parts.p_never[r], parts.lambda[r], parts.omega[r], capacity));
  const PercentileLimits limits(std::move(values), point.probability, bin.motions);
  if (!limits.known()) return point;
  const double tail = (1 - confidence) / 2;
  const auto lower = [&](double of) {
    return bin.n_still > 0 ? limits.lower(of) : lower_beside_none_never(limits, bin.p_over, bin.p_still_upper, of);
  };
  const auto upper = [&](double of) {
    return bin.n_over > 0 || !censored ? limits.upper(of) : upper_beside_none_over(limits, bin.p_over_upper, of);
  };
  const auto fitted_lower = [&](double of) { return limits.lower(of); };
  const auto fitted_upper = [&](double of) { return limits.upper(of); };
  const double least = lower(tail), most = upper(tail);
  point.lower = lower(tail + unused_tail(tail, +1, fitted_upper, most));
  point.upper = upper(tail + unused_tail(tail, -1, fitted_lower, least));
  return point;
}

}  // namespace

void nest(std::span<double> lower, std::span<double> upper) {
  for (std::size_t c = 1; c < upper.size(); ++c) upper[c] = std::fmin(upper[c], upper[c - 1]);
  for (std::size_t c = lower.size(); c-- > 1;) lower[c - 1] = std::fmax(lower[c - 1], lower[c]);
}

Surface surface(const Tally& tally, std::size_t edp, const Resampling& resampling, std::vector<BinFit>& bins) {
  const Options& options = tally.options();
  const std::vector<double> capacity = capacities(options.edps[edp]);
  const std::size_t size = bins.size() * capacity.size();
  Surface result;
  result.probability.assign(size, unknown);
  result.lower = result.upper = result.empirical = result.least = result.most = result.probability;
  result.empirical_lower = result.empirical_upper = result.probability;
  result.resampled.assign(size * static_cast<std::size_t>(resampling.resamples()), unknown);
  result.left_out.assign(size * static_cast<std::size_t>(resampling.left_out()), unknown);
  for (std::size_t b = 0; b < bins.size(); ++b) {
    BinFit& bin = bins[b];
    if (bin.status == BinStatus::too_few) continue;
    const Eigen::MatrixXd groups = sums_by_group(tally, edp, b), totals = resampling.totals(groups),
                          left_out = resampling.totals_left_out(groups);
    const bool has_fit = bin.status != BinStatus::counts_only;
    const bool use_fit = bin.status == BinStatus::fitted || (has_fit && !options.empirical_fallback);
    const Parts parts = has_fit ? resampled_parts(totals, ln_im_of_cells(tally, b), im_of_line(options, b, bin.im_mean),
                                                  options.edps[edp].still_threshold)
                                : Parts{};
    if (has_fit && bin.motions > 1) {
      bin.lambda_se = standard_deviation(parts.lambda);
      bin.omega_se = standard_deviation(parts.omega);
    }
    for (std::size_t c = 0; c < capacity.size(); ++c) {
      const Eigen::Index column = BinSums::size + static_cast<Eigen::Index>(c);
      const Point counted = empirical_point(groups, column, tally.groups(), options.confidence);
      const Point point =
          use_fit ? fitted_point(parts, bin, capacity[c], options.confidence, options.edps[edp].censored) : counted;
      const double hits = groups.col(column).sum(), n = static_cast<double>(bin.n);
      const double failed = static_cast<double>(bin.n_failed);
      const std::size_t at = b * capacity.size() + c;
      result.probability[at] = point.probability;
      result.lower[at] = point.lower;
      result.upper[at] = point.upper;
      result.empirical[at] = counted.probability;
      result.empirical_lower[at] = counted.lower;
      result.empirical_upper[at] = counted.upper;
      result.least[at] = hits / (n + failed);
      result.most[at] = (hits + failed) / (n + failed);
      const auto put = [&](const Eigen::MatrixXd& all, std::vector<double>& shares) {
        for (Eigen::Index r = 0; r < all.rows(); ++r)
          shares[static_cast<std::size_t>(r) * size + at] = all(r, column) / all(r, 0);
      };
      put(totals, result.resampled);
      put(left_out, result.left_out);
    }
    const auto of_bin = [&](std::vector<double>& all) {
      return std::span(all).subspan(b * capacity.size(), capacity.size());
    };
    nest(of_bin(result.lower), of_bin(result.upper));
    nest(of_bin(result.empirical_lower), of_bin(result.empirical_upper));
  }
  return result;
}

}  // namespace freestand::fragility
