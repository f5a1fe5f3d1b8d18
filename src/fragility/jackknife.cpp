#include "fragility/jackknife.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fragility/variance_sum.hpp"

namespace freestand::fragility {

double jackknife_variance(const std::vector<double>& left_out) {
  const double groups = static_cast<double>(left_out.size());
  const double mean = std::accumulate(left_out.begin(), left_out.end(), 0.0) / groups;
  double squares = 0;
  for (const double one : left_out) squares += (one - mean) * (one - mean);
  return (groups - 1) / groups * squares;
}

Estimate jackknife(double whole, const LeftOut& left_out, double confidence) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Estimate result{whole, nan, nan, nan};
  double variance = 0, freedom = 0;
  for (const std::vector<double>& stratum : left_out) {
    if (stratum.size() < 2) continue;
    const double groups = static_cast<double>(stratum.size());
    const double mean = std::accumulate(stratum.begin(), stratum.end(), 0.0) / groups;
    result.value += (groups - 1) * (whole - mean);
    variance += jackknife_variance(stratum);
    freedom += groups - 1;
  }
  if (freedom == 0 || std::isnan(result.value)) return result;
  result.se = std::sqrt(variance);
  const double reach = gsl_cdf_tdist_Qinv((1 - confidence) / 2, freedom) * result.se;
  result.lower = result.value - reach;
  result.upper = result.value + reach;
  return result;
}

Estimate jackknife_share(double whole, const LeftOut& left_out, double confidence) {
  Estimate result = jackknife(whole, left_out, confidence);
  result.lower = std::clamp(result.lower, 0.0, 1.0);
  result.upper = std::clamp(result.upper, 0.0, 1.0);
  return result;
}

Estimate jackknife_share(double whole, const LeftOut& left_out, double confidence, double of_a_class) {
  // z = ln(F)/2 with F the ratio of the variances between and within classes, 1 where there is no effect. With one group left out classes
  // are smaller, and F may come out at 0 or below: its logarithm must not make the error. Of four classes without an effect one F in 700 is
  // below 0.01, of six one in 30,000; of two one in 13, where the lower limit of the share is 0 all the same.
  constexpr double least = 0.01;
  const double n = std::max(of_a_class, 2.0);
  const auto z = [&](double share) {
    return 0.5 * std::log(std::max(1 + (n - 1) * share, least) / std::max(1 - share, 1e-12));
  };
  const auto back = [&](double at) { return std::clamp(std::expm1(2 * at) / (std::exp(2 * at) + n - 1), 0.0, 1.0); };
  Estimate result = jackknife(whole, left_out, confidence);
  LeftOut transformed(left_out);
  for (auto& stratum : transformed)
    for (double& one : stratum) one = z(one);
  const Estimate interval = jackknife(z(whole), transformed, confidence);
  result.lower = back(interval.lower);
  result.upper = back(interval.upper);
  return result;
}

PositiveLimits::PositiveLimits(double whole, LeftOut left_out) : whole_(whole) {
  VarianceSum variance;
  double most = 0;
  for (std::vector<double>& stratum : left_out) {
    if (stratum.size() < 2) continue;
    for (double& one : stratum) one = one > 0 ? std::log(one) : std::numeric_limits<double>::quiet_NaN();
    variance.add(jackknife_variance(stratum), stratum);
    most += static_cast<double>(stratum.size()) - 1;
  }
  if (most == 0 || !(whole > 0) || std::isnan(variance.value())) return;
  se_ = std::sqrt(variance.value());
  freedom_ = variance.value() > 0 ? variance.freedom() : most;
}

double PositiveLimits::upper(double tail) const { return whole_ * std::exp(se_ * gsl_cdf_tdist_Qinv(tail, freedom_)); }
double PositiveLimits::lower(double tail) const { return whole_ * std::exp(-se_ * gsl_cdf_tdist_Qinv(tail, freedom_)); }

}  // namespace freestand::fragility
