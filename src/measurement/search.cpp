#include "measurement/search.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace freestand::measurement {

double to_unit(const Free& free, double x) {
  if (free.logarithmic) return std::log(std::max(x, 1e-300) / free.low) / std::log(free.high / free.low);
  return (x - free.low) / (free.high - free.low);
}

double from_unit(const Free& free, double z) {
  const double x =
      free.logarithmic ? free.low * std::pow(free.high / free.low, z) : free.low + z * (free.high - free.low);
  return std::clamp(x, free.lower, free.upper);
}

namespace {

struct Search {
  const std::vector<Free>& free;
  const Objective& objective;
  Fitted best;

  Values point(const gsl_vector* z) const {
    Values x;
    for (std::size_t i = 0; i < free.size(); ++i) x.push_back(from_unit(free[i], gsl_vector_get(z, i)));
    return x;
  }

  // Beyond the bounds the objective is that of the nearest point within, and a slope back.
  double operator()(const gsl_vector* z) {
    const Values x = point(z);
    double outside = 0;
    for (std::size_t i = 0; i < free.size(); ++i) outside += std::abs(gsl_vector_get(z, i) - to_unit(free[i], x[i]));
    const double score = objective(x) + outside;
    ++best.evaluations;
    if (std::isfinite(score) && score < best.score) best.score = score, best.x = x;
    return std::isfinite(score) ? score : 1e6;
  }
};

double evaluate(const gsl_vector* z, void* search) { return (*static_cast<Search*>(search))(z); }

using Vector = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;
using Minimiser = std::unique_ptr<gsl_multimin_fminimizer, decltype(&gsl_multimin_fminimizer_free)>;

// One descent with a fresh simplex around the best point so far.
void descend(Search& search, double step, int budget) {
  const std::size_t n = search.free.size();
  Vector z(gsl_vector_alloc(n), gsl_vector_free), steps(gsl_vector_alloc(n), gsl_vector_free);
  for (std::size_t i = 0; i < n; ++i) {
    gsl_vector_set(z.get(), i, to_unit(search.free[i], search.best.x[i]));
    // Inwards, where a bound is near.
    const double beyond = gsl_vector_get(z.get(), i) + step;
    const bool inside = std::abs(to_unit(search.free[i], from_unit(search.free[i], beyond)) - beyond) < 1e-9;
    gsl_vector_set(steps.get(), i, inside ? step : -step);
  }
  gsl_multimin_function function{evaluate, n, &search};
  Minimiser minimiser(gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, n),
                      gsl_multimin_fminimizer_free);
  gsl_multimin_fminimizer_set(minimiser.get(), &function, z.get(), steps.get());
  const int limit = search.best.evaluations + budget;
  double before = search.best.score;
  int still = 0;
  while (search.best.evaluations < limit && still < 12) {
    if (gsl_multimin_fminimizer_iterate(minimiser.get())) break;
    if (gsl_multimin_test_size(gsl_multimin_fminimizer_size(minimiser.get()), 1e-4) == GSL_SUCCESS) break;
    still = search.best.score < before - 1e-4 ? 0 : still + 1;
    before = std::min(before, search.best.score);
  }
}

bool far(const Values& a, const Values& b, const std::vector<Free>& free) {
  double most = 0;
  for (std::size_t i = 0; i < free.size(); ++i)
    most = std::max(most, std::abs(to_unit(free[i], a[i]) - to_unit(free[i], b[i])));
  return most > 0.1;
}

}  // namespace

std::vector<Values> sobol_starts(const std::vector<Free>& free, std::size_t count) {
  std::vector<Values> points;
  if (free.empty()) return {Values{}};
  const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(free.size())), gsl_qrng_free);
  Values z(free.size());
  for (std::size_t k = 0; k < count; ++k) {
    gsl_qrng_get(sequence.get(), z.data());
    Values x;
    for (std::size_t i = 0; i < free.size(); ++i) x.push_back(from_unit(free[i], z[i]));
    points.push_back(std::move(x));
  }
  return points;
}

std::vector<Fitted> best_apart(const std::vector<Values>& points, const std::vector<double>& scores,
                               const std::vector<Free>& free, std::size_t keep) {
  std::vector<Fitted> all, kept;
  for (std::size_t i = 0; i < points.size(); ++i) all.push_back({points[i], scores[i], 1});
  std::stable_sort(all.begin(), all.end(), [](const Fitted& a, const Fitted& b) { return a.score < b.score; });
  for (const Fitted& one : all) {
    const bool alike = std::any_of(kept.begin(), kept.end(), [&](const Fitted& k) { return !far(one.x, k.x, free); });
    if (!alike) kept.push_back(one);
    if (kept.size() == keep) break;
  }
  return kept;
}

Fitted simplex(const std::vector<Free>& free, const Objective& objective, const Values& x, double step, int budget) {
  Search search{free, objective, {x, objective(x), 1}};
  if (free.empty()) return search.best;
  gsl_error_handler_t* const handler = gsl_set_error_handler_off();
  descend(search, step, budget * 2 / 3);
  descend(search, step / 4, budget - search.best.evaluations);
  gsl_set_error_handler(handler);
  return search.best;
}

}  // namespace freestand::measurement
