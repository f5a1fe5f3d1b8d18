// Floors between the readings of their sensor: straight where these come every 5 ms or oftener, else a smooth curve.
#include "measurement/data/floor_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>

#include "base/units.hpp"
#include "measurement/data/ground.hpp"

namespace freestand::measurement {
namespace {

// Two sines under an envelope: up to 8 Hz, still at both ends.
double shaking_mps2(double t) {
  const double envelope = t < 4 ? std::pow(std::sin(pi * t / 4), 2) : 0;
  return envelope * (3 * std::sin(2 * pi * 1.3 * t) + 1.5 * std::sin(2 * pi * 8 * t));
}

measurement::Test read_every(double step_s) {
  measurement::Test test;
  FloorReadings read{"floor", step_s, {}};
  for (int i = 0; i * step_s < 5; ++i) read.horizontal_mps2.push_back(shaking_mps2(i * step_s));
  read_floor(test, read);
  return test;
}

double final_slip_m(const FloorMotion& motion) {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.15, 0.15};
  return respond(cabinet, {.motion = &motion}, {.tolerance = 1e-10}).residual_slip_m;
}

TEST(FloorReadings, StayWhatTheyAre) {
  for (const double step : {0.02, 0.015, 0.01, 0.005, 0.001}) {
    const auto test = read_every(step);
    const FloorReadings again = readings_of(test);
    EXPECT_NEAR(again.step_s, step, 1e-15);
    ASSERT_EQ(again.horizontal_mps2.size(), static_cast<std::size_t>(std::ceil(5 / step - 1e-9))) << step;
    for (std::size_t i = 0; i < again.horizontal_mps2.size(); ++i)
      EXPECT_NEAR(again.horizontal_mps2[i], shaking_mps2(static_cast<double>(i) * step), 1e-15);
    EXPECT_TRUE(again.vertical_mps2.empty());
    EXPECT_LE(test.motion.knot_s[1], 0.005 + 1e-15);
  }
  EXPECT_EQ(read_every(0.005).pieces_a_reading, 1);
  EXPECT_EQ(read_every(0.01).pieces_a_reading, 2);
  EXPECT_EQ(read_every(0.015).pieces_a_reading, 3);
}

// Cubics miss a sine of w by (w h)^4 3/128 in the middle of h, which is 2e-3 of 8 Hz at 100 Hz; lines by (w h)^2/8, 3e-2.
TEST(FloorReadings, BetweenThemAFloorIsSmooth) {
  const auto test = read_every(0.01);
  for (double t = 0.015; t < 4; t += 0.01)
    EXPECT_NEAR(horizontal_acceleration(test.shaking(), t), shaking_mps2(t), 4e-3);
}

// The slip of a block on the floor as it was, in steps of 0.2 ms, and as it was read at 50 Hz: lines there, and the curve.
TEST(FloorReadings, HistoriesComeCloser) {
  const auto fine = read_every(0.0002), seldom = read_every(0.02);
  const double truth = final_slip_m(fine.motion), smooth = final_slip_m(seldom.motion),
               straight = final_slip_m(piecewise_linear("lines", 0.02, readings_of(seldom).horizontal_mps2));
  EXPECT_GT(std::abs(truth), 0.005);
  EXPECT_LT(std::abs(smooth - truth), 0.2 * std::abs(straight - truth)) << truth << ' ' << smooth << ' ' << straight;
}

TEST(FloorReadings, TwoOfThemAreALine) {
  measurement::Test test;
  read_floor(test, {"two", 0.02, {0, 1}, {1, 0}});
  EXPECT_EQ(test.pieces_a_reading, 1);
  EXPECT_EQ(readings_of(test).vertical_mps2, (std::vector<double>{1, 0}));
  EXPECT_THROW(read_floor(test, {"one", 0.02, {0}}), Error);
}

}  // namespace
}  // namespace freestand::measurement
