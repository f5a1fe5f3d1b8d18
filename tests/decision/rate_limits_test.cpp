// Limits of rates, against closed forms under a hazard that is one power of the intensity.
#include "decision/rate_limits.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>

namespace freestand::decision {
namespace {

using fragility::FragilityFunction;

constexpr double slope = 2, whole = 0.4;

double power_law_rate(const LognormalFragility& f) {
  return 1e-3 * std::pow(f.median, -slope) * std::exp(0.5 * std::pow(slope * f.dispersion, 2));
}

struct Made {
  FragilityFunction f;
  fragility::Result result;
  std::vector<double> rates;
  double median_variance, square_variance;

  Made() {
    f.median = 0.6;
    f.dispersion = whole;
    std::vector<double> ln_median, square;
    for (const double off : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
      f.left_out_median.push_back(0.6 * std::exp(0.02 * off));
      f.left_out_dispersion.push_back(whole + 0.01 * (off * off - 2));
      ln_median.push_back(std::log(f.left_out_median.back()));
      square.push_back(std::pow(f.left_out_dispersion.back(), 2));
      rates.push_back(power_law_rate({f.left_out_median.back(), f.left_out_dispersion.back()}));
    }
    result.left_out_records = 5;
    result.motions = 5;
    median_variance = fragility::jackknife_variance(ln_median);
    square_variance = fragility::jackknife_variance(square);
  }
};

// ln rate = constant - k ln median + k^2 dispersion^2/2, so that each of the two reaches alone as far as its own limit.
TEST(CurveReach, JoinsStudentsLimitsOfTheMedianWithChiSquaresOfTheDispersion) {
  const Made made;
  const CurveReach reach(made.f, made.result, power_law_rate);
  ASSERT_TRUE(reach.known());
  const double freedom = 2 * std::pow(whole, 4) / made.square_variance,
               by_median = slope * gsl_cdf_tdist_Qinv(0.05, 4) * std::sqrt(made.median_variance);
  const auto by_dispersion = [&](double p) {
    return 0.5 * slope * slope * whole * whole * std::fabs(freedom / gsl_cdf_chisq_Pinv(p, freedom) - 1);
  };
  EXPECT_NEAR(reach.above(0.05), std::hypot(by_median, by_dispersion(0.05)), 1e-9);
  EXPECT_NEAR(reach.below(0.05), std::hypot(by_median, by_dispersion(0.95)), 1e-9);
  EXPECT_GT(reach.above(0.05), 1.05 * reach.below(0.05));
  EXPECT_EQ(reach.above(0.9), -reach.below(0.1));  // a limit that 9 in 10 lie beyond
  EXPECT_TRUE(std::isfinite(reach.above(0)));
}

// Where the records reach down to about the median, a larger one comes with a larger dispersion, or a smaller one: their errors in ln rate
// take from each other, or add. Of five groups whose numbers go together wholly 1 - 1/4 of that counts.
TEST(CurveReach, IsThatOfARateWhoseMedianAndDispersionErrTogether) {
  for (const double sign : {1.0, -1.0}) {
    Made made;
    std::vector<double> ln_rate, square;
    for (std::size_t g = 0; g < 5; ++g) {
      made.f.left_out_dispersion[g] = whole + sign * 0.01 * (static_cast<double>(g) - 2);
      square.push_back(std::pow(made.f.left_out_dispersion[g], 2));
      ln_rate.push_back(std::log(power_law_rate({made.f.left_out_median[g], made.f.left_out_dispersion[g]})));
    }
    const double alone = slope * slope * made.median_variance +
                         std::pow(slope, 4) / 4 * fragility::jackknife_variance(square),
                 together = fragility::jackknife_variance(ln_rate);
    const CurveReach reach(made.f, made.result, power_law_rate);
    const double freedom = 2 * std::pow(whole, 4) / fragility::jackknife_variance(square);
    const double by_median = slope * gsl_cdf_tdist_Qinv(0.05, 4) * std::sqrt(made.median_variance),
                 by_dispersion =
                     0.5 * slope * slope * whole * whole * std::fabs(freedom / gsl_cdf_chisq_Pinv(0.05, freedom) - 1);
    EXPECT_NEAR(reach.above(0.05), std::hypot(by_median, by_dispersion) * std::sqrt(1 + 0.75 * (together / alone - 1)),
                1e-4);
    EXPECT_EQ(together < alone, (sign > 0));
  }
}

// A dispersion that hardly differs from sample to sample has limits close by, at once: GSL's sums of so many degrees of freedom have
// no end.
TEST(CurveReach, OfADispersionThatHardlyDiffersIsThatOfTheMedian) {
  Made made;
  for (double& d : made.f.left_out_dispersion) d = whole + 1e-12 * (d - whole);
  const CurveReach reach(made.f, made.result, power_law_rate);
  ASSERT_TRUE(reach.known());
  const double by_median = slope * gsl_cdf_tdist_Qinv(0.05, 4) * std::sqrt(made.median_variance);
  EXPECT_NEAR(reach.above(0.05), by_median, 1e-9);
  EXPECT_NEAR(reach.below(0.05), by_median, 1e-9);
}

// The approximation for many degrees of freedom joins what is summed for fewer.
TEST(CurveReach, IsContinuousInTheDegreesOfFreedom) {
  const auto above = [](double spread) {
    Made made;
    for (double& d : made.f.left_out_dispersion) d = whole + spread * (d - whole);
    return CurveReach(made.f, made.result, power_law_rate).above(0.05);
  };
  Made made;
  const double spread =
      std::sqrt(2 * std::pow(whole, 4) / made.square_variance / 1000);  // about 1000 degrees of freedom
  double before = above(1.02 * spread);
  for (double share = 1.019; share > 0.98; share -= 0.001) {
    const double here = above(share * spread);
    EXPECT_NEAR(here, before, 2e-4) << share;
    before = here;
  }
}

TEST(CurveReach, IsUnknownWithoutACurve) {
  Made scattered;
  for (double& d : scattered.f.left_out_dispersion) d = whole + 40 * (d - whole);
  EXPECT_FALSE(
      CurveReach(scattered.f, scattered.result, power_law_rate).known());  // nor where the dispersion is hardly known
  Made made;
  made.f.left_out_median[2] = fragility::unknown;
  EXPECT_FALSE(CurveReach(made.f, made.result, power_law_rate).known());
  EXPECT_FALSE(CurveReach({}, made.result, power_law_rate).known());
}

// A rate that scatters twice as far in its logarithm as the curve's reaches twice as far, as askew.
TEST(RateLimits, ScatterAsTheirOwnRatesAndAsAskewAsTheCurve) {
  const Made made;
  const CurveReach reach(made.f, made.result, power_law_rate);
  std::vector<double> twice;
  for (const double rate : made.rates) twice.push_back(rate * rate);
  const RateLimits limits(3, twice, {}, made.result, reach);
  EXPECT_NEAR(std::log(limits.upper(0.05) / 3), 2 * reach.above(0.05), 1e-9);
  EXPECT_NEAR(std::log(3 / limits.lower(0.05)), 2 * reach.below(0.05), 1e-9);
}

TEST(RateLimits, WithoutACurveAreThoseOfTheLogarithm) {
  const Made made;
  const CurveReach none({}, made.result, power_law_rate);
  const RateLimits limits(3, made.rates, {}, made.result, none);
  EXPECT_NEAR(limits.upper(0.05) * limits.lower(0.05), 9, 1e-9);
}

}  // namespace
}  // namespace freestand::decision
