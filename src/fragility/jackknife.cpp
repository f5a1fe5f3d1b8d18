#include "fragility/jackknife.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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
  // Left out groups leave smaller classes, where a share may lie a little below the least that z knows.
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

Interval jackknife_of_positive(double whole, LeftOut left_out, double confidence) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  double variance = 0, variance_of_it = 0, most = 0;
  for (std::vector<double>& stratum : left_out) {
    if (stratum.size() < 2) continue;
    const double groups = static_cast<double>(stratum.size());
    for (double& one : stratum) one = one > 0 ? std::log(one) : nan;
    const double mean = std::accumulate(stratum.begin(), stratum.end(), 0.0) / groups;
    double second = 0, fourth = 0;
    for (const double one : stratum) {
      second += std::pow(one - mean, 2) / groups;
      fourth += std::pow(one - mean, 4) / groups;
    }
    variance += jackknife_variance(stratum);
    variance_of_it += (groups - 1) * (groups - 1) / groups * (fourth - second * second);
    most += groups - 1;
  }
  if (most == 0 || !(whole > 0) || std::isnan(variance)) return {nan, nan};
  if (variance == 0) return {whole, whole};
  const double freedom =
      2 * variance * variance < most * variance_of_it ? 2 * variance * variance / variance_of_it : most;
  const double reach = gsl_cdf_tdist_Qinv((1 - confidence) / 2, freedom) * std::sqrt(variance);
  return {whole * std::exp(-reach), whole * std::exp(reach)};
}

}  // namespace freestand::fragility
