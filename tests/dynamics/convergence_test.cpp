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

// A block that rocks under a steady push has no knot and no event in its way: the steps are the method's own. Steps of order N
// with local error equal to the tolerance make errors that fall with the tolerance to the power of 1 (forces, order N)
// to (N + 1)/N (state).
TEST(Convergence, ErrorOfTheStepsIsProportionalToTheTolerance) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.5, 2.0, 100);
  specimen.model = Model::rock;
  const FloorMotion push = piecewise_linear("push", 1.0, {0.27 * 9.80665, 0.27 * 9.80665});
  const auto rotation = [&](double tolerance) {
    History history;
    history.step_s = 0.9;
    respond(specimen, {&push}, {.tolerance = tolerance}, &history);
    return history.points.at(1).rotation_rad;
  };
  const double exact = rotation(1e-15);
  ASSERT_LT(exact, -0.05);
  std::vector<double> ln_tolerance, ln_error;
  for (double tolerance = 1e-4; tolerance > 1e-9; tolerance /= 10) {
    const double error = std::abs(rotation(tolerance) - exact);
    std::printf("tolerance %.0e: error %.2e rad\n", tolerance, error);
    ASSERT_LT(error, tolerance);
    ln_tolerance.push_back(std::log(tolerance));
    ln_error.push_back(std::log(error));
  }
  const double slope = (ln_error.front() - ln_error.back()) / (ln_tolerance.front() - ln_tolerance.back());
  EXPECT_GT(slope, 0.8);
  EXPECT_LT(slope, 1.4);
}

}  // namespace
}  // namespace freestand::test
