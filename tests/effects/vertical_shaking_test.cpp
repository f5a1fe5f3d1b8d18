// Law: g' = g + s v(t).
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

// Motions with a vertical channel; without the effect it is not felt.
TEST(VerticalShaking, ActsThroughItsScaleAndTheMotionsOwn) {
  const FloorMotion lift = staircase({0.2, 0.5}, {-5, 0}, {3, 0});
  for (const Solver& solver : both_solvers)
    for (const double s : {0.0, 0.5, 1.0}) {
      const Path r = run(solver, sliding(0.2, {effect("vertical_shaking", {s})}), {&lift});
      EXPECT_NEAR(r.points.at(150).slip_velocity_mps, (5 - 0.2 * (g + 3 * s)) * 0.15, 1e-12) << solver.name;
      // A motion at half its strength shakes half as much up and down, and its mirror image as much.
      const Path half = run(solver, sliding(0.2, {effect("vertical_shaking", {s})}), {&lift, -0.5});
      EXPECT_NEAR(half.points.at(150).slip_velocity_mps, -(2.5 - 0.2 * (g + 1.5 * s)) * 0.15, 1e-12) << solver.name;
    }
}

TEST(VerticalShaking, IsTheShakingThatTheKernelKnows) {
  const FloorMotion lift = staircase({0.2, 0.3, 0.5}, {-5, 6, 0}, {3, -4, 0});
  const Response a = respond(slender(0.4, {effect("vertical_shaking", {0.7})}), {&lift, 1.2});
  const Response b = respond(slender(0.4), {&lift, 1.2, 1, 0.7 * 1.2});
  EXPECT_EQ(a.peak_slip_m, b.peak_slip_m);
  EXPECT_EQ(a.peak_rotation_rad, b.peak_rotation_rad);
  EXPECT_GT(a.peak_rotation_rad, 0);
}

}  // namespace
}  // namespace freestand::test
