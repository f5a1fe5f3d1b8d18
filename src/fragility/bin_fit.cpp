#include "fragility/bin_fit.hpp"

#include <cmath>

#include "fragility/bin_sums.hpp"
#include "fragility/goodness.hpp"
#include "fragility/histogram.hpp"
#include "fragility/lognormal.hpp"
#include "fragility/share_interval.hpp"

namespace freestand::fragility {
namespace {

constexpr double least_omega = 1e-6;  // below it all samples are one value
// Simulated bins of one null distribution. p = (1 + above)/(1 + repeats) rejects a true lognormal in 25 of 501 cases, whatever the number:
// the test keeps its size. What 500 cost is that p near 0.05 is known to sqrt(0.05 * 0.95/500) = 0.01, and the critical value to such a
// level, which moves it, and by it off_by, by 2 %; four times as many would halve that at four times the time that they take.
constexpr int null_repeats = 500;

// One bin of one EDP, with its samples by group.
class Bin {
 public:
  Bin(const Tally& tally, std::size_t edp, std::size_t bin)
      : options_(tally.options()),
        edp_(options_.edps[edp]),
        bin_(bin),
        tally_(tally),
        histogram_(tally.histogram(edp, bin)),
        motions_(tally.groups()),
        by_group_(sums_by_group(tally, edp, bin)),
        total_(by_group_.colwise().sum()) {
    if (!options_.pilot_slope.empty()) pilot_ = {options_.pilot_slope[edp][bin], std::log(options_.pilot_im[bin])};
    fit_.im_mean = tally.mean_im(bin);
    fit_.n_failed = tally.failed(bin);
  }

  BinFit fitted() {
    count();
    if (fit_.n < options_.minimum_samples) return fit_;
    fit_.status = BinStatus::counts_only;
    if (edp_.binary || fit_.n_moved < options_.minimum_samples) return fit_;
    const BinSums::InCells ln_im = ln_im_of_cells(tally_, bin_);
    const auto [found, slope] = law_of(total_, ln_im, im_of_line(options_, bin_, fit_.im_mean), edp_.still_threshold);
    const ThresholdFit tested = law_along(total_, ln_im, pilot_, edp_.still_threshold).at;
    // A law that cannot be held against the samples is none.
    if (!(found.omega > least_omega) || !(tested.omega > least_omega)) return fit_;
    fit_.status = BinStatus::fitted;
    fit_.slope = slope;
    fit_.lambda = found.lambda;
    fit_.omega = found.omega;
    fit_.p_never = found.never;
    const LognormalMoments moments = lognormal_moments(found.lambda, found.omega);
    fit_.mean = moments.mean;
    fit_.standard_deviation = moments.standard_deviation;
    judge(tested);
    return fit_;
  }

 private:
  void count() {
    fit_.n = static_cast<std::int64_t>(total_.n);
    fit_.n_still = static_cast<std::int64_t>(total_.still);
    fit_.n_over = static_cast<std::int64_t>(total_.over);
    fit_.n_moved = static_cast<std::int64_t>(total_.moved);
    std::vector<GroupShare> still, over;
    for (const auto& row : by_group_.rowwise()) {
      const BinSums group(row);
      still.push_back({group.n - group.over, group.still});
      over.push_back({group.n, group.over});
      if (group.n > 0) ++fit_.motions;
    }
    set(still, fit_.p_still, fit_.p_still_lower, fit_.p_still_upper);
    set(over, fit_.p_over, fit_.p_over_lower, fit_.p_over_upper);
  }

  void set(const std::vector<GroupShare>& groups, double& p, double& lower, double& upper) const {
    double n = 0, hits = 0;
    for (const GroupShare& g : groups) {
      n += g.n;
      hits += g.hits;
    }
    if (!(n > 0)) return;
    p = hits / n;
    const Interval interval = share_interval(groups, motions_, options_.confidence);
    lower = interval.lower;
    upper = interval.upper;
  }

