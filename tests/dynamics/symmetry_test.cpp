// Symmetries of the equations: mirror, scale, and knots that change nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

FREESTAND_ON_BOTH_SOLVERS(Symmetry);

CaseFamily busy_family(std::uint64_t seed) {
  CaseFamily family;
  family.seed = seed;
  family.alpha_high = 0.7;
  family.duration_low_s = 2;
  family.duration_high_s = 4;
  family.excess_low = 1.1;
  return family;
}

// The mirrored motion on the mirrored block gives the mirrored answer, to the bit.
TEST_P(Symmetry, MirroredMotionGivesTheMirroredAnswerToTheBit) {
  int moved = 0, impacts = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    const RandomCase c = random_case(busy_family(21), number);
    Specimen mirrored = c.specimen;
    std::swap(mirrored.block.left_m, mirrored.block.right_m);
    Shaking negative = c.shaking;
    negative.scale = -negative.scale;
    History a, b;
    const Response ra = GetParam()(c.specimen, c.shaking, {}, &a), rb = GetParam()(mirrored, negative, {}, &b);
    ASSERT_EQ(ra.outcome, rb.outcome) << c.text();
    ASSERT_EQ(ra.peak_slip_m, rb.peak_slip_m) << c.text();
    ASSERT_EQ(ra.residual_slip_m, -rb.residual_slip_m);
    ASSERT_EQ(ra.slid_path_m, rb.slid_path_m);
    ASSERT_EQ(ra.peak_rotation_rad, rb.peak_rotation_rad);
    ASSERT_EQ(ra.residual_rotation_rad, -rb.residual_rotation_rad);
    ASSERT_EQ(ra.peak_acceleration_mps2, rb.peak_acceleration_mps2);
    ASSERT_EQ(ra.impacts, rb.impacts);
    ASSERT_EQ(ra.events, rb.events);
    ASSERT_EQ(ra.end_time_s, rb.end_time_s);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      ASSERT_EQ(a.points[i].time_s, b.points[i].time_s);
      ASSERT_EQ(a.points[i].slip_m, -b.points[i].slip_m);
      ASSERT_EQ(a.points[i].slip_velocity_mps, -b.points[i].slip_velocity_mps);
      ASSERT_EQ(a.points[i].rotation_rad, -b.points[i].rotation_rad);
      ASSERT_EQ(a.points[i].rotation_rate_radps, -b.points[i].rotation_rate_radps);
      ASSERT_EQ(a.points[i].mode, b.points[i].mode);
    }
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      ASSERT_EQ(a.events[i].time_s, b.events[i].time_s);
      ASSERT_EQ(a.events[i].to, b.events[i].to);
      ASSERT_EQ(a.events[i].pivot, -b.events[i].pivot);
    }
    moved += ra.outcome == Outcome::moved ? 1 : 0;
    impacts += ra.impacts;
  }
  EXPECT_GT(moved, 20);
  EXPECT_GT(impacts, 50);
}

// [KM05 ch. 7] Lengths / 4 with times / 2: accelerations stay, rotations stay, slips go with the lengths.
TEST_P(Symmetry, QuarterScaleGivesTheSameDimensionlessAnswer) {
  int moved = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    const RandomCase c = random_case(busy_family(22), number);
    Specimen quarter = c.specimen;
    quarter.block.left_m /= 4;
    quarter.block.right_m /= 4;
    quarter.block.height_m /= 4;
    quarter.block.gyration2_m2 /= 16;
    Shaking faster = c.shaking;
    faster.stretch /= 2;
    Settings settings;
    settings.tolerance = 1e-12;
    Settings half = settings;
    half.free_vibration_s = 0.5 * settings.free_vibration_s;
    const Response full = GetParam()(c.specimen, c.shaking, settings), small = GetParam()(quarter, faster, half);
    ASSERT_EQ(full.outcome, small.outcome) << c.text();
    const double base = c.specimen.block.base_m();
    ASSERT_NEAR(full.peak_slip_m, 4 * small.peak_slip_m, 1e-9 * base) << number << ' ' << c.text();
    ASSERT_NEAR(full.residual_slip_m, 4 * small.residual_slip_m, 1e-9 * base);
    ASSERT_NEAR(full.slid_path_m, 4 * small.slid_path_m, 1e-9 * base);
    ASSERT_NEAR(full.peak_rotation_rad, small.peak_rotation_rad, 1e-9);
    ASSERT_NEAR(full.peak_acceleration_mps2, small.peak_acceleration_mps2, 1e-9 * full.peak_acceleration_mps2);
    ASSERT_NEAR(full.end_time_s, 2 * small.end_time_s, 1e-9 * full.end_time_s);
    moved += full.outcome == Outcome::moved ? 1 : 0;
  }
  EXPECT_GT(moved, 20);
}

