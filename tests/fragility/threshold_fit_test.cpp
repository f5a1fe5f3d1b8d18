#include "fragility/threshold_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fragility/draws.hpp"

namespace freestand::fragility {
namespace {

struct CutOff {
  std::vector<double> above;
  double still = 0, threshold;

  CutOff(std::size_t n, double lambda, double omega, double never, double at, std::uint64_t stream) : threshold(at) {
    const auto drawn = test::lognormals(n, lambda, omega, stream);
    for (std::size_t i = 0; i < n; ++i)
      if (test::uniform(i, stream + 1) < never || drawn[i] <= threshold) {
        ++still;
      } else {
        above.push_back(drawn[i]);
      }
  }
  ThresholdFit fit() const {
    double sum = 0, sum2 = 0;
    for (const double x : above) {
      sum += std::log(x);
      sum2 += std::log(x) * std::log(x);
    }
    return fit_above(static_cast<double>(above.size()), sum, sum2, still, threshold);
  }
  // The likelihood as it is written down, sample by sample.
  double likelihood(double lambda, double omega, double never) const {
    const auto below = 0.5 * std::erfc(-(std::log(threshold) - lambda) / omega / std::sqrt(2.0));
    double value = still * std::log(never + (1 - never) * below);
    for (const double x : above) {
      const double z = (std::log(x) - lambda) / omega;
      value += std::log(1 - never) - z * z / 2 - std::log(omega);
    }
    return value;
  }
};

void expect_maximum(const CutOff& sample) {
  const ThresholdFit fit = sample.fit();
  const double best = sample.likelihood(fit.lambda, fit.omega, fit.never);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_LT(sample.likelihood(fit.lambda + step, fit.omega, fit.never), best);
    EXPECT_LT(sample.likelihood(fit.lambda, fit.omega + step, fit.never), best);
    if (fit.never + step >= 0) {
      EXPECT_LT(sample.likelihood(fit.lambda, fit.omega, fit.never + step), best);
    }
  }
}

TEST(ThresholdFit, WithoutAThresholdIsThatOfTheMoments) {
  const ThresholdFit fit = fit_above(3, 3, 5, 1, 0);  // ln x = 0, 1, 2
  EXPECT_DOUBLE_EQ(fit.lambda, 1);
  EXPECT_DOUBLE_EQ(fit.omega, std::sqrt(2.0 / 3));
  EXPECT_DOUBLE_EQ(fit.never, 0.25);
  EXPECT_EQ(fit.below, 0);
}

TEST(ThresholdFit, FindsTheLognormalBelowWhichHalfIsHidden) {
  const CutOff more(20000, std::log(0.1), 0.6, 0.3, 0.08, 1), none(20000, std::log(0.1), 0.6, 0, 0.08, 3);
  for (const CutOff* sample : {&more, &none}) {
    const ThresholdFit fit = sample->fit();
    EXPECT_NEAR(fit.lambda, std::log(0.1), 0.08);
    EXPECT_NEAR(fit.omega, 0.6, 0.04);
    EXPECT_NEAR(fit.below, 0.355, 0.05);
    expect_maximum(*sample);
  }
  EXPECT_NEAR(more.fit().never, 0.3, 0.06);
  EXPECT_LT(none.fit().never, 0.06);
}

// Fewer are still than the truncated sample alone would have it: never = 0, and the count of the still ones is data.
TEST(ThresholdFit, IsCensoredWhereFewAreStill) {
  CutOff few(2000, 0, 0.5, 0, 0.8, 5);
  few.still *= 0.5;
  EXPECT_EQ(few.fit().never, 0);
  expect_maximum(few);
}

TEST(ThresholdFit, ATailThatNoLognormalHasIsNone) {
  // u = ln(x/c): one at 1e-3, one at 3: the mean's square is 2.25, the mean square 4.5.
  const double sum = 3.001, sum2 = 9.000001;
  EXPECT_TRUE(std::isnan(
      fit_above(2, 2 * std::log(0.1) + sum, 2 * std::pow(std::log(0.1), 2) + 2 * std::log(0.1) * sum + sum2, 5, 0.1)
          .omega));
  EXPECT_TRUE(std::isnan(fit_above(1, 0, 0, 5, 0.1).omega));
  EXPECT_TRUE(std::isnan(fit_above(5, 0, 0, 5, 0.1).omega));
}

TEST(ThresholdFit, FarAboveTheThresholdItIsThePlainOne) {
  const ThresholdFit fit = fit_above(3, 3, 5, 0, 1e-20), plain = fit_above(3, 3, 5, 0, 0);
  EXPECT_NEAR(fit.lambda, plain.lambda, 1e-9);
  EXPECT_NEAR(fit.omega, plain.omega, 1e-9);
}

}  // namespace
}  // namespace freestand::fragility
