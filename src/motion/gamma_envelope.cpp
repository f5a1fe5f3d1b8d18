#include "motion/gamma_envelope.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <freestand/error.hpp>
#include <memory>

#include "base/units.hpp"

namespace freestand::motion {
namespace {

constexpr double least_shape = 1, greatest_shape = 1e4;  // the latter: shaking for a 30th of the time of its middle

double quantile(double share, double shape) { return gsl_cdf_gamma_Pinv(share, shape, 1); }

// Duration over middle; falls as the shape grows.
double duration_over_middle(double shape) {
  return (quantile(0.95, shape) - quantile(0.05, shape)) / quantile(0.45, shape);
}

double shape_of(double ratio) {
  const auto above = [](double log_shape, void* wanted) {
    return duration_over_middle(std::exp(log_shape)) - *static_cast<double*>(wanted);
  };
  gsl_function function{above, &ratio};
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &function, std::log(least_shape), std::log(greatest_shape));
  for (int step = 0; step < 100; ++step) {
    gsl_root_fsolver_iterate(solver.get());
    const double low = gsl_root_fsolver_x_lower(solver.get()), high = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(low, high, 1e-13, 0) == GSL_SUCCESS) break;
  }
  return std::exp(gsl_root_fsolver_root(solver.get()));
}

}  // namespace

GammaEnvelope::GammaEnvelope(double arias_mps, double duration_s, double middle_s) {
  const double ratio = duration_s / middle_s, longest = duration_over_middle(least_shape),
               shortest = duration_over_middle(greatest_shape);
  if (!(ratio > shortest && ratio < longest))
    throw Error(fmt::format(
        "a shaking of {:g} s with its middle at {:g} s (the envelope t^(a2-1) exp(-a3 t) lasts between {:.3g} and "
        "{:.3g} times the time of its middle): {} middle_s",
        duration_s, middle_s, shortest, longest, ratio >= longest ? "raise" : "lower"));
  shape_ = shape_of(ratio);
  rate_ = quantile(0.45, shape_) / middle_s;
  // The integral of t^(k-1) exp(-r t) is Gamma(k) / r^k.
  const double squared = 2 * standard_gravity_mps2 / pi * arias_mps;
  log_squared_ = std::log(squared) + shape_ * std::log(rate_) - std::lgamma(shape_);
}

double GammaEnvelope::operator()(double t_s) const {
  return t_s > 0 ? std::exp((log_squared_ + (shape_ - 1) * std::log(t_s) - rate_ * t_s) / 2) : 0;
}

double GammaEnvelope::time_of_share(double share) const { return quantile(share, shape_) / rate_; }

}  // namespace freestand::motion
