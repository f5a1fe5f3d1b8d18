// The lognormal demand model of one IM bin, and the three-part exceedance built on it.
#pragma once

#include <span>

#include "fragility/intervals.hpp"

namespace freestand::fragility {

// ln X ~ N(lambda, omega^2). Maximum likelihood [KM05 5.21-5.25]:
//   lambda = mean of ln x,  omega^2 = mean of (ln x - lambda)^2   (divisor n, not n - 1).
// omega is low by a factor of about 1 - 3/(4n) on average; the standard errors and intervals allow for it with
// s^2 = omega^2 n/(n-1):  lambda_se = s/sqrt(n),  omega_se = s/sqrt(2(n-1)).
struct LognormalFit {
  double n = 0;  // number of samples (a real, since resampled sums are weighted)
  double lambda, omega;
  double lambda_se, omega_se;
  double mean, standard_deviation;  // exp(lambda + omega^2/2), mean sqrt(exp(omega^2) - 1) [KM05 5.24]
};

// From the samples (all > 0, at least two), or from their number and the sums of ln x and ln^2 x.
// Everything is NaN with fewer than two samples. Throws Error on a sample that is not positive and finite.
LognormalFit fit_lognormal(std::span<const double> samples);
LognormalFit fit_lognormal(double n, double sum_ln, double sum_ln2);

// Exact intervals for independent samples: lambda by Student's t, omega by chi squared with n - 1 degrees of freedom.
Interval lambda_interval(const LognormalFit& fit, double confidence);
Interval omega_interval(const LognormalFit& fit, double confidence);

// Of the lognormal distribution [KM05 5.24]: exp(lambda + omega^2/2), mean sqrt(exp(omega^2) - 1).
struct LognormalMoments {
  double mean, standard_deviation;
};
LognormalMoments lognormal_moments(double lambda, double omega);

// Parameters of the lognormal distribution with the given mean and standard deviation (both > 0) [KM05 5.24]:
//   omega^2 = ln(1 + (sd/mean)^2),  lambda = ln mean - omega^2/2.
struct LognormalParameters {
  double lambda, omega;
};
LognormalParameters lognormal_from_moments(double mean, double standard_deviation);

// P(X <= x) and P(X > x).
double lognormal_cdf(double x, double lambda, double omega);
double lognormal_exceedance(double x, double lambda, double omega);

// P(EDP > C) = P_over + (1 - P_over)(1 - P_still)(1 - Phi((ln C - lambda)/omega)), C > 0. P_still is the probability of
// standing still given that the block did not overturn. Where P_over = 1 or P_still = 1, lambda and omega may be NaN.
double three_part_exceedance(double p_over, double p_still, double lambda, double omega, double capacity);

}  // namespace freestand::fragility
