// An estimate from samples that fall into groups (motions), with what leaving each group out in turn says of its error.
#pragma once

#include <vector>

#include "fragility/intervals.hpp"

namespace freestand::fragility {

struct Estimate {
  double value = 0;  // NaN throughout: not known
  double se = 0;
  double lower = 0, upper = 0;  // at the confidence asked for
};

// Of G estimates that leave out one group each: (G - 1)/G sum (left out - their mean)^2.
double jackknife_variance(const std::vector<double>& left_out);

// The estimates that leave out one group each, by stratum (records among themselves, pulses among themselves).
using LeftOut = std::vector<std::vector<double>>;

// With G_s groups in stratum s, mean m_s of the estimates that leave one of them out:
//   value = whole + sum_s (G_s - 1)(whole - m_s)                  (M. H. Quenouille, Biometrika 43, 1956: takes away bias of order 1/G)
//   se^2 = sum_s (G_s - 1)/G_s sum_g (left out - m_s)^2           (J. W. Tukey, Ann. Math. Stat. 29, 1958)
// and an interval by Student's t with sum_s (G_s - 1) degrees of freedom. Strata with one group tell nothing and are left
// out; se and interval are NaN where no stratum has two. Estimates that are NaN make the answer NaN.
Estimate jackknife(double whole, const LeftOut& left_out, double confidence);

// The same, with the interval cut to [0, 1].
Estimate jackknife_share(double whole, const LeftOut& left_out, double confidence);

// The same for a share between classes of `of_a_class` samples each. Such shares scatter askew; the interval is laid in Fisher's
//   z = ln((1 + (n - 1) share)/(1 - share))/2          (R. A. Fisher, Statistical Methods for Research Workers, 1925, section 40)
// which hardly does.
Estimate jackknife_share(double whole, const LeftOut& left_out, double confidence, double of_a_class);

// Limits of a positive number that scatters as a lognormal does (a rate), about `whole` and laid in its logarithm:
//   ln whole -+ t_f se,   se^2 = sum_s V_s,   V_s = (G_s - 1)/G_s sum_g (ln left out - mean)^2
// with the degrees of freedom f that the logarithms show (variance_sum.hpp). Not known where no stratum has two groups, or where whole or
// one left out is not above 0 (or not known).
class PositiveLimits {
 public:
  PositiveLimits(double whole, LeftOut left_out);
  bool known() const { return freedom_ > 0; }
  double lower(double tail) const;
  double upper(double tail) const;

 private:
  double whole_, se_ = 0, freedom_ = 0;
};

}  // namespace freestand::fragility
