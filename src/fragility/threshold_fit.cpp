#include "fragility/threshold_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fragility/lognormal.hpp"
#include "fragility/normal.hpp"

namespace freestand::fragility {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// Halves [low, high] until f, which is positive at low and negative at high, changes sign within round-off.
template <class Function>
double root(double low, double high, const Function& f) {
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (f(middle) > 0 ? low : high) = middle;
  }
}

// With a = 1/omega, b = (lambda - ln c)/omega and u = ln x - ln c the logarithm of the likelihood is
//   n ln a - sum (a u - b)^2/2 + m ln Phi(-b);
// a follows from b, and the slope over b falls.
ThresholdFit censored(double n, double first, double second, double still, double ln_threshold) {
  const auto a_of = [&](double b) {
    return (b * n * first + std::sqrt(b * b * n * n * first * first + 4 * n * n * second)) / (2 * n * second);
  };
  const double b = root(-30, 1e3, [&](double x) { return a_of(x) * n * first - n * x - still * normal_hazard(x); });
  const double omega = 1 / a_of(b);
  return {ln_threshold + b * omega, omega, 0, normal_cdf(-b)};
}

}  // namespace

TruncatedNormal fit_truncated(double c, double first, double second) {
  // With h = phi/(1 - Phi) at z the mean of y - c is omega (h - z), that of its square omega^2 (1 - z (h - z)); their
  // ratio rises from 1 at z = -inf to 2 at z = inf.
  const double wanted = second / (first * first);
  if (!(wanted > 1) || !(wanted < 2)) return {undefined, undefined};
  const auto ratio = [](double z) {
    const double rest = normal_hazard(z) - z;
    return (1 - z * rest) / (rest * rest);
  };
  constexpr double farthest = 20;  // beyond it the tail is exponential to a 400th
  if (wanted >= ratio(farthest)) return {undefined, undefined};
  const double least = -1 / std::sqrt(wanted - 1) - 1;
  const double z = root(least, farthest, [&](double x) { return wanted - ratio(x); });
  const double deviation = first / (normal_hazard(z) - z);
  return {c - z * deviation, deviation};
}

ThresholdFit fit_above(double moved, double sum_ln, double sum_ln2, double still, double threshold) {
  const double share = still / (still + moved);
  const LognormalFit plain = fit_lognormal(moved, sum_ln, sum_ln2);
  if (!(plain.omega > 0)) return {undefined, undefined, share, undefined};
  if (!(threshold > 0)) return {plain.lambda, plain.omega, share, 0};
  const double mean = sum_ln / moved, square = sum_ln2 / moved;
  const double c = std::log(threshold), first = mean - c, second = square - 2 * c * mean + c * c;
  const auto [lambda, omega] = fit_truncated(c, first, second);
  if (std::isnan(omega)) return {undefined, undefined, share, undefined};
  const double below = normal_cdf((c - lambda) / omega);
  if (share >= below) return {lambda, omega, (share - below) / (1 - below), below};
  return censored(moved, first, second, still, c);
}

}  // namespace freestand::fragility
