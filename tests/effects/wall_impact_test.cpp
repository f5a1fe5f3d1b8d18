// Law: reaching the gap, w+ = -e w-.
#include <cmath>

#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(WallImpact, General) {
  expect_general({"wall_impact", {0.005, 0.5}, {-0.005, 0.5}, {5, 0.5}, {Model::slide, Model::slide_rock}, 40, 4});
}

// A wall on the left at a gap of 0, and walls on both sides, which a sign of gap_m cannot say.
TEST(WallImpact, GeneralBySidesAndOnBoth) {
  expect_general(
      {"wall_impact", {0, 0.5, -1, -1}, {0, 0.5, 1, -1}, {5, 0.5, -1, -1}, {Model::slide, Model::slide_rock}, 40, 4});
  expect_general({"wall_impact",
                  {0.004, 0.5, 1, 0.009},
                  {0.004, 0.5, -1, 0.009},
                  {5, 0.5, 1, 5},
                  {Model::slide, Model::slide_rock},
                  40,
                  4});
}

// Pushed to the left with a = 6 the block stays at the wall there; to the right it goes by (a - mu g) t^2/2.
TEST(WallImpact, OnTheLeftAtGapZero) {
  const double mu = 0.2, t = 0.1;
  for (const Solver& solver : both_solvers)
    for (const auto& [right, side] : {std::pair{false, -1.0}, std::pair{true, 1.0}, std::pair{true, 0.0}}) {
      const Specimen block = sliding(mu, {effect("wall_impact", {0.0, 0.0, side})});
      // The floor goes the other way.
      const FloorMotion to_wall = staircase({t}, {right ? -6.0 : 6.0}), away = staircase({t}, {right ? 6.0 : -6.0});
      EXPECT_EQ(run(solver, block, {&to_wall}).response.peak_slip_m, 0) << solver.name << side;
      const Path r = run(solver, block, {&away});
      EXPECT_NEAR(r.points.at(100).slip_m, (right ? -0.5 : 0.5) * (6 - mu * g) * t * t, 1e-12) << solver.name << side;
    }
}

// On ice between walls 2 d apart, each giving back e: from the middle with speed v there and back in d/v, 2 d/(e v), 2 d/(e^2 v).
TEST(WallImpact, ToAndFroBetweenTwo) {
  const double v = 0.4, e = 0.5, d = 0.1;
  const FloorMotion push = staircase({0.05, 3}, {-v / 0.05, 0});
  const double from = 0.5 * v * 0.05;  // where it is when it has its speed, at 0.05 s
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(0, {effect("wall_impact", {d, e, 0, d})}), {&push});
    const double right = 0.05 + (d - from) / v, left = right + 2 * d / (e * v), again = left + 2 * d / (e * e * v);
    const auto at = [&](double time) { return r.points.at(static_cast<std::size_t>(std::lround(1000 * time))); };
    EXPECT_NEAR(at(right - 0.01).slip_velocity_mps, v, 1e-12) << solver.name;
    EXPECT_NEAR(at(right + 0.01).slip_velocity_mps, -e * v, 1e-12) << solver.name;
    EXPECT_NEAR(at(left - 0.01).slip_m, -d + 0.01 * e * v, 1e-3) << solver.name;
    EXPECT_NEAR(at(left + 0.01).slip_velocity_mps, e * e * v, 1e-12) << solver.name;
    EXPECT_NEAR(at(again + 0.01).slip_velocity_mps, -e * e * e * v, 1e-12) << solver.name;
    EXPECT_EQ(r.response.wall_hits, 3) << solver.name;
  }
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
