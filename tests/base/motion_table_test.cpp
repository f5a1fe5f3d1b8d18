// The table of a record: integrals and bounds against the motion itself.
#include "base/motion_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace freestand {
namespace {

FloorMotion record() {
  std::vector<double> a;
  for (int i = 0; i < 101; ++i) a.push_back(std::sin(0.3 * i) * (1 + 0.02 * i));
  return piecewise_linear("record", 0.02, a);
}

TEST(MotionTable, IntegralsAreThoseOfThePiecewiseLinearRecord) {
  const FloorMotion motion = record();
  const MotionTable& t = *motion.table;
  ASSERT_EQ(t.knots, 101);
  const Shaking shaking{&motion};
  double V = 0, D = 0;
  for (int j = 0; j < 100; ++j) {
    const double h = 0.02, a0 = horizontal_acceleration(shaking, j * h + 1e-12),
                 a1 = horizontal_acceleration(shaking, (j + 1) * h - 1e-12), slope = (a1 - a0) / h;
    D += V * h + a0 * h * h / 2 + slope * h * h * h / 6;
    V += (a0 + a1) * h / 2;
    EXPECT_NEAR(t.velocity[static_cast<std::size_t>(j) + 1], V, 1e-10);
    EXPECT_NEAR(t.displacement[static_cast<std::size_t>(j) + 1], D, 1e-10);
  }
  EXPECT_NEAR(t.velocity[150], V, 1e-10);  // the floor stops accelerating
}

TEST(MotionTable, PeaksBoundTheirRuns) {
  const FloorMotion motion = record();
  const MotionTable& t = *motion.table;
  for (std::size_t j = 0; j < 101; ++j) {
    EXPECT_LE(std::abs(t.acceleration[j]), t.run_peak[j / table_run]);
    EXPECT_LE(t.run_peak[j / table_run], t.later_peak[j / table_run]);
  }
}

TEST(MotionTable, KeepsAContinuousVerticalChannelOnly) {
  EXPECT_TRUE(record().table->vertical.empty());
  const double h = 0.5;
  FloorMotion motion;
  motion.degree = 1;
  motion.knot_s = {0, h, 2 * h};
  motion.horizontal_mps2 = {1, 2, 2, -4};
  motion.vertical_mps2 = {0, -6, -3, 10};
  const auto table = tabulate(motion);
  ASSERT_TRUE(table);
  const double a[] = {1, 2, 0, 0}, v[] = {0, -3, 2, 0};
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(table->vertical[j], v[j]);
    EXPECT_EQ(table->both[2 * j], a[j]);
    EXPECT_EQ(table->both[2 * j + 1], v[j]);
  }
  EXPECT_EQ(table->both.size(), 2 * table->acceleration.size());
  EXPECT_EQ(table->later_vertical_peak[0], 3);
  EXPECT_EQ(table->later_vertical_peak[1], 0);
  motion.vertical_mps2[2] = 1;  // a jump
  EXPECT_TRUE(tabulate(motion)->vertical.empty());
}

TEST(MotionTable, SearchRowsPassOverNoKnot) {
  const FloorMotion motion = record();
  const MotionTable& t = *motion.table;
  const auto all = static_cast<std::size_t>(t.backwards);
  ASSERT_EQ(t.heights.size(), 2 * all);
  for (std::size_t j = 0; j < 101; ++j) {
    EXPECT_GE(t.heights[j], t.height(t.velocity[j]));
    EXPECT_GE(t.heights[all + j], t.height(-t.velocity[j]));
    EXPECT_LE(t.heights[j], 2 * height_zero);
    EXPECT_LE(t.levels[j], t.run_levels[j / level_run]);
    EXPECT_EQ(t.columns[j * table_columns + 2], t.displacement[j]);
    EXPECT_NEAR(t.columns[j * table_columns + 3] * t.step_s, t.acceleration[j + 1] - t.acceleration[j], 1e-15);
    for (const double limit : {0.0, 0.3, 1.0, 2.5, 100.0}) {
      const double a = std::abs(t.acceleration[j]);
      const bool passed_over = t.levels[j] < t.level(limit);
      if (a >= limit) {
        EXPECT_FALSE(passed_over);
      }
      if (a < limit - 1e-4 * t.later_peak[0]) {
        EXPECT_TRUE(passed_over);
      }
    }
  }
  for (std::size_t j = 101; j < all; ++j) {  // searches end here
    EXPECT_EQ(t.heights[j], largest_short);
    EXPECT_EQ(t.heights[all + j], largest_short);
    EXPECT_EQ(t.levels[j], largest_short);
    EXPECT_EQ(t.run_levels[j / level_run], largest_short);
  }
}

