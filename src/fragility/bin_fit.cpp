#include "fragility/bin_fit.hpp"

#include "fragility/histogram.hpp"
#include "fragility/intervals.hpp"
#include "fragility/lognormal.hpp"

namespace freestand::fragility {
namespace {

constexpr double test_level = 0.05;
constexpr double least_omega = 1e-6;  // below it all samples are one value

struct Total {
  Counts counts;
  int motions = 0;
};

Total total_of(const Tally& tally, std::size_t edp, std::size_t bin) {
  Total total;
  for (std::size_t g = 0; g < tally.layout().groups; ++g) {
    const Counts here = tally.counts(edp, bin, g);
    total.counts.n += here.n;
    total.counts.still += here.still;
    total.counts.over += here.over;
    total.counts.moved += here.moved;
    total.counts.sum_ln += here.sum_ln;
    total.counts.sum_ln2 += here.sum_ln2;
    if (here.n > 0) ++total.motions;
  }
  return total;
}

void set_probability(std::int64_t hits, std::int64_t trials, double confidence, double& p, double& lower,
                     double& upper) {
  if (trials == 0) return;
  p = static_cast<double>(hits) / static_cast<double>(trials);
  const Interval interval = clopper_pearson(hits, trials, confidence);
  lower = interval.lower;
  upper = interval.upper;
}

void set_lognormal(const LognormalFit& fit, BinFit& bin) {
  bin.lambda = fit.lambda;
  bin.lambda_se = fit.lambda_se;
  bin.omega = fit.omega;
  bin.omega_se = fit.omega_se;
  bin.mean = fit.mean;
  bin.standard_deviation = fit.standard_deviation;
}

void set_goodness(std::span<const std::int64_t> histogram, EstimatedNull& null, BinFit& bin) {
  const double n = static_cast<double>(bin.n_moved);
  const HistogramGoodness goodness = histogram_goodness(histogram, bin.lambda, bin.omega);
  bin.ks_statistic = goodness.ks;
  bin.ks_resolution = goodness.resolution;
  bin.ks_p_textbook = kolmogorov_p(goodness.ks, n);
  bin.ks_critical_textbook = kolmogorov_critical(test_level, n);
  bin.ks_p_estimated = null.ks_p(goodness.ks, n);
  bin.ks_critical_estimated = null.ks_critical(test_level, n);
  bin.ad_statistic = goodness.ad;
  bin.ad_p_estimated = null.ad_p(goodness.ad, n);
}

BinFit fit_bin(const Tally& tally, std::size_t edp, std::size_t index, EstimatedNull& null) {
  const Options& options = tally.options();
  const auto [counts, motions] = total_of(tally, edp, index);
  BinFit bin;
  bin.n = counts.n;
  bin.n_still = counts.still;
  bin.n_over = counts.over;
  bin.n_moved = counts.moved;
  bin.motions = motions;
  bin.im_mean = tally.mean_im(index);
  set_probability(counts.still, counts.n - counts.over, options.confidence, bin.p_still, bin.p_still_lower,
                  bin.p_still_upper);
  set_probability(counts.over, counts.n, options.confidence, bin.p_over, bin.p_over_lower, bin.p_over_upper);
  if (counts.n < options.minimum_samples) return bin;
  bin.status = BinStatus::counts_only;
  if (options.edps[edp].binary || counts.moved < options.minimum_samples) return bin;
  const LognormalFit fit = fit_lognormal(static_cast<double>(counts.moved), counts.sum_ln, counts.sum_ln2);
  if (!(fit.omega > least_omega)) return bin;
  bin.status = BinStatus::fitted;
  set_lognormal(fit, bin);
  set_goodness(tally.histogram(edp, index), null, bin);
  return bin;
}

}  // namespace

std::vector<BinFit> fit_bins(const Tally& tally, std::size_t edp, EstimatedNull& null) {
  std::vector<BinFit> bins;
  std::vector<double> p;
  for (std::size_t b = 0; b < tally.layout().bins; ++b) {
    bins.push_back(fit_bin(tally, edp, b, null));
    p.push_back(bins.back().ks_p_estimated);
  }
  const std::vector<bool> rejected = benjamini_hochberg(p, tally.options().false_discovery);
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (!rejected[b]) continue;
    bins[b].fdr_rejected = 1;
    bins[b].status = BinStatus::rejected;
  }
  return bins;
}

}  // namespace freestand::fragility
