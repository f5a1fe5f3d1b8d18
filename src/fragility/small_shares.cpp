#include "fragility/small_shares.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace freestand::fragility {
namespace {

constexpr double slopes[] = {1, 2, 3};
constexpr double twentieth = 0.05, least_expected = 5;

// The bins that are known, in the order of their intensities.
std::vector<std::size_t> known_bins(const SmallShares& shares) {
  std::vector<std::size_t> known;
  for (std::size_t b = 0; b < shares.im.size(); ++b)
    if (shares.im[b] > 0 && std::isfinite(shares.misfit[b]) && std::isfinite(shares.fitted[b])) known.push_back(b);
  return known;
}

bool rates_agree(const SmallShares& shares, const std::vector<std::size_t>& known, double slope) {
  double difference = 0, counted = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::size_t b = known[i], before = known[i == 0 ? 0 : i - 1],
                      behind = known[std::min(i + 1, known.size() - 1)];
    const double weight =
        std::pow(shares.im[b] / shares.im[known[0]], -slope) * std::log(shares.im[behind] / shares.im[before]);
    difference += weight * shares.misfit[b];
    counted += weight * (shares.fitted[b] + shares.misfit[b]);
  }
  return std::fabs(difference) <= twentieth * counted;
}

// Neighbouring bins together: samples above that are expected, that many less than were counted, and what leaving out motions makes of it.
struct Pool {
  double expected = 0, excess = 0, variance = 0;
  Eigen::VectorXd left_out;
};

std::vector<Pool> pools(const SmallShares& shares, const std::vector<std::size_t>& known) {
  const double clustering = std::max(1.0, shares.clustering);
  std::vector<Pool> found;
  for (const std::size_t b : known) {
    if (std::min(shares.fitted[b], shares.fitted[b] + shares.misfit[b]) > shares.small) continue;
    if (found.empty() || found.back().expected / clustering >= least_expected)
      found.push_back({0, 0, 0, Eigen::VectorXd::Zero(shares.left_out.rows())});
    Pool& pool = found.back();
    const double n = shares.samples[b], p = shares.fitted[b];
    pool.expected += n * p;
    pool.excess += n * shares.misfit[b];
    pool.variance += clustering * n * p * (1 - p);
    for (Eigen::Index r = 0; r < shares.left_out.rows(); ++r) {
      const double misfit = shares.left_out(r, static_cast<Eigen::Index>(b));
      if (std::isfinite(misfit)) pool.left_out(r) += n * misfit;
    }
  }
  if (found.size() > 1 && found.back().expected / clustering < least_expected) {
    const Pool last = found.back();
    found.pop_back();
    Pool& pool = found.back();
    pool.expected += last.expected;
    pool.excess += last.excess;
    pool.variance += last.variance;
    pool.left_out += last.left_out;
  }
  return found;
}

// By leaving out groups of each stratum: (G - 1)/G sum of products about the means.
double covariance(const SmallShares& shares, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum = 0;
  for (const auto& [first, groups] : {std::pair<Eigen::Index, Eigen::Index>{0, shares.left_out_records},
                                      {shares.left_out_records, a.size() - shares.left_out_records}}) {
    if (groups < 2) continue;
    const auto of_a = a.segment(first, groups).array(), of_b = b.segment(first, groups).array();
    sum += (static_cast<double>(groups) - 1) / static_cast<double>(groups) *
           ((of_a - of_a.mean()) * (of_b - of_b.mean())).sum();
  }
  return sum;
}

double chance_of(const SmallShares& shares, const std::vector<Pool>& pools) {
  double sum = 0, correlations = 0;
  for (const Pool& a : pools) {
    const double of_motions = covariance(shares, a.left_out, a.left_out), variance = std::max(a.variance, of_motions);
    if (!(variance > 0)) {
      if (a.excess != 0) return 0;  // counts where the curve has none
      continue;
    }
    sum += a.excess * a.excess / variance;
    for (const Pool& b : pools) {
      const double both = of_motions * covariance(shares, b.left_out, b.left_out);
      correlations += &a == &b ? 1 : both > 0 ? std::pow(covariance(shares, a.left_out, b.left_out), 2) / both : 0;
    }
  }
  const auto m = static_cast<double>(pools.size());
  return gsl_cdf_fdist_Q(sum / m, m * m / correlations, shares.motions - 1);
}

}  // namespace

double chance_of_small_shares(const SmallShares& shares) {
  const std::vector<std::size_t> known = known_bins(shares);
  const bool counted =
      std::any_of(known.begin(), known.end(), [&](std::size_t b) { return shares.fitted[b] + shares.misfit[b] > 0; });
  if (known.size() < 2 || shares.motions < 2 || !counted) return NAN;
  if (std::all_of(std::begin(slopes), std::end(slopes), [&](double k) { return rates_agree(shares, known, k); }))
    return 1;
  const std::vector<Pool> small = pools(shares, known);
  return small.empty() ? 1 : chance_of(shares, small);
}

}  // namespace freestand::fragility
