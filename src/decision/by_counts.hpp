// The rate of one demand and capacity by the counted shares of the bins: P from one bin's mean to the next, the last bin's share above
// the sweep, nothing below it. Such a polygon lies above a curve that bends up, and so do means over bins: of ten bins that are as wide as
// the curve's dispersion the rate comes out 8 % too large at a hazard slope of 1.5 and 27 % at 2.5. So the fitted curve's own rate less
// the one that such bins would show of it is added (difference estimate; W. Cochran, Sampling Techniques, 1977, chapter 7): of a true
// curve that leaves 1 % at most, and what the counts have beside the curve stays as it was counted; where the
// curve has more than the counts, in proportion.
#pragma once

#include <vector>

#include "decision/annual_rate.hpp"
#include "decision/rate_limits.hpp"
#include "decision/risk.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

class ByCounts {
 public:
  // Refers to hazard, result, demand and curve, which must outlive it. swept: least and largest intensity.
  ByCounts(const HazardCurve&, const fragility::Result&, const fragility::EdpResult&, std::size_t capacity,
           const fragility::FragilityFunction&, const Range& swept);

  bool empty() const { return table_.im.empty(); }

  // Of intensities within the range.
  double rate(const Range& = {}) const;

  // Rows that no resample changes (nothing above was counted, say) are known to their own bands, which hold the exact binomial limits.
  // What these allow adds among them as independent errors do, and to the limit of what was counted as largest_beside_nothing says. What
  // of its tail the upper limit then does not need the lower one takes, and the other way round (unused_tail).
  Rate banded(const CurveReach&);

  // Rates without each group of motions.
  std::vector<double> rates_left_out() const;

  // The curve's rate over the intensities that rate() is of.
  double rate_of(const LognormalFragility&) const;

  // P below the lowest bin: the counted share is followed down along the lognormal through it and the next bin with a larger one; it
  // stays where there is no such bin, and is 0 where nothing was counted.
  double rate_below(const HazardCurve&, const Range&) const;
  double at_end() const { return table_.probability.back(); }

  // An upper limit of a higher intensity (or a lower one of a lower) was taken for one in which nothing (or all) was counted.
  bool bounded_by_others() const { return bounded_by_others_; }

 private:
  // sum_i weight_i probability_i is the polygon's rate.
  std::vector<double> weights(const Range& = {}) const;
  double polygon(const std::vector<double>& weight) const;
  // The rate that these bins would show if the curve were true: each share is the curve's at the bin's mean intensity where the bin's own
  // law gave it, else its mean over the bin.
  double polygon_of(const LognormalFragility&) const;
  // The curve's rate less that of its polygon; in proportion where that is more than the counts' polygon, 0 where there is no curve.
  double bend(double straight, double median, double dispersion) const;
  fragility::Interval rising_limits(std::size_t i);
  std::vector<double> rates(const std::vector<double>& again, const std::vector<double>& median,
                            const std::vector<double>& dispersion) const;
  bool same(std::size_t i) const;

  const HazardCurve& hazard_;
  const fragility::Result& result_;
  const fragility::EdpResult& edp_;
  const fragility::FragilityFunction& f_;
  TabulatedFragility table_;
  std::vector<double> weight_;         // over all intensities
  std::vector<std::size_t> at_, bin_;  // points of the surface, and their bins
  bool bounded_by_others_ = false;
};

}  // namespace freestand::decision
