#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>
#include <freestand/floor_motion.hpp>

namespace freestand {
namespace {

TEST(FloorMotion, PiecewiseLinearPassesThroughItsSamplesAndIsStillAfterwards) {
  const FloorMotion motion = piecewise_linear("ramp", 0.5, {0.0, 1.0, -1.0});
  const Shaking shaking{&motion, 2.0, 1.0, 0.0};
  EXPECT_DOUBLE_EQ(horizontal_acceleration(shaking, 0.25), 1.0);
  EXPECT_DOUBLE_EQ(horizontal_acceleration(shaking, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(horizontal_acceleration(shaking, 0.75), 0.0);
  EXPECT_DOUBLE_EQ(horizontal_acceleration(shaking, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(horizontal_acceleration(shaking, 7.0), 0.0);
  EXPECT_DOUBLE_EQ(vertical_acceleration(shaking, 0.25), 0.0);
}

TEST(FloorMotion, StretchMovesTimeAndLeavesAmplitude) {
  const FloorMotion motion = piecewise_linear("ramp", 1.0, {0.0, 1.0}, {0.0, 3.0});
  const Shaking shaking{&motion, 1.0, 4.0, 2.0};
  EXPECT_DOUBLE_EQ(horizontal_acceleration(shaking, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(vertical_acceleration(shaking, 2.0), 3.0);
  EXPECT_DOUBLE_EQ(shaking.duration_s(), 4.0);
}

TEST(FloorMotion, RefusesWhatIsNoRecord) {
  EXPECT_THROW(piecewise_linear("x", 0.0, {0, 1}), Error);
  EXPECT_THROW(piecewise_linear("x", 0.1, {0}), Error);
  EXPECT_THROW(piecewise_linear("x", 0.1, {0, NAN}), Error);
  EXPECT_THROW(piecewise_linear("x", 0.1, {0, 1}, {0, 1, 2}), Error);
}

}  // namespace
}  // namespace freestand
