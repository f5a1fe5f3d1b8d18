// The peak slip to each side: the largest value of the history either way, swapped by a mirrored motion.
#include <gtest/gtest.h>

#include <cmath>

#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

FREESTAND_ON_BOTH_SOLVERS(SlipBySide);

CaseFamily family() {
  CaseFamily family;
  family.seed = 77;
  family.alpha_high = 0.6;
  family.mu_low = 0.1;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  family.excess_low = 1.2;
  return family;
}

constexpr Settings by_side = [] {
  Settings settings;
  settings.slip_by_side = true;
  return settings;
}();

// Between two points of the history u'' is below some 30 m/s2: a peak lies above them by less than 30 (step/2)^2/2.
TEST_P(SlipBySide, IsTheLargestOfTheHistory) {
  const std::uint64_t samples = std::string(GetParam().name) == "fast" ? 30 : 3;
  int one_sided = 0;
  for (std::uint64_t number = 0; number < samples; ++number) {
    const RandomCase c = random_case(family(), number);
    History history;
    history.step_s = 0.001;
    const Response r = GetParam()(c.specimen, c.shaking, by_side, &history);
    if (r.outcome != Outcome::moved) continue;
    double right = 0, left = 0;
    for (const HistoryPoint& point : history.points) {
      right = std::fmax(right, point.slip_m);
      left = std::fmax(left, -point.slip_m);
    }
    EXPECT_NEAR(r.peak_slip_right_m, right, 4e-6) << c.text();
    EXPECT_NEAR(r.peak_slip_left_m, left, 4e-6) << c.text();
    EXPECT_EQ(std::fmax(r.peak_slip_right_m, r.peak_slip_left_m), r.peak_slip_m) << c.text();
    one_sided += std::fmin(r.peak_slip_right_m, r.peak_slip_left_m) < 0.5 * r.peak_slip_m;
  }
  EXPECT_GT(one_sided, 0);
}

TEST_P(SlipBySide, IsSwappedByAMirror) {
  for (std::uint64_t number = 0; number < 5; ++number) {
    const RandomCase c = random_case(family(), number);
    Specimen mirrored = c.specimen;
    std::swap(mirrored.block.left_m, mirrored.block.right_m);
    Shaking negative = c.shaking;
    negative.scale = -negative.scale;
    const Response a = GetParam()(c.specimen, c.shaking, by_side, nullptr),
                   b = GetParam()(mirrored, negative, by_side, nullptr);
    EXPECT_EQ(a.peak_slip_right_m, b.peak_slip_left_m);
    EXPECT_EQ(a.peak_slip_left_m, b.peak_slip_right_m);
  }
}

TEST(SlipBySideAsked, ChangesNothingElseAndIsUnknownWhereNotAskedFor) {
  for (std::uint64_t number = 0; number < 20; ++number) {
    const RandomCase c = random_case(family(), number);
    const Response with = respond(c.specimen, c.shaking, by_side), without = respond(c.specimen, c.shaking);
    EXPECT_EQ(with.peak_slip_m, without.peak_slip_m);
    EXPECT_EQ(with.residual_slip_m, without.residual_slip_m);
    EXPECT_EQ(with.events, without.events);
    EXPECT_TRUE(std::isnan(without.peak_slip_right_m));
    EXPECT_TRUE(std::isnan(without.peak_slip_left_m));
    Response batch;
    respond_batch({&c.specimen, 1}, {&c.shaking, 1}, by_side, {&batch, 1});
    EXPECT_EQ(batch.peak_slip_right_m, with.peak_slip_right_m);
    EXPECT_EQ(batch.peak_slip_left_m, with.peak_slip_left_m);
  }
}

// Friction alone, a floor that is pulled away once: the block is left behind on one side and never crosses the middle.
TEST_P(SlipBySide, ABlockThatIsLeftBehindSlipsToOneSide) {
  const FloorMotion pull = rectangular_pulse(8, 0.2);
  for (const Model model : {Model::slide, Model::bouc_wen}) {
    Specimen specimen;
    specimen.block = Block::rectangular(0.6, 1.2, 100);
    specimen.friction = {0.2, 0.2};
    specimen.model = model;
    specimen.bouc_wen.yield_displacement_m = 1e-4;
    const Response r = GetParam()(specimen, {.motion = &pull}, by_side, nullptr);
    EXPECT_GT(r.peak_slip_left_m, 0.1);
    EXPECT_EQ(r.peak_slip_left_m, r.peak_slip_m);
    EXPECT_LT(r.peak_slip_right_m, 2e-4);
  }
}

}  // namespace
}  // namespace freestand::test
