// Rates at the ends of what is known, and of events that hold one another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "decision/risk.hpp"
#include "made_sweep.hpp"

namespace freestand::decision::risk_order_test {
namespace {

using namespace made_sweep;
using testing::HasSubstr;

// A hazard curve that ends where nothing is exceeded yet says nothing of what the sweep exceeds above it: no rate of 0.
TEST(Risk, IsNotToldWhereTheHazardCurveEndsBelowAllThatExceeds) {
  Sweep sweep;
  sweep.median = 1.5;
  const Risk found = risk(sweep.fit(1, 2), power_law(1e-3, 1.5, 0.06, 0.2));
  EXPECT_THAT(found.rows[0].refused, HasSubstr("outside of the hazard curve"));
  EXPECT_THAT(found.warnings, testing::Not(testing::Contains(HasSubstr("no sample exceeds it"))));
}

// Each capacity bends by a curve of its own, but the graver event is not the likelier one.
TEST(Risk, OfNestedEventsTheInnerOneHasNoHigherRate) {
  Sweep sweep;
  fragility::Result result = sweep.fit(2, 2);
  fragility::EdpResult outer = result.edps[0];
  outer.name = "peak_slip_m";
  outer.binary = false;
  outer.capacity = {0.1};
  for (double& p : outer.surface.empirical) p *= 0.9;  // contradicts, as two fits may
  outer.functions[0].adequate = result.edps[0].functions[0].adequate = false;
  result.edps.insert(result.edps.begin(), outer);
  const Risk found = risk(result, power_law(1e-3, 1.5, 1e-3, 50), {"peak_slip_m"});
  EXPECT_EQ(found.rows[1].rate().value, found.rows[0].rate().value);
  EXPECT_LE(found.rows[1].rate().lower, found.rows[1].rate().value);
  EXPECT_THAT(found.rows[1].why, HasSubstr("its rate is that of peak_slip_m > 0.1"));
}

}  // namespace
}  // namespace freestand::decision::risk_order_test
