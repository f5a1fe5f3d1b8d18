#include "fragility/lognormal.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>

namespace freestand::fragility {
namespace {

LognormalFit from_moments(double n, double lambda, double omega2) {
  LognormalFit fit{};
  fit.n = n;
  fit.lambda = lambda;
  fit.omega = std::sqrt(omega2);
  const double s = fit.omega * std::sqrt(n / (n - 1));
  fit.lambda_se = s / std::sqrt(n);
  fit.omega_se = s / std::sqrt(2 * (n - 1));
  const LognormalMoments moments = lognormal_moments(fit.lambda, fit.omega);
  fit.mean = moments.mean;
  fit.standard_deviation = moments.standard_deviation;
  return fit;
}

LognormalFit nothing(double n) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {n, none, none, none, none, none, none};
}

}  // namespace

LognormalFit fit_lognormal(std::span<const double> samples) {
  const double n = static_cast<double>(samples.size());
  double sum = 0;
  for (const double x : samples) {
    if (!(x > 0) || !std::isfinite(x))
      throw Error(fmt::format("lognormal fit is impossible (a sample is {}): leave out what is not positive", x),
                  Exit::data);
    sum += std::log(x);
  }
  if (samples.size() < 2) return nothing(n);
  const double lambda = sum / n;
  double squares = 0;
  for (const double x : samples) squares += (std::log(x) - lambda) * (std::log(x) - lambda);
  return from_moments(n, lambda, squares / n);
}

LognormalFit fit_lognormal(double n, double sum_ln, double sum_ln2) {
  if (n < 2) return nothing(n);
  const double lambda = sum_ln / n;
  return from_moments(n, lambda, std::max(0.0, sum_ln2 / n - lambda * lambda));
}

Interval lambda_interval(const LognormalFit& fit, double confidence) {
  const double t = gsl_cdf_tdist_Qinv((1 - confidence) / 2, fit.n - 1);
  return {fit.lambda - t * fit.lambda_se, fit.lambda + t * fit.lambda_se};
}

Interval omega_interval(const LognormalFit& fit, double confidence) {
  const double tail = (1 - confidence) / 2, sum = fit.n * fit.omega * fit.omega;
  return {std::sqrt(sum / gsl_cdf_chisq_Qinv(tail, fit.n - 1)), std::sqrt(sum / gsl_cdf_chisq_Pinv(tail, fit.n - 1))};
}

LognormalMoments lognormal_moments(double lambda, double omega) {
  const double mean = std::exp(lambda + omega * omega / 2);
  return {mean, mean * std::sqrt(std::expm1(omega * omega))};
}

LognormalParameters lognormal_from_moments(double mean, double standard_deviation) {
  const double variation = standard_deviation / mean;
  const double omega2 = std::log1p(variation * variation);
  return {std::log(mean) - omega2 / 2, std::sqrt(omega2)};
}

double lognormal_cdf(double x, double lambda, double omega) {
  return 0.5 * std::erfc(-(std::log(x) - lambda) / (omega * std::sqrt(2.0)));
}

double lognormal_exceedance(double x, double lambda, double omega) {
  return 0.5 * std::erfc((std::log(x) - lambda) / (omega * std::sqrt(2.0)));
}

double three_part_exceedance(double p_over, double p_still, double lambda, double omega, double capacity) {
  const double moved = (1 - p_over) * (1 - p_still);
  return moved > 0 ? p_over + moved * lognormal_exceedance(capacity, lambda, omega) : p_over;
}

}  // namespace freestand::fragility