// With t the time since knot j - 1, a block that slips in direction s has the speed
// w(t) = w_j + s (V_j - V(t)) + mu_k g (h - t).
TEST(MotionTable, DipsBoundHowFarASpeedFallsBetweenKnots) {
  const FloorMotion motion = record();
  const MotionTable& t = *motion.table;
  const double h = t.step_s;
  int deep = 0;
  for (std::size_t j = 1; j < static_cast<std::size_t>(t.knots); ++j)
    for (const double s : {-1.0, 1.0})
      for (double friction = 0.01; friction < 3; friction += 0.01) {
        const auto row = static_cast<std::size_t>(s > 0 ? 0 : t.backwards);
        const double dip = (t.heights[row + j] - t.height(s * t.velocity[j])) / t.heights_to_one;
        const double a = t.acceleration[j - 1], slope = (t.acceleration[j] - a) / h;
        const auto speed = [&](double time) {
          const double V = t.velocity[j - 1] + time * (a + 0.5 * slope * time);
          return dip + s * (t.velocity[j] - V) + friction * (h - time);
        };
        double least = dip;
        for (double time = 0; time < h; time += h / 50) least = std::min(least, speed(time));
        EXPECT_GE(least, std::min(0.0, speed(0)) - 1e-15);
        deep += least < 0.5 * dip && least < speed(0);
      }
  EXPECT_GT(deep, 20);  // the bound is not a loose one
}

// The instants of a long record are rounded, more so the later they are.
TEST(MotionTable, LongRoughRecordsHaveOne) {
  for (const double step : {0.005, 0.01}) {
    std::vector<double> rough(100000);
    for (std::size_t i = 0; i < rough.size(); ++i) rough[i] = i % 3 == 0 ? 10 : -7;
    EXPECT_TRUE(piecewise_linear("rough", step, rough, rough).table) << step;
    FloorMotion jumps = piecewise_linear("jumps", step, rough);
    jumps.horizontal_mps2[2 * 90000] += 1e-6;
    index_runs(jumps);
    EXPECT_FALSE(jumps.table) << step;
  }
}

TEST(MotionTable, PulsesAndOddStepsHaveNone) {
  FloorMotion motion = record();
  motion.knot_s[7] += 0.001;
  EXPECT_EQ(tabulate(motion), nullptr);
  motion = record();
  motion.horizontal_mps2[20] += 0.5;  // a jump
  EXPECT_EQ(tabulate(motion), nullptr);
  motion.degree = 7;
  EXPECT_EQ(tabulate(motion), nullptr);
}

// Found by a fuzzer: squares that are no numbers any more.
TEST(MotionTable, IsNoneOfAFloorBeyondAllNumbers) {
  EXPECT_EQ(tabulate(piecewise_linear("beyond", 0.01, {0, -1e233, 0.2, 0}, {})), nullptr);
}

// So small that nothing over it is a number (found by a fuzzer: a record whose numbers end in e-310).
TEST(MotionTable, OfNextToNothing) {
  const auto table = tabulate(piecewise_linear("nothing", 0.01, {0, 1e-310, -1e-310, 0}, {}));
  ASSERT_TRUE(table);
  EXPECT_TRUE(std::isfinite(table->heights_to_one));
  EXPECT_TRUE(std::isfinite(table->levels_to_one));
}

}  // namespace
}  // namespace freestand
