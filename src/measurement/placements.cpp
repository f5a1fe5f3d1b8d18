#include "measurement/placements.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>

namespace freestand::measurement {
namespace {

constexpr int equal_parts = 9;

std::vector<double> width_factors(double scatter) {
  if (scatter <= 0) return {1.0};
  std::vector<double> factors;
  for (int k = 0; k < equal_parts; ++k)
    factors.push_back(std::exp(scatter * gsl_cdf_ugaussian_Pinv((k + 0.5) / equal_parts)));
  return factors;
}

}  // namespace

std::vector<double> overturning_probabilities(const Bench& bench, const std::vector<std::size_t>& tests,
                                              const ModelSpec& model, std::span<const double> x) {
  const auto factors = width_factors(model.placement_scatter ? model.placement_scatter->of(x) : 0);
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (const std::size_t i : tests)
    for (const double factor : factors) {
      specimens.push_back(specimen(model, bench.test(i), x));
      specimens.back().block.left_m *= factor;
      specimens.back().block.right_m *= factor;
      shakings.push_back(bench.test(i).shaking());
    }
  std::vector<Response> responses(specimens.size());
  respond_batch(specimens, shakings, {.tolerance = 1e-8}, responses);
  std::vector<double> shares(tests.size());
  for (std::size_t k = 0; k < responses.size(); ++k)
    if (responses[k].outcome == Outcome::overturned)
      shares[k / factors.size()] += 1.0 / static_cast<double>(factors.size());
  return shares;
}

}  // namespace freestand::measurement
