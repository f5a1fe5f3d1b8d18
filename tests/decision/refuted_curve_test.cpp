// Rates where no lognormal curve is that of the counts.
#include <gtest/gtest.h>

#include <cmath>

#include "decision/risk.hpp"
#include "made_sweep.hpp"

namespace freestand::decision::refuted_curve_test {
namespace {

using namespace made_sweep;

// Half of the blocks overturn at 0.21 g, the others at 0.7 g, each nearly at once: within a bin the probability leaps, where the hazard falls by
// two thirds. The bins alone do not tell at which end of the bin: by them and the fitted curve the rate is 1.09 times the true one.
TEST(RefutedCurve, RatesFollowTheFineCellsWithinBins) {
  Sweep sweep;
  sweep.records = 4000, sweep.per_record = 10;
  sweep.between = sweep.within = 0.02;
  sweep.median = 0.7, sweep.weak = 0.5;
  constexpr double k0 = 1e-3, k = 2.5;
  const double spread = std::exp(k * k * sweep.dispersion() * sweep.dispersion() / 2);
  const double truth = k0 * spread * (0.5 * std::pow(0.3 * sweep.median, -k) + 0.5 * std::pow(sweep.median, -k));
  const Risk found = risk(sweep.fit(1, 100), power_law(k0, k, 1e-3, 50));
  ASSERT_EQ(found.rows[0].recommended, By::counts);
  const Rate& rate = found.rows[0].rate();
  EXPECT_NEAR(rate.value / truth, 1, 0.03);
  EXPECT_LT(rate.lower, truth);
  EXPECT_GT(rate.upper, truth);
}

}  // namespace
}  // namespace freestand::decision::refuted_curve_test
