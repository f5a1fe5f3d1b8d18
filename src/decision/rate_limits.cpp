#include "decision/rate_limits.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace freestand::decision {
namespace {

// So rarely no interval of the program misses; a limit that is never missed is as good as this one.
constexpr double least_tail = 1e-6;

// By bisection, since GSL's inverse ends the program where it does not converge. Of many degrees of freedom, where GSL's sums have
// no end, by E. B. Wilson & M. M. Hilferty (1931): from a thousand on it is off by less than 1e-5.
double chi_square_quantile(double p, double freedom) {
  if (freedom > 1000) {
    const double part = 2 / (9 * freedom);
    return freedom * std::pow(1 - part + gsl_cdf_ugaussian_Pinv(p) * std::sqrt(part), 3);
  }
  double low = 0, high = 1;
  while (gsl_cdf_chisq_P(high, freedom) < p) high *= 2;
  while (high - low > 1e-12 * high) {
    const double middle = (low + high) / 2;
    (gsl_cdf_chisq_P(middle, freedom) < p ? low : high) = middle;
  }
  return high;
}

struct Variance {
  double value = 0, freedom = 0;  // by Satterthwaite, as if each stratum's groups were normal
};

// NaN where an estimate is.
Variance variance_of(const fragility::LeftOut& left_out) {
  Variance sum;
  double of_it = 0;
  for (const std::vector<double>& stratum : left_out) {
    if (stratum.size() < 2) continue;
    const double own = fragility::jackknife_variance(stratum);
    sum.value += own;
    of_it += own * own / static_cast<double>(stratum.size() - 1);
  }
  sum.freedom = sum.value * sum.value / of_it;
  return sum;
}

template <class Function>
std::vector<double> each(std::vector<double> values, const Function& f) {
  for (double& value : values) value = f(value);
  return values;
}

double logarithm(double value) { return value > 0 ? std::log(value) : fragility::unknown; }

}  // namespace

fragility::LeftOut by_stratum(const std::vector<double>& left_out, const fragility::Result& result) {
  const auto border = left_out.begin() + std::min<std::ptrdiff_t>(result.left_out_records, std::ssize(left_out));
  return {{left_out.begin(), border}, {border, left_out.end()}};
}

CurveReach::CurveReach(const fragility::FragilityFunction& f, const fragility::Result& result, RateOf rate_of)
    : rate_of_(std::move(rate_of)), curve_{f.median, f.dispersion}, ln_rate_(logarithm(rate_of_(curve_))) {
  std::vector<double> both, median_alone, dispersion_alone;  // ln rate, as each of them is left as it is
  for (std::size_t g = 0; g < f.left_out_median.size(); ++g) {
    const double median = f.left_out_median[g], dispersion = f.left_out_dispersion[g];
    both.push_back(logarithm(rate_of_({median, dispersion})));
    median_alone.push_back(logarithm(rate_of_({median, f.dispersion})));
    dispersion_alone.push_back(logarithm(rate_of_({f.median, dispersion})));
  }
  const auto variance = [&](const std::vector<double>& left_out) { return variance_of(by_stratum(left_out, result)); };
  const Variance of_rate = variance(both), of_median = variance(each(f.left_out_median, logarithm)),
                 of_square = variance(each(f.left_out_dispersion, [](double d) { return d * d; }));
  for (const double value : {of_rate.value, of_median.value, of_square.value})
    if (!(value > 0) || !std::isfinite(value)) return;
  if (!std::isfinite(ln_rate_)) return;
  // A dispersion that is known to no more than its own size has no such limits: chi-square's have no end.
  if (!(2 * std::pow(f.dispersion, 4) >= of_square.value)) return;
  const double by_median = variance(median_alone).value, by_dispersion = variance(dispersion_alone).value,
               alone = by_median + by_dispersion;
  if (!(alone > 0) || !std::isfinite(alone)) return;
  const double excess = of_rate.value - alone, square = excess * excess / (4 * by_median * by_dispersion);
  const double known = square > 0 ? std::fmax(1 - 1 / (of_rate.freedom * std::fmin(square, 1)), 0) : 0;
  together_ = std::sqrt(1 + known * excess / alone);
  variance_ = of_rate.value;
  median_se_ = std::sqrt(of_median.value);
  median_freedom_ = of_median.freedom;
  dispersion_freedom_ = 2 * std::pow(f.dispersion, 4) / of_square.value;
}

double CurveReach::reach(double tail, double side) const {
  if (tail > 0.5) return -reach(1 - tail, -side);
  tail = std::max(tail, least_tail);
  const double far = median_se_ * gsl_cdf_tdist_Qinv(tail, median_freedom_),
               chi_square = chi_square_quantile(side > 0 ? tail : 1 - tail, dispersion_freedom_);
  const LognormalFragility by_median{curve_.median * std::exp(-side * far), curve_.dispersion},
      by_dispersion{curve_.median, curve_.dispersion * std::sqrt(dispersion_freedom_ / chi_square)};
  return together_ * std::hypot(std::log(rate_of_(by_median)) - ln_rate_, std::log(rate_of_(by_dispersion)) - ln_rate_);
}

RateLimits::RateLimits(double value, const std::vector<double>& left_out, std::vector<double> resampled,
                       const fragility::Result& result, const CurveReach& curve)
    : value_(value),
      curve_(curve),
      by_groups_(value, by_stratum(left_out, result)),
      by_resampling_(std::move(resampled), value, result.motions) {
  if (!by_groups_.known() || !curve.known()) return;
  scale_ = std::sqrt(variance_of(by_stratum(each(left_out, logarithm), result)).value / curve.variance());
}

double RateLimits::lower(double tail) const {
  if (scale_ > 0) return value_ * std::exp(-scale_ * curve_.below(tail));
  if (by_groups_.known()) return by_groups_.lower(tail);
  return by_resampling_.known() ? by_resampling_.lower(tail) : fragility::unknown;
}

double RateLimits::upper(double tail) const {
  if (scale_ > 0) return value_ * std::exp(scale_ * curve_.above(tail));
  if (by_groups_.known()) return by_groups_.upper(tail);
  return by_resampling_.known() ? by_resampling_.upper(tail) : fragility::unknown;
}

}  // namespace freestand::decision
