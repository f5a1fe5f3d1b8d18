// Law: reaching the gap, w+ = -e w-.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(WallImpact, General) {
  expect_general({"wall_impact", {0.005, 0.5}, {-0.005, 0.5}, {5, 0.5}, {Model::slide, Model::slide_rock}, 40, 4});
}

// On ice the block comes back with e times its speed.
TEST(WallImpact, ThrowsTheBlockBack) {
  const double v = 0.4, e = 0.6;
  const FloorMotion push = staircase({0.05, 1}, {-v / 0.05, 0});
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(0, {effect("wall_impact", {0.1, e})}), {&push});
    double most = 0;
    for (const auto& p : r.points) most = std::fmax(most, p.slip_m);
    EXPECT_LE(most, 0.1 + 1e-12) << solver.name;
    EXPECT_NEAR(r.points.at(700).slip_velocity_mps, -e * v, 1e-12) << solver.name;
  }
}

// Pressed against the wall beyond what friction holds, the block stays; it leaves when the push turns and exceeds
// friction.
TEST(WallImpact, HoldsWhatPressesAgainstIt) {
  const FloorMotion push = staircase({1.0, 0.5, 0.5}, {-6, 0, 6});
  for (const Solver& solver : both_solvers)
    for (const double e : {0.0, 0.5}) {
      const Path r = run(solver, sliding(0.2, {effect("wall_impact", {0.05, e})}), {&push});
      EXPECT_EQ(r.points.at(900).mode, Mode::rest) << solver.name << e;
      EXPECT_NEAR(r.points.at(900).slip_m, 0.05, 1e-9);
      EXPECT_EQ(r.points.at(1400).mode, Mode::rest);
      EXPECT_NEAR(r.points.at(1700).slip_velocity_mps, -(6 - 0.2 * g) * 0.2, 1e-9) << solver.name << e;
    }
}

// What presses a squat block against the wall acts through the centre of mass, so that it does not tip the block.
TEST(WallImpact, APressedBlockDoesNotTip) {
  const FloorMotion push = staircase({1.0, 0.5}, {-14, 0});
  Specimen squat = sliding(0.2, {effect("wall_impact", {0.05, 0.0})});
  squat.model = Model::slide_rock;
  squat.block.left_m = squat.block.right_m = 0.4;
  ASSERT_LT(g * 0.4 / 0.4, 14);  // a hinge at the base would let it tip
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, squat, {&push});
    EXPECT_EQ(r.points.at(900).mode, Mode::rest) << solver.name;
    EXPECT_EQ(r.response.peak_rotation_rad, 0) << solver.name;
    EXPECT_NEAR(r.response.peak_slip_m, 0.05, 1e-11 * 0.8) << solver.name;  // of the height: what counts as touching
  }
}

}  // namespace
}  // namespace freestand::test
