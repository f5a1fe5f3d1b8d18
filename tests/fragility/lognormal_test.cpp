#include "fragility/lognormal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>
#include <limits>

#include "fragility/draws.hpp"

namespace freestand::fragility {
namespace {

using test::lognormals;
const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Lognormal, FitOfThreeSamplesByHand) {
  // ln x = 0, 1, 5: mean 2, squares 4 + 1 + 9 = 14.
  const std::vector<double> x{1, std::exp(1.0), std::exp(5.0)};
  const LognormalFit fit = fit_lognormal(x);
  EXPECT_NEAR(fit.lambda, 2, 1e-14);
  EXPECT_NEAR(fit.omega, std::sqrt(14.0 / 3), 1e-14);
  EXPECT_NEAR(fit.lambda_se, std::sqrt(7.0 / 3), 1e-14);  // s^2 = 7
  EXPECT_NEAR(fit.omega_se, std::sqrt(7.0 / 4), 1e-14);
  EXPECT_NEAR(fit.mean, std::exp(2 + 7.0 / 3), 1e-10);
  EXPECT_NEAR(fit.standard_deviation / fit.mean, std::sqrt(std::exp(14.0 / 3) - 1), 1e-12);

  const LognormalFit from_sums = fit_lognormal(3, 6, 26);
  EXPECT_NEAR(from_sums.lambda, fit.lambda, 1e-14);
  EXPECT_NEAR(from_sums.omega, fit.omega, 1e-13);
}

TEST(Lognormal, LikelihoodIsLargestAtTheFit) {
  const auto x = lognormals(40, 0.3, 0.6, 1);
  const LognormalFit fit = fit_lognormal(x);
  const auto log_likelihood = [&](double lambda, double omega) {
    double sum = 0;
    for (const double v : x) sum += -std::log(omega) - std::pow((std::log(v) - lambda) / omega, 2) / 2;
    return sum;
  };
  const double best = log_likelihood(fit.lambda, fit.omega);
  for (const double step : {-0.01, 0.01}) {
    EXPECT_LT(log_likelihood(fit.lambda + step, fit.omega), best);
    EXPECT_LT(log_likelihood(fit.lambda, fit.omega + step), best);
  }
}

TEST(Lognormal, RefusesWhatHasNoLogarithm) {
  EXPECT_THROW(fit_lognormal(std::vector<double>{1, 0, 2}), Error);
  EXPECT_THROW(fit_lognormal(std::vector<double>{1, std::nan(""), 2}), Error);
  EXPECT_TRUE(std::isnan(fit_lognormal(std::vector<double>{2}).lambda));
}

struct Repeats {
  double lambda_bias = 0, omega_ratio = 0;  // mean of (estimate - truth)/omega, of estimate/truth
  double lambda_covered = 0, omega_covered = 0, lambda_se_covered = 0, omega_se_covered = 0;
};

Repeats thousand_repeats(std::size_t n) {
  constexpr double lambda = -0.7, omega = 0.8;
  constexpr int repeats = 1000;
  Repeats result;
  const auto inside = [](const Interval& i, double truth) {
    return i.lower <= truth && truth <= i.upper ? 1.0 / repeats : 0;
  };
  for (int r = 0; r < repeats; ++r) {
    const auto fit = fit_lognormal(lognormals(n, lambda, omega, 1000 * n + static_cast<std::uint64_t>(r)));
    result.lambda_bias += (fit.lambda - lambda) / omega / repeats;
    result.omega_ratio += fit.omega / omega / repeats;
    result.lambda_covered += inside(lambda_interval(fit, 0.95), lambda);
    result.omega_covered += inside(omega_interval(fit, 0.95), omega);
    result.lambda_se_covered += std::fabs(fit.lambda - lambda) < 1.96 * fit.lambda_se ? 1.0 / repeats : 0;
    result.omega_se_covered += std::fabs(fit.omega - omega) < 1.96 * fit.omega_se ? 1.0 / repeats : 0;
  }
  return result;
}

// Over 1000 repeats the share of covering 95 % intervals has standard deviation 0.007.
TEST(Lognormal, BiasAndCoverageOverThousandRepeats) {
  for (const std::size_t n : {10, 30, 200}) {
    const Repeats found = thousand_repeats(n);
    const double size = static_cast<double>(n);
    RecordProperty("lambda_bias_" + std::to_string(n), std::to_string(found.lambda_bias));
    RecordProperty("omega_ratio_" + std::to_string(n), std::to_string(found.omega_ratio));
    RecordProperty("lambda_covered_" + std::to_string(n), std::to_string(found.lambda_covered));
    RecordProperty("omega_covered_" + std::to_string(n), std::to_string(found.omega_covered));
    EXPECT_NEAR(found.lambda_bias, 0, 4 / std::sqrt(1000 * size));
    EXPECT_NEAR(found.omega_ratio, 1 - 0.75 / size, 4 / std::sqrt(2000 * size));
    EXPECT_NEAR(found.lambda_covered, 0.95, 0.025);
    EXPECT_NEAR(found.omega_covered, 0.95, 0.025);
  }
}

TEST(Lognormal, StandardErrorsCoverInLargeSamples) {
  const Repeats found = thousand_repeats(200);
  EXPECT_NEAR(found.lambda_se_covered, 0.95, 0.025);
  EXPECT_NEAR(found.omega_se_covered, 0.95, 0.025);
}

TEST(Lognormal, MomentsAndParametersAreInverse) {
  const auto [lambda, omega] = lognormal_from_moments(1.206, 0.738);
  EXPECT_NEAR(std::exp(lambda + omega * omega / 2), 1.206, 1e-14);
  EXPECT_NEAR(std::sqrt(std::expm1(omega * omega)) * 1.206, 0.738, 1e-14);
}

TEST(Lognormal, ThreePartExceedance) {
  // Median capacity: half of the moved ones exceed it. 0.1 + 0.9 * 0.8 * 0.5.
  EXPECT_NEAR(three_part_exceedance(0.1, 0.2, std::log(3.0), 0.5, 3.0), 0.46, 1e-15);
  EXPECT_EQ(three_part_exceedance(1, 0, nan, nan, 2), 1);
  EXPECT_EQ(three_part_exceedance(0.25, 1, nan, nan, 2), 0.25);
  // The normal tail at 1.959963984540054.
  EXPECT_NEAR(three_part_exceedance(0, 0, 0, 1, std::exp(1.959963984540054)), 0.025, 1e-15);
}

}  // namespace
}  // namespace freestand::fragility
