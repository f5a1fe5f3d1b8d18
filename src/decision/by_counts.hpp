// The rate of one demand and capacity by the counted shares of the bins: P from one bin's mean to the next, the last bin's share above
// the sweep, nothing below it.
#pragma once

#include <vector>

#include "decision/annual_rate.hpp"
#include "decision/risk.hpp"
#include "fragility/jackknife.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

// The band of a rate: by leaving out groups of motions; where one of them makes all of it, or none can be left out, from resampled motions.
Rate banded(double value, const std::vector<double>& left_out, const std::vector<double>& resampled,
            const fragility::Result&);

// Estimates that leave out one group each, records among themselves and pulses among themselves.
fragility::LeftOut by_stratum(const std::vector<double>& left_out, const fragility::Result&);

class ByCounts {
 public:
  // Refers to hazard, result and demand, which must outlive it. swept: least and largest intensity.
  ByCounts(const HazardCurve&, const fragility::Result&, const fragility::EdpResult&, std::size_t capacity,
           const Range& swept);

  bool empty() const { return table_.im.empty(); }

  // rate = sum_i weight_i probability_i, of intensities within the range.
  std::vector<double> weights(const Range& = {}) const;
  double rate(const std::vector<double>& weight) const;

  // Rows that no resample changes (nothing above was counted, say) are known to their own bands, which hold the exact binomial limits;
  // what these allow adds as independent errors do.
  Rate banded();

  // Rates without each group of motions.
  std::vector<double> rates_left_out() const;

  // The rate that these bins would show if the curve were true: each share is the curve's at the bin's mean intensity where the bin's
  // own law gave it, else its mean over the bin. So it differs from the counted rate by what the curve misses, not by the width of bins.
  double rate_of(const LognormalFragility&) const;

  // P below the lowest bin: the counted share is followed down along the lognormal through it and the next bin with a larger one; it
  // stays where there is no such bin, and is 0 where nothing was counted.
  double rate_below(const HazardCurve&, const Range&) const;
  double at_end() const { return table_.probability.back(); }

  // An upper limit of a higher intensity (or a lower one of a lower) was taken for one in which nothing (or all) was counted.
  bool bounded_by_others() const { return bounded_by_others_; }

 private:
  fragility::Interval rising_limits(std::size_t i);
  std::vector<double> rates(const std::vector<double>& weight, const std::vector<double>& again) const;
  bool same(std::size_t i) const;

  const HazardCurve& hazard_;
  const fragility::Result& result_;
  const fragility::EdpResult& edp_;
  TabulatedFragility table_;
  std::vector<std::size_t> at_, bin_;  // points of the surface, and their bins
  bool bounded_by_others_ = false;
};

}  // namespace freestand::decision
