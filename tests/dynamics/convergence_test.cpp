// Errors fall with the tolerance as Settings promises: local error of the dimensionless state, one step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

CaseFamily smooth_family() {
  CaseFamily family;
  family.seed = 51;
  family.alpha_low = 0.15;
  family.alpha_high = 0.6;
  family.mu_low = 0.2;
  family.one_model = 0;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  family.excess_low = 1.5;
  return family;
}

double error_of(const Response& r, const Response& exact, const Block& block) {
  if (r.outcome != exact.outcome) return 1;
  return std::max({std::abs(r.peak_slip_m - exact.peak_slip_m) / block.size_m(),
                   std::abs(r.residual_slip_m - exact.residual_slip_m) / block.size_m(),
                   std::abs(r.peak_rotation_rad - exact.peak_rotation_rad)});
}

constexpr std::uint64_t samples = 100;

std::vector<Response> responses_at(double tolerance) {
  Settings settings;
  settings.tolerance = tolerance;
  std::vector<Response> responses;
  for (std::uint64_t number = 0; number < samples; ++number) {
    const RandomCase c = random_case(smooth_family(), number);
    responses.push_back(respond(c.specimen, c.shaking, settings));
  }
  return responses;
}

TEST(Convergence, DemandErrorsFallWithTheTolerance) {
  const std::vector<Response> exact = responses_at(1e-13);
  for (const Response& r : exact) ASSERT_TRUE(r.outcome <= Outcome::overturned);
  double before = 1;
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    const std::vector<Response> found = responses_at(tolerance);
    std::vector<double> errors;
    for (std::uint64_t i = 0; i < samples; ++i)
      errors.push_back(error_of(found[i], exact[i], random_case(smooth_family(), i).specimen.block));
    std::sort(errors.begin(), errors.end());
    std::printf("tolerance %.0e: error median %.1e, 90 %% %.1e, worst %.1e\n", tolerance, errors[50], errors[90],
                errors[99]);
    // Up to a few hundred steps and a few impacts, each of which may double what came before.
    EXPECT_LT(errors[50], 10 * tolerance);
    EXPECT_LT(errors[90], 1000 * tolerance);
    EXPECT_LT(errors[90], before);
    before = errors[90];
  }
}

}  // namespace
}  // namespace freestand::test
