#include "fragility/intervals.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fragility/draws.hpp"

namespace freestand::fragility {
namespace {

TEST(ClopperPearson, KnownValues) {
  // From tables of the exact binomial interval, 95 %.
  struct Case {
    std::int64_t hits, trials;
    double lower, upper;
  };
  for (const auto& c :
       {Case{0, 10, 0, 0.30849710781876}, Case{1, 10, 0.00252857854446178, 0.445016117028195},
        Case{5, 10, 0.187086028447398, 0.812913971552602}, Case{10, 10, 0.69150289218124, 1},
        Case{50, 100, 0.398321129504396, 0.601678870495604}, Case{4, 20, 0.0573339970502, 0.4366140030}}) {
    const Interval found = clopper_pearson(c.hits, c.trials, 0.95);
    EXPECT_NEAR(found.lower, c.lower, 1e-9) << c.hits << "/" << c.trials;
    EXPECT_NEAR(found.upper, c.upper, 1e-9) << c.hits << "/" << c.trials;
  }
  const Interval nothing = clopper_pearson(0, 0, 0.95);
  EXPECT_EQ(nothing.lower, 0);
  EXPECT_EQ(nothing.upper, 1);
}

TEST(ClopperPearson, CoversAtLeastAsPromised) {
  constexpr unsigned n = 25;
  for (double p = 0.01; p < 1; p += 0.01) {
    double covered = 0;
    for (unsigned k = 0; k <= n; ++k) {
      const Interval found = clopper_pearson(k, n, 0.9);
      if (found.lower <= p && p <= found.upper) covered += gsl_ran_binomial_pdf(k, p, n);
    }
    EXPECT_GE(covered, 0.9 - 1e-12) << p;
  }
}

TEST(ClopperPearson, StaysSmoothWhereTheScoreIntervalTakesOver) {
  const std::int64_t n = 1000000;
  const Interval below = clopper_pearson(100000, n, 0.95), above = clopper_pearson(100001, n, 0.95);
  const double width = below.upper - below.lower;
  EXPECT_NEAR(above.lower - below.lower, 1e-6, 1e-3 * width);
  EXPECT_NEAR(above.upper - below.upper, 1e-6, 1e-3 * width);
  const Interval huge = clopper_pearson(500000000, 1000000000, 0.95);
  EXPECT_NEAR(huge.upper - huge.lower, 2 * 1.959964 * std::sqrt(0.25e-9), 1e-8);
}

TEST(PercentileInterval, IsWiderForFewGroups) {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(i / 1000.0);
  values.push_back(std::numeric_limits<double>::quiet_NaN());
  // The estimate is the median of the values, to half a value in a thousand: no bias to correct.
  const Interval many = percentile_interval(values, 0.5, 0.95, 100000), few = percentile_interval(values, 0.5, 0.95, 8);
  EXPECT_NEAR(many.lower, 0.025, 3e-4);
  EXPECT_NEAR(many.upper, 0.975, 3e-4);
  // t(7) = 2.364624, times sqrt(8/7) = 2.527889: tail 0.005738.
  EXPECT_NEAR(few.lower, 0.005738, 1e-4);
  EXPECT_TRUE(std::isnan(percentile_interval(values, 0.5, 0.95, 1).lower));
}

TEST(PercentileInterval, MedianBiasMovesBothEnds) {
  std::vector<double> values;
  for (int i = 0; i <= 100000; ++i) values.push_back(i / 100000.0);
  // Share below the estimate 0.6915 = Phi(0.5): ends at Phi(1 -+ 1.959964).
  const Interval interval = percentile_interval(values, 0.691462, 0.95, 1000000);
  EXPECT_NEAR(interval.lower, 0.168538, 1e-4);
  EXPECT_NEAR(interval.upper, 0.998461, 1e-4);
}

// Limits of a normal number, at(t) = z(t): a limit at z(0.01) leaves 0.04 of a tail of 0.05, one at z(0.05) nothing, one out of reach all.
TEST(UnusedTail, IsWhatALimitThatWasMovedOutwardsDoesNotNeed) {
  const auto above = [](double t) { return gsl_cdf_ugaussian_Qinv(t); };
  const auto below = [](double t) { return gsl_cdf_ugaussian_Pinv(t); };
  EXPECT_NEAR(unused_tail(0.05, +1, above, above(0.01)), 0.04, 1e-4);
  EXPECT_NEAR(unused_tail(0.05, -1, below, below(0.01)), 0.04, 1e-4);
  EXPECT_EQ(unused_tail(0.05, +1, above, above(0.05)), 0);
  EXPECT_EQ(unused_tail(0.05, -1, below, below(0.2)), 0);
  EXPECT_EQ(unused_tail(0.05, +1, above, 100), 0.05);
}

TEST(BenjaminiHochberg, ExampleOfTheirPaper) {
  // Benjamini & Hochberg (1995), section 3.1: 15 p values, the four smallest rejected at 0.05.
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0};
  const auto rejected = benjamini_hochberg(p, 0.05);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(rejected[i], i < 4) << i;
}

TEST(BenjaminiHochberg, LeavesOutUnknownAndKeepsOrder) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto rejected = benjamini_hochberg({0.5, nan, 0.02, 0.024}, 0.05);
  EXPECT_EQ(rejected, (std::vector<bool>{false, false, true, true}));  // 0.024 <= 0.05 * 2/3
}

}  // namespace
}  // namespace freestand::fragility
