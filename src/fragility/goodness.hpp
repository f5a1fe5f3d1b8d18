// Goodness of fit: does a lognormal (or any named) distribution describe the samples?
//
// The textbook Kolmogorov-Smirnov test holds for a distribution that was known before the samples were seen. With
// lambda and omega estimated from the same samples the fit lies closer to them than the truth does, S comes out
// smaller, and the textbook values are far too lax: a nominal 5 % test then rejects a true lognormal about once in ten
// thousand, and seldom rejects anything else. The right null distribution follows by simulating the very procedure -
// draw, estimate, measure S. For a location-scale family (ln x is one) it depends on n alone, not on lambda and omega
// (H. Lilliefors, J. Am. Stat. Assoc. 62, 1967). Both p values are given; the one for estimated parameters is the one
// to believe.
//
// The tests take the samples as independent. With thousands of samples a misfit too small to matter is rejected as
// well, so that S itself must be read beside its p value: it is the largest error of the fitted probability.
#pragma once

#include <span>

namespace freestand::fragility {

// Level of the tests of fits: that of the report [KM05 5.31], whose acceptances are compared with ours. Over the bins of a study it is the
// share of false alarms among those that fail (benjamini_hochberg).
inline constexpr double test_level = 0.05;

// S = max |F_n - F| over both sides of every step [KM05 5.28-5.30], from u_i = F(x_i) in increasing order.
double ks_statistic(std::span<const double> sorted_u);

// A^2 = -n - sum_i ((2i-1) ln u_i + (2(n-i)+1) ln(1 - u_i))/n (Anderson & Darling), from u_i in increasing order.
double ad_statistic(std::span<const double> sorted_u);

// P(S > s) for a distribution known beforehand: Kolmogorov's series at (sqrt(n) + 0.12 + 0.11/sqrt(n)) s (Stephens
// 1970). Against the exact distribution: within 2 % of p for p <= 0.1 and n >= 10, within 0.015 everywhere for n >= 5.
double kolmogorov_p(double s, double n);

// The s that is exceeded with probability `level`, by the same formula (5 %: 1.358/(sqrt(n) + 0.12 + 0.11/sqrt(n))
// [KM05 5.31]).
double kolmogorov_critical(double level, double n);

// The same for a lognormal whose two parameters are estimated by maximum likelihood from the same samples, by tables of
// four million simulated samples for each n of a grid up to 1000 (tests/fragility/tabulate_estimated_null.py). Between the
// grid's n, p is interpolated in 1/sqrt(n) after the scaling below, which takes away nearly all dependence on n; beyond
// 1000 the scaling alone is used (going on as from 200 to 1000, p = 0.05 would be 0.052 for n without end).
//   S (sqrt(n) - 0.01 + 0.85/sqrt(n)),   A^2 (1 + 0.75/n + 2.25/n^2)      (Stephens, J. Am. Stat. Assoc. 69, 1974)
// n >= 5, otherwise NaN. p is from 0.0001 to 0.9999, where the tables end.
double estimated_ks_p(double s, double n);
double estimated_ad_p(double a2, double n);
double estimated_ks_critical(double level, double n);

}  // namespace freestand::fragility
