// The rate of one demand and capacity by the counted shares of the bins: the integral over the curve through them (fragility/counted_curve.hpp),
// which discrete exports hand on, from the least intensity swept.
#pragma once

#include <algorithm>
#include <vector>

#include "decision/annual_rate.hpp"
#include "decision/rate_limits.hpp"
#include "decision/risk.hpp"
#include "fragility/counted_curve.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

class ByCounts {
 public:
  // Refers to hazard, result, demand and curve, which must outlive it. swept: least and largest intensity.
  ByCounts(const HazardCurve&, const fragility::Result&, const fragility::EdpResult&, std::size_t capacity,
           const fragility::FragilityFunction&, const Range& swept);

  bool empty() const { return bins_.empty(); }
  bool nothing_counted() const {
    return std::all_of(bins_.begin(), bins_.end(), [](const auto& bin) { return bin.probability == 0; });
  }

  // Of intensities within the range; the sum of ranges that follow each other is that of the whole.
  double rate(const Range& = {}) const;

  // Rows that no resample changes (nothing above was counted, say) are known to their own bands, which hold the exact binomial limits.
  // What these allow adds up where the same records stand in all rows: what they do not show in one row they do not show in the next,
  // and the limit of a P that is level is that of one row. Of pulses, each a motion of its own, it adds as independent errors do. To the
  // limit of what was counted it adds as largest_beside_nothing says. What of its tail the upper limit then does not need the lower one
  // takes, and the other way round (unused_tail). Half a leap within the cells adds as one more of the independent errors.
  Rate banded(const CurveReach&);

  // Rates without each group of motions.
  std::vector<double> rates_left_out() const;

  // P below the lowest bin (or fine cell, of what has no curve that grows): the counted share is followed down along the lognormal through it and
  // the next one with a larger share; it stays where there is none, and is 0 where nothing was counted.
  double rate_below(const HazardCurve&, const Range&) const;
  // By how much P above an intensity may differ from what it is there, at which it is kept: it may rise to 1, or, where it has fallen from
  // a lower intensity on by more than the limits of both, fall to 0.
  double unknown_above(double im) const;

  // An upper limit of a higher intensity (or a lower one of a lower) was taken for one in which nothing (or all) was counted.
  bool bounded_by_others() const { return bounded_by_others_; }

  // Of the upper limit, what stays if P falls below the lowest bin in which any was counted at least as the curve does.
  double upper_if_falling() const { return upper_if_falling_; }

 private:
  // Of straight lines through the bins: sum_i weight_i probability_i.
  std::vector<double> weights() const;
  // Of events within the range, with those beyond the hazard curve's end, which are as strong as there.
  double integral(const fragility::CountedCurve&, const Range& = {}) const;
  fragility::Interval rising_limits(std::size_t i);
  double falling_limit(std::size_t i) const;
  std::vector<double> rates(const std::vector<double>& again, const std::vector<double>& median,
                            const std::vector<double>& dispersion, const std::vector<double>& cell_share) const;
  // Through the bins, or through the fine cells of the shape where there are two a bin at least.
  fragility::CountedCurve curve(const std::vector<fragility::CountedBin>& bins,
                                const fragility::CountedCurve::Shape&) const;
  bool same(std::size_t i) const;
  bool by_cells() const { return !bins_.empty() && f_.cell_share.size() >= 2 * bins_.size(); }
  // How P goes within a fine cell no count tells. Lines from cell to cell are the smoothest; the sharpest curve that has the same shares is level in
  // every other cell, and leaps in those between from the level before to that behind, where the cell's own share says. The rate is the mean of
  // both: lines, and half of their difference.
  double half_a_leap(const fragility::CountedCurve& lines, const std::vector<double>& cell_share, const Range&) const;
  double rate_of(const std::vector<fragility::CountedBin>&, const fragility::CountedCurve::Shape&, const Range&) const;
  std::size_t at(std::size_t i) const { return bins_[i].index * edp_.capacity.size() + capacity_; }  // of the surface

  const HazardCurve& hazard_;
  const fragility::Result& result_;
  const fragility::EdpResult& edp_;
  const fragility::FragilityFunction& f_;
  std::size_t capacity_;
  double swept_from_;
  std::vector<fragility::CountedBin> bins_;
  // From the least intensity swept to the hazard curve's end: panels in which the curve hardly bends, their middles, and events a year.
  std::vector<double> node_, middle_, events_;
  std::vector<double> weight_;  // over all intensities
  bool bounded_by_others_ = false;
  double upper_if_falling_ = fragility::unknown;
};

}  // namespace freestand::decision
