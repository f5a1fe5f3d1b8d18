// Limits of annual rates, from the curves and rates that leave out one group of motions each.
#pragma once

#include <functional>
#include <vector>

#include "decision/annual_rate.hpp"
#include "fragility/intervals.hpp"
#include "fragility/jackknife.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

// Estimates that leave out one group each, records among themselves and pulses among themselves.
fragility::LeftOut by_stratum(const std::vector<double>& left_out, const fragility::Result&);

// How far ln rate of a lognormal curve reaches below and above its value. ln rate is nearly -k ln median + k^2 dispersion^2/2
// (annual_rate.hpp), a normal number and one that scatters as chi-square over its degrees of freedom does, so that a sample of few records
// with a small dispersion has both a small rate and a small error of it: limits that are alike on both sides miss the truth above them
// five times as often as below. So each of the two has its own limits, Student's of ln median and
//   dispersion^2 f/chi-square_f,   f = 2 dispersion^4/var(dispersion^2)
// with variances by leaving groups out, and ln rate those that their distances, each taken alone, make as independent errors do (G. Zou,
// C. Huo & J. Taleban, Environmetrics 20, 2009, for the mean of a lognormal; the median and the variance of normal numbers are
// independent). Those of a fitted curve are not where what was swept ends near the median: the distance is scaled by the standard error
// of ln rate, which groups left out tell as a whole, over that of independent errors. What n groups tell of a correlation r is its
// square and 1/(n - 1), so that r^2 - 1/(n - 1) over r^2 of the covariance counts (W. James & C. Stein, 1961): few records that seem
// to err together by chance would make bands of 90 % hold the truth in 86 %.
class CurveReach {
 public:
  using RateOf = std::function<double(const LognormalFragility&)>;

  // Refers to nothing of what it is given.
  CurveReach(const fragility::FragilityFunction&, const fragility::Result&, RateOf);

  bool known() const { return variance_ > 0; }
  double variance() const { return variance_; }  // of ln rate, by leaving groups out
  double below(double tail) const { return reach(tail, -1); }
  double above(double tail) const { return reach(tail, +1); }

 private:
  double reach(double tail, double side) const;

  RateOf rate_of_;
  LognormalFragility curve_;
  double ln_rate_ = 0, variance_ = 0;
  double median_se_ = 0, median_freedom_ = 0, dispersion_freedom_ = 0;
  double together_ = 1;  // standard error of ln rate over that of independent errors
};

// The limits of a rate: as far as leaving out groups shows that it scatters, and as askew as that of the curve (CurveReach). Where there is
// no curve, in its logarithm alike on both sides (PositiveLimits); where one group makes all of it, or none can be left out, from resampled
// motions.
class RateLimits {
 public:
  RateLimits(double value, const std::vector<double>& left_out, std::vector<double> resampled, const fragility::Result&,
             const CurveReach&);
  double lower(double tail) const;  // NaN: not known
  double upper(double tail) const;

 private:
  double value_, scale_ = 0;  // of the curve's reach; 0: there is none
  const CurveReach& curve_;
  fragility::PositiveLimits by_groups_;
  fragility::PercentileLimits by_resampling_;
};

}  // namespace freestand::decision
