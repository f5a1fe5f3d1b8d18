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

TEST(MotionTable, SearchRowsPassOverNoKnot) {
  const FloorMotion motion = record();
  const MotionTable& t = *motion.table;
  for (std::size_t j = 0; j < t.velocity.size(); ++j) {
    EXPECT_GE(double{t.above[j]}, t.margin[j] + t.velocity[j]);
    EXPECT_GE(double{t.below[j]}, t.margin[j] - t.velocity[j]);
    EXPECT_NEAR(t.above[j] - t.below[j], 2 * t.velocity[j], 1e-5);
    EXPECT_EQ(t.size[j], static_cast<float>(std::abs(t.acceleration[j])));
    EXPECT_EQ(t.columns[j * table_columns + 2], t.displacement[j]);
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

}  // namespace
}  // namespace freestand