  // Where the threshold cuts the demands less the pilot's line: at each IM elsewhere. Three IMs a fine cell, evenly apart.
  std::vector<Cut> cuts() const {
    if (!(edp_.still_threshold > 0)) return {};
    const double ln_threshold = std::log(edp_.still_threshold);
    if (pilot_.slope == 0) return {{total_.moved, ln_threshold}};
    constexpr std::size_t cells = TallyLayout::cells_per_bin;
    const double low = options_.im_edge[bin_], width = options_.im_edge[bin_ + 1] - low;
    std::vector<Cut> found;
    for (std::size_t k = 0; k < cells; ++k) {
      const double moved = total_.moved_in[static_cast<Eigen::Index>(k)];
      for (const double part : {1.0 / 6, 1.0 / 2, 5.0 / 6}) {
        const double im = low + width * (static_cast<double>(k) + part) / cells;
        found.push_back({moved / 3, ln_threshold - pilot_.slope * (std::log(im) - pilot_.ln_im)});
      }
    }
    return found;
  }

  // S of what the histogram holds, demands less the pilot's line, against their own lognormal.
  void judge(const ThresholdFit& found) {
    const double n = total_.moved;
    const HistogramGoodness goodness = histogram_goodness(histogram_, found.lambda, found.omega, cuts());
    fit_.ks_statistic = goodness.ks;
    fit_.ks_resolution = goodness.resolution;
    fit_.ks_p_textbook = kolmogorov_p(goodness.ks, n);
    fit_.ks_critical_textbook = kolmogorov_critical(test_level, n);
    fit_.ad_statistic = goodness.ad;
    std::vector<GroupMoments> groups;
    for (const auto& row : by_group_.rowwise()) groups.push_back(moments(BinSums(row), pilot_));
    const Clustering clusters = clustering(groups, static_cast<std::size_t>(motions_.record_groups()));
    fit_.correlation = clusters.correlation;
    // What a misfit of the tally's making may add to S is granted.
    const double certain = std::max(0.0, goodness.ks - goodness.resolution);
    // Without correlation, and cut off by less than a hundredth of what S scatters, the null depends on n alone.
    if (clusters.correlation > 0 || found.below * std::sqrt(n) > 0.01) {
      const std::vector<double> simulated = clustered_null(clusters, found.below, options_.seed, null_repeats);
      fit_.ks_p_estimated = null_p(simulated, certain);
      fit_.ks_critical_estimated = sorted_quantile(simulated, 1 - test_level);
    } else {
      fit_.ks_p_estimated = estimated_ks_p(certain, n);
      fit_.ks_critical_estimated = estimated_ks_critical(test_level, n);
      fit_.ad_p_estimated = estimated_ad_p(goodness.ad, n);
    }
    // The law is no further from the truth than the fit is from the samples, and as S scatters under the null.
    // Two probabilities differ by 1 at most.
    fit_.off_by = std::min(1.0, goodness.ks + goodness.resolution + fit_.ks_critical_estimated);
  }

  const Options& options_;
  const EdpOptions& edp_;
  std::size_t bin_;
  const Tally& tally_;
  std::span<const std::int64_t> histogram_;
  const MotionGroups& motions_;
  Eigen::MatrixXd by_group_;
  BinSums total_;
  BinLine pilot_;
  BinFit fit_;
};

}  // namespace

std::vector<BinFit> fit_bins(const Tally& tally, std::size_t edp) {
  std::vector<BinFit> bins;
  std::vector<double> p;
  for (std::size_t b = 0; b < tally.layout().bins; ++b) {
    bins.push_back(Bin(tally, edp, b).fitted());
    p.push_back(bins.back().ks_p_estimated);
  }
  const std::vector<bool> rejected = benjamini_hochberg(p, tally.options().false_discovery);
  const double adequate = std::min(tally.options().adequate, tally.options().half_width / 2);
  for (std::size_t b = 0; b < bins.size(); ++b) {
    BinFit& bin = bins[b];
    bin.fdr_rejected = rejected[b];
    if (bin.status == BinStatus::fitted && !(bin.off_by <= adequate))
      bin.status = rejected[b] ? BinStatus::rejected : BinStatus::not_refuted;
  }
  return bins;
}

}  // namespace freestand::fragility
