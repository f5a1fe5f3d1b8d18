// What a floor does between its readings, by how well those that are left out are known from the others.
#include "measurement/noise/between_readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/made_tests.hpp"
#include "support/keyed_random.hpp"

namespace freestand::measurement {
namespace {

constexpr double straight_s = 0.005, smooth_s = 0.01;

FloorReadings sine(double step_s, double readings_a_cycle, double noise = 0) {
  test::KeyedRandom random(7, 7);
  FloorReadings read{"sine", step_s, {}};
  for (int i = 0; i < 1000; ++i)
    read.horizontal_mps2.push_back(std::sin(2 * pi * i / readings_a_cycle) + noise * random.normal());
  return read;
}

// Lines over h miss the middle of a sine by 1 - cos(w h) of it, over 2 h by 1 - cos(2 w h).
TEST(BetweenReadings, AThirdOfASmoothFloorAndAllOfARoughOne) {
  for (const double readings : {40.0, 12.0, 8.0, 5.0}) {
    const double turn = 2 * pi / readings, ratio = (1 - std::cos(2 * turn)) / (1 - std::cos(turn));
    EXPECT_NEAR(between_readings(sine(straight_s, readings), 0).share, 1 / (std::max(ratio, 2.0) - 1), 5e-3)
        << readings;
  }
  EXPECT_EQ(between_readings(sine(straight_s, 2.5), 0).share, 1);
  // What noise adds is not what the floor does.
  EXPECT_NEAR(between_readings(sine(straight_s, 20, 0.005), 0.005).share,
              between_readings(sine(straight_s, 20), 0).share, 0.03);
}

// Cubics miss it by 1 - 9/8 cos(w h) + 1/8 cos(3 w h).
TEST(BetweenReadings, AFifteenthWhereTheyAreJoinedByACurve) {
  const auto missed = [](double turn) { return 1 - 9.0 / 8 * std::cos(turn) + 1.0 / 8 * std::cos(3 * turn); };
  for (const double readings : {40.0, 20.0, 12.0, 9.0}) {
    const double turn = 2 * pi / readings, ratio = missed(2 * turn) / missed(turn);
    EXPECT_NEAR(between_readings(sine(smooth_s, readings), 0).share, 1 / (std::min(ratio, 16.0) - 1), 2e-3) << readings;
  }
  EXPECT_NEAR(between_readings(sine(smooth_s, 60), 0).share, 1.0 / 15, 1e-3);
  EXPECT_EQ(between_readings(sine(smooth_s, 3.1), 0).share, 1);
}

TEST(BetweenReadings, EverySecondReadingIsMovedByTheirShare) {
  const FloorReadings floor = sine(straight_s, 9);
  const auto& read = floor.horizontal_mps2;
  const auto [share, strayed] = between_readings(floor, 0);
  ASSERT_EQ(strayed.size(), 2U);
  for (const std::size_t first : {1U, 2U}) {
    const auto moved = motion_samples(strayed[first - 1], strayed[first - 1].horizontal_mps2);
    ASSERT_EQ(moved.size(), read.size());
    for (std::size_t i = 1; i + 1 < read.size(); ++i) {
      const double off = i % 2 == first % 2 ? (read[i - 1] + read[i + 1]) / 2 - read[i] : 0;
      EXPECT_NEAR(moved[i] - read[i], share * off, 1e-12) << i;
    }
  }
  EXPECT_TRUE(between_readings({}, 0).strayed.empty());
}

// A slow floor hardly misses them.
TEST(BetweenReadings, TheCurveGoesOnWithoutThem) {
  const FloorReadings floor = sine(smooth_s, 50);
  for (const FloorMotion& strayed : between_readings(floor, 0).strayed)
    for (std::size_t i = 10; i < 990; ++i)
      EXPECT_NEAR(horizontal_acceleration({.motion = &strayed}, 0.01 * static_cast<double>(i)),
                  floor.horizontal_mps2[i], 1e-5);
}

// What histories may stray by: the mean square over both.
TEST(BetweenReadings, HistoriesStrayAsTheFloorsDo) {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  const Dataset data = test::made_dataset(cabinet);
  const Bench bench(data, 8);
  const ModelSpec model = test::free_friction();
  const Values x = {0.2};
  const Prediction plain = predict(model, data.tests[0], x);
  const BetweenReadings& between = bench.between_readings(0);
  const Prediction one = predict(model, data.tests[0], x, &between.strayed[0]),
                   two = predict(model, data.tests[0], x, &between.strayed[1]);
  const auto unread = bench.unread_spread(model, 0, x, plain)[0];
  ASSERT_EQ(unread.size(), plain.slip_m.size());
  double largest = 0;
  for (std::size_t k = 0; k < unread.size(); ++k) {
    const double a = one.slip_m[k] - plain.slip_m[k], b = two.slip_m[k] - plain.slip_m[k];
    EXPECT_NEAR(unread[k], (a * a + b * b) / 2, 1e-15);
    largest = std::max(largest, unread[k]);
  }
  EXPECT_GT(largest, 0);
}

}  // namespace
}  // namespace freestand::measurement