// Scale and stretch are the same as a motion with larger values and longer steps.
TEST_P(Symmetry, ScaleAndStretchAreThoseOfTheMotion) {
  for (std::uint64_t number = 0; number < 10; ++number) {
    const RandomCase c = random_case(busy_family(23), number);
    FloorMotion motion = *c.motion;
    for (double& t : motion.knot_s) t *= 2;
    for (std::size_t i = 0; i < motion.horizontal_mps2.size(); ++i)
      motion.horizontal_mps2[i] *= i % 2 == 0 ? 0.5 : 0.25;
    for (std::size_t i = 0; i < motion.vertical_mps2.size(); ++i) motion.vertical_mps2[i] *= i % 2 == 0 ? 4 : 2;
    Shaking stretched{&motion, 2 * c.shaking.scale, 0.5, 0.25 * c.shaking.vertical_scale};
    const Response a = GetParam()(c.specimen, c.shaking), b = GetParam()(c.specimen, stretched);
    ASSERT_EQ(a.outcome, b.outcome);
    ASSERT_NEAR(a.peak_slip_m, b.peak_slip_m, 1e-10);
    ASSERT_NEAR(a.peak_rotation_rad, b.peak_rotation_rad, 1e-10);
  }
}

// Mass and floor carry no weight in the equations: the answer does not depend on the mass at all.
TEST_P(Symmetry, MassDoesNotMatter) {
  const RandomCase c = random_case(busy_family(24), 3);
  Specimen heavy = c.specimen;
  heavy.block.mass_kg *= 16;
  const Response a = GetParam()(c.specimen, c.shaking), b = GetParam()(heavy, c.shaking);
  EXPECT_EQ(a.peak_slip_m, b.peak_slip_m);
  EXPECT_EQ(a.peak_rotation_rad, b.peak_rotation_rad);
}

// A history changes no bit of the fast answer; the reference stops at the output times, so its last digits change.
TEST_P(Symmetry, AHistoryChangesNothing) {
  const bool exact = std::string(GetParam().name) == "fast";
  for (std::uint64_t number = 0; number < 20; ++number) {
    const RandomCase c = random_case(busy_family(25), number);
    History history;
    history.step_s = 0.003;
    const Response a = GetParam()(c.specimen, c.shaking), b = GetParam()(c.specimen, c.shaking, {}, &history);
    const double tolerance = exact ? 0 : 1e-7;
    ASSERT_EQ(a.outcome, b.outcome);
    ASSERT_NEAR(a.peak_slip_m, b.peak_slip_m, tolerance) << c.text();
    ASSERT_NEAR(a.residual_slip_m, b.residual_slip_m, tolerance);
    ASSERT_NEAR(a.peak_rotation_rad, b.peak_rotation_rad, tolerance);
    ASSERT_EQ(static_cast<std::size_t>(b.events), history.events.size());
    if (exact) {
      ASSERT_EQ(a.events, b.events);
    }
  }
}

}  // namespace
}  // namespace freestand::test
