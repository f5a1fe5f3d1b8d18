// What neither the sweep nor the hazard curve reaches.
#include <gmock/gmock.h>

#include <cmath>
#include <freestand/error.hpp>
#include <numeric>

#include "decision/risk.hpp"
#include "made_sweep.hpp"
#include "support/error_text.hpp"

namespace freestand::decision::risk_reach_test {
namespace {

using namespace made_sweep;
using testing::HasSubstr;

// By counts, where the hazard curve begins at an intensity that was swept, and shares below it are known.
TEST(RiskReach, CountsMissWhatTheHazardCurveBeginsAfter) {
  const fragility::Result result = half_that_overturn().fit(3, 200);
  const double whole = risk(result, power_law(1e-4, 2, 0.01, 30)).rows.at(0).by_counts.value;
  for (const double start : {0.2, 0.3, 0.6}) {
    const RiskRow row = risk(result, power_law(1e-4, 2, start, 30)).rows.at(0);
    ASSERT_EQ(row.recommended, By::counts);
    EXPECT_NEAR(row.outside_hazard, 1 - row.by_counts.value / whole, 0.01) << start;
    EXPECT_EQ(row.refused.empty(), row.outside_hazard <= 0.5) << row.refused;
    EXPECT_GE(row.outside_sweep, 0);
  }
}

// A hazard curve that hardly falls, and ends where everything exceeds: most of the rate comes from beyond its end.
TEST(RiskReach, HalfOfTheRateMayComeFromBeyondTheHazardCurve) {
  Sweep sweep;
  sweep.records = 400;
  sweep.median = 0.3;
  const fragility::Result result = sweep.fit(3, 100);
  const RiskRow flat = risk(result, power_law(1e-3, 0.1, 0.05, 2)).rows.at(0);
  EXPECT_EQ(flat.median_im, HUGE_VAL);
  EXPECT_NEAR(std::accumulate(flat.share.begin(), flat.share.end(), 0.0), 1, 1e-9);
  EXPECT_LT(risk(result, power_law(1e-3, 2, 0.05, 2)).rows.at(0).median_im, 1);
}

// Nothing exceeded as far as was swept, and most events are stronger.
TEST(RiskReach, NothingCountedSaysNothingOfStrongerEvents) {
  Sweep sweep;
  sweep.median = 1e6;
  sweep.most = 0.2;
  const fragility::Result result = sweep.fit(3, 100);
  const RiskRow beyond = risk(result, power_law(1e-3, 0.5, 0.01, 20)).rows.at(0);
  EXPECT_THAT(beyond.refused, HasSubstr("no sample exceeds it, and"));
  EXPECT_THAT(beyond.refused, HasSubstr("outside of the sweep"));
  EXPECT_EQ(risk(result, power_law(1e-3, 6, 0.01, 20)).rows.at(0).refused, "");
  // Nor of weaker ones, where the hazard curve begins among those that were swept.
  sweep.most = 3;
  const RiskRow late = risk(sweep.fit(3, 100), power_law(1e-3, 2, 0.3, 20)).rows.at(0);
  EXPECT_THAT(late.refused, HasSubstr("outside of the hazard curve"));
}

// Bins in which no sample lies.
TEST(RiskReach, AFitWithoutASampleInItsBinsIsRefused) {
  fragility::Result result = Sweep{}.fit(3, 50);
  result.overturning.im_least = result.overturning.im_most = fragility::unknown;
  EXPECT_THAT(test::error_text(Exit::usage, [&] { risk(result, power_law(1e-3, 2, 0.01, 20)); }),
              HasSubstr("no sample of the sweep lies in a bin"));
}

}  // namespace
}  // namespace freestand::decision::risk_reach_test
