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

// Quantile of sorted values with linear interpolation: p = 0 is the first, p = 1 the last. NaN when empty.
double sorted_quantile(const std::vector<double>& sorted, double p);

// Percentile interval of bootstrap values (those that are not finite are left out), expanded for the number of
// resampled groups G: the tail is Phi(-sqrt(G/(G-1)) t_{tail,G-1}) in place of `tail`, so that few groups are not taken
// as many (T. Hesterberg, "What teachers should know about the bootstrap", The American Statistician 69, 2015). NaN
// with fewer than two groups or two finite values.
Interval percentile_interval(std::vector<double> values, double confidence, int groups);

// Benjamini & Hochberg (1995): which of the p values are rejected with false discovery rate `level`. NaN is never
// rejected and not counted.
std::vector<bool> benjamini_hochberg(const std::vector<double>& p, double level);

}  // namespace freestand::fragility
