// An offset is found beside shaking, and shaking alone is not taken for one.
#include "motion/offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"

namespace freestand::motion {
namespace {

// A sin(w t) over whole periods, and a constant.
FloorMotion shaken(double constant_mps2) {
  std::vector<double> values;
  for (int i = 0; i <= 2000; ++i) values.push_back(2 * std::sin(2 * pi * 0.01 * i) + constant_mps2);
  return piecewise_linear("x", 0.01, values);
}

// Velocity 2/w (1 - cos w t): a straight line from 0 through it has the slope 3/T^3 integral(t v) = 3/(w T), whose speed at
// the end, 3/w, is below what is left, about 4/w - 3/w at the first crest of T = 20 periods.
TEST(Offset, ShakingAloneHasNone) {
  const Offset found = offset(shaken(0));
  const double w = 2 * pi;
  EXPECT_NEAR(found.acceleration_mps2, 3 / (w * 20), 1e-3);
  EXPECT_NEAR(found.leaving_mps, 3 / w, 0.02);
  EXPECT_NEAR(found.shaking_mps, 4 / w, 0.1 / w);
  EXPECT_FALSE(found.doubtful());
}

TEST(Offset, AConstantIsFoundBesideTheShaking) {
  const Offset found = offset(shaken(3));
  EXPECT_NEAR(found.acceleration_mps2, 3 + 3 / (2 * pi * 20), 1e-3);
  EXPECT_NEAR(found.leaving_mps, 60, 1);
  EXPECT_LT(found.shaking_mps, 1);
  EXPECT_TRUE(found.doubtful());
}

}  // namespace
}  // namespace freestand::motion
