// Intervals for counts and for resampled values, and the control of false discoveries.
#pragma once

#include <algorithm>
#include <cmath>
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

// Limits of an estimate from its bootstrap values (those that are not finite are left out), corrected for median bias and expanded for
// the number of resampled groups G: the quantiles Phi(2 z0 -+ z) in place of Phi(-+1.96), with
//   Phi(z0) = share of values below the estimate      (B. Efron, Canadian J. Statistics 9, 1981),
//   z = sqrt(G/(G-1)) t_{G-1}                          (T. Hesterberg, The American Statistician 69, 2015),
// since few groups make the spread between them look smaller than it is.
class PercentileLimits {
 public:
  PercentileLimits(std::vector<double> values, double estimate, int groups);

  bool known() const { return groups_ > 0; }  // two groups and two finite values at least
  double lower(double tail) const { return at(-reach(tail)); }
  double upper(double tail) const { return at(reach(tail)); }

 private:
  double reach(double tail) const;
  double at(double z) const;

  std::vector<double> values_;
  double bias_ = 0, groups_ = 0;
};

// Limit of a + b where a was estimated and of b nothing was counted, so that only an exact limit of it is known, above which nothing is
// counted in less than `tail` of the cases. A pair (a, b) is refused where nothing counted and, beside it, so low an estimate of a are
// rarer than the tail. Where of b nothing is counted in tail^s of the cases, a reaches up to its limit of tail^(1 - s), so the limit is the
// largest of sum(s, tail^(1 - s)) over s = 0 ... 1: that of a alone where a is known worse than b, that of b where a is known far better.
// Within 0 ... 1 it is flat where it is largest: 32 steps miss a thousandth of what b adds.
template <class Sum>
double largest_beside_nothing(double tail, const Sum& sum) {
  constexpr int steps = 32;
  double most = sum(0.0, tail);
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    most = std::max(most, sum(share, std::pow(tail, 1 - share)));
  }
  return most;
}

// What of its tail a limit does not need that what was not seen has moved further out (largest_beside_nothing): where in truth there is
// nothing to be seen, the estimate alone crosses it in fewer cases, those t of which at(t) = limit. The rest is the other limit's, so that
// both together miss the truth as often as was asked (as G. Feldman & R. Cousins lay intervals beside a border, Phys. Rev. D 57, 1998).
// at(t): the estimate's own limit, which goes outwards as t falls; outwards: +1 of an upper limit, -1 of a lower one. Below a millionth
// nothing is sought: that much in the coverage is nothing.
template <class At>
double unused_tail(double tail, double outwards, const At& at, double limit) {
  constexpr double least = 1e-6, close = 1e-3;  // of a tail of 0.05 half of a ten-thousandth
  const auto beyond = [&](double t) { return outwards * (limit - at(t)) > 0; };
  if (!beyond(tail)) return 0;
  if (beyond(least)) return tail;
  double low = std::log(least), high = std::log(tail);
  while (high - low > close) {
    const double middle = (low + high) / 2;
    (beyond(std::exp(middle)) ? high : low) = middle;
  }
  return tail - std::exp(high);
}

// Both limits; NaN where they are not known.
Interval percentile_interval(std::vector<double> values, double estimate, double confidence, int groups);

// Benjamini & Hochberg (1995): which of the p values are rejected with false discovery rate `level`. NaN is never
// rejected and not counted.
std::vector<bool> benjamini_hochberg(const std::vector<double>& p, double level);

}  // namespace freestand::fragility
