// The searches of sliding in packs against plain loops over the same rows, and records on which they have to go far: long
// rests, long slips, and friction so strong that the line is too steep for the rows' short integers.
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/simulate.hpp>

#include "base/motion_table.hpp"
#include "base/units.hpp"
#include "support/keyed_random.hpp"

#define FREESTAND_ISA tested
#include "dynamics/pack/slide_search.hpp"

namespace freestand::dynamics::tested {
namespace {

using test::KeyedRandom;

// Smooth enough that lines cross it at all distances.
FloorMotion wandering_record(KeyedRandom& random, int knots) {
  std::vector<double> a(static_cast<std::size_t>(knots));
  const double change = random.log_uniform(0.02, 1);
  double value = 0;
  for (double& one : a) one = value += change * (random.normal() - 0.5 * value);
  return piecewise_linear("wandering", 0.01, a);
}

TEST(SlideSearch, FindsTheFirstKnotOnTheLine) {
  int beyond_a_look = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    KeyedRandom random(140, i);
    const FloorMotion motion = wandering_record(random, 700);
    const MotionTable& t = *motion.table;
    const int from = static_cast<int>(random.uniform(1, 700));
    const double side = random.chance(0.5) ? 1 : -1, fall = random.log_uniform(1, 0.99 * steepest_drop) / look;
    const std::size_t row = side > 0 ? 0 : static_cast<std::size_t>(t.backwards);
    const double start = t.height(side * t.velocity[static_cast<std::size_t>(from)]) + random.uniform(-100, 30000);
    const Line line{static_cast<int>(std::fmin(start, 65535)), static_cast<int>(std::ceil(fall * look))};
    const int found = from + first_crossing(t.heights.data() + row + from, line);
    ASSERT_LE(found, t.knots);
    for (int j = from; j < found; ++j)
      EXPECT_GT(start - fall * (j - from), t.heights[row + static_cast<std::size_t>(j)]);
    if (found < t.knots) {
      const double reach = t.heights[row + static_cast<std::size_t>(found)] + 2 + (found - from) / double{look};
      EXPECT_LE(line.height - fall * (found - from), reach);
    }
    beyond_a_look += found - from > 2 * look;
  }
  EXPECT_GT(beyond_a_look, 200);
}

TEST(SlideSearch, FindsTheFirstLoudKnot) {
  int far = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    KeyedRandom random(141, i);
    const FloorMotion motion = wandering_record(random, 2500);
    const MotionTable& t = *motion.table;
    const auto from = static_cast<unsigned>(random.uniform(0, 2500));
    const std::uint16_t level = t.level(t.later_peak[0] * random.uniform(0.2, 1.1));
    unsigned expected = from;
    while (t.levels[expected] < level) ++expected;
    EXPECT_EQ(first_loud(t.levels.data(), t.run_levels.data(), level, from), expected);
    far += expected - from > look * level_run;
  }
  EXPECT_GT(far, 200);
}

void expect_as_single(const FloorMotion& motion, double mu_s, double mu_k, double scale, int least_events) {
  Specimen specimen;
  specimen.model = Model::slide;
  specimen.block = Block::rectangular(0.6, 0.9, 100);
  specimen.friction = {mu_s, mu_k};
  std::vector<Specimen> specimens(3, specimen);
  const std::vector<Shaking> shakings{{&motion, scale}, {&motion, -scale}, {&motion, 0.5 * scale}};
  std::vector<Response> packs(3);
  respond_batch(specimens, shakings, {}, packs);
  for (std::size_t i = 0; i < 3; ++i) {
    const Response single = respond(specimens[i], shakings[i], {.tolerance = 1e-12});
    EXPECT_EQ(packs[i].events, single.events);
    EXPECT_EQ(packs[i].outcome, single.outcome);
    EXPECT_NEAR(packs[i].slid_path_m, single.slid_path_m, 1e-11 * single.slid_path_m + 1e-14);
    EXPECT_NEAR(packs[i].residual_slip_m, single.residual_slip_m, 1e-11 * single.slid_path_m + 1e-14);
    EXPECT_NEAR(packs[i].end_time_s, single.end_time_s, 1e-9);
    EXPECT_NEAR(packs[i].peak_acceleration_mps2, single.peak_acceleration_mps2, 1e-9);
  }
  EXPECT_GE(packs[0].events, least_events);
}

TEST(SlideSearch, LongRestsAndLongSlips) {
  std::vector<double> a(6000, 0.0);
  for (std::size_t i = 0; i < 400; ++i) a[i] = a[i + 4000] = 5 * std::sin(pi * static_cast<double>(i) / 400);
  expect_as_single(piecewise_linear("two pushes", 0.005, a), 0.2, 0.2, 1, 4);
  expect_as_single(piecewise_linear("two pushes", 0.005, a), 0.05, 0.02, 1, 2);
}

// mu_k g h is a thirteenth of the largest velocity of the floor, and slips last for many knots all the same.
TEST(SlideSearch, LinesTooSteepForTheRows) {
  std::vector<double> a(800);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = 4 * std::sin(2 * pi * static_cast<double>(i) / 20.3);
  const FloorMotion motion = piecewise_linear("swing", 0.1, a);
  ASSERT_GT(0.2 * standard_gravity_mps2 * 0.1 * motion.table->heights_to_one * look, steepest_drop);
  expect_as_single(motion, 0.2, 0.2, 1, 50);
}

}  // namespace
}  // namespace freestand::dynamics::tested
