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

}  // namespace freestand::fragility
