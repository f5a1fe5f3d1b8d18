#include "measurement/laboratory/sides.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

// Tests that moved and say where they ended: on the model's side, and all of them.
struct Sides {
  unsigned of_model = 0, all = 0;
  double p() const { return of_model > 0 ? gsl_cdf_binomial_Q(of_model - 1, 0.5, all) : 1; }
};

Sides sides(const Bench& bench, const ModelFit& fit) {
  Sides found;
  const double least = least_motion(bench, Channel::slip);
  for (const std::size_t i : tests_of(bench.data(), Role::calibration)) {
    const Test& test = bench.test(i);
    const Response model = predict(fit.model, test, fit.x).response;
    const double measured = test.peaks.residual_slip_m.value_or(0);
    if (!peaks_compare(test, model) || std::min(std::abs(measured), std::abs(model.residual_slip_m)) <= least) continue;
    found.of_model += measured * model.residual_slip_m > 0;
    ++found.all;
  }
  return found;
}

}  // namespace

std::string sides_turned_round(const Bench& bench, const ModelFit& base, double least_score, const Effort& effort,
                               const Jobs& jobs) {
  if (kind_of_set(bench) != Kind::peaks || !sides_are_known(bench.data())) return {};
  Dataset turned = bench.data();
  for (Test& test : turned.tests)
    if (auto& slip = test.peaks.residual_slip_m) *slip = -*slip;
  const Bench other(turned, 0);
  const ModelFit fit = fit_models(other, {{.model = base.model, .starts = {base.x}}}, effort, jobs)[0];
  const Sides found = sides(other, fit);
  if (fit.score >= least_score || found.p() > chance_level) return {};
  return fmt::format(
      "residual_slip_m looks turned round: with the other sign {} of {} tests end on the model's side, and it misses "
      "the peaks by {:.2g} (ln), by {:.2g} as they stand, and by {:.2g} with the best of all effects: check its sign "
      "against that of the floor",
      found.of_model, found.all, std::sqrt(fit.score), std::sqrt(base.score), std::sqrt(least_score));
}

}  // namespace freestand::measurement
