// Intervals for counts and for resampled values, and the control of false discoveries.
#pragma once

#include <cstdint>
#include <vector>

namespace freestand::fragility {

struct Interval {
  double lower, upper;
};

// Exact two-sided binomial interval of a probability from `hits` of `trials` (Clopper & Pearson 1934), by beta
// quantiles. [0, 1] when there is no trial. Takes the trials as independent. Beyond 1e5 hits and 1e5 misses the score
// interval with continuity correction stands in; its limits differ by less than 1e-3 of the width.
Interval clopper_pearson(std::int64_t hits, std::int64_t trials, double confidence);
// The same for real numbers, such as an effective number of trials.
Interval exact_interval(double hits, double trials, double confidence);

// Quantile of sorted values with linear interpolation: p = 0 is the first, p = 1 the last. NaN when empty.
double sorted_quantile(const std::vector<double>& sorted, double p);

// Standard deviation of those that are finite, divisor n - 1; NaN with fewer than two.
double standard_deviation(const std::vector<double>& values);

// Percentile interval of bootstrap values of an estimate (values that are not finite are left out), corrected for median bias
// and expanded for the number of resampled groups G: the quantiles Phi(2 z0 -+ z) in place of Phi(-+1.96), with
//   Phi(z0) = share of values below the estimate      (B. Efron, Canadian J. Statistics 9, 1981),
//   z = sqrt(G/(G-1)) t_{G-1}                          (T. Hesterberg, The American Statistician 69, 2015),
// since few groups make the spread between them look smaller than it is. NaN with fewer than two groups or two finite values.
Interval percentile_interval(std::vector<double> values, double estimate, double confidence, int groups);

// Benjamini & Hochberg (1995): which of the p values are rejected with false discovery rate `level`. NaN is never
// rejected and not counted.
std::vector<bool> benjamini_hochberg(const std::vector<double>& p, double level);

}  // namespace freestand::fragility
