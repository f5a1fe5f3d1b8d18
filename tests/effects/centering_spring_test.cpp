// Law: force -m W^2 u, W = 2 pi f.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(CenteringSpring, General) { expect_general({"centering_spring", {0.7}, {0.7}, {0}}); }

// A spring and Coulomb friction: from a turning point u0 the block swings half a period pi/W about mu g/W^2 and turns at
// -(|u0| - 2 mu g/W^2); it stays where |u| W^2 <= mu g.
TEST(CenteringSpring, HalfSwingsShrinkByTwiceTheFriction) {
  const double mu = 0.05, f = 1, W = 2 * pi * f, shrink = 2 * mu * g / (W * W);
  const FloorMotion push = rectangular_pulse(-8, 0.15);
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(mu, {effect("centering_spring", {f})}), {&push}, 20);
    double first = r.response.peak_slip_m, turn = first;
    ASSERT_GT(first, 4 * shrink);
    int side = 1;
    while (turn * W * W > mu * g) turn -= shrink, side = -side;
    // Overshoot past the middle leaves it on the other side.
    EXPECT_NEAR(r.response.residual_slip_m, side * turn, 1e-9) << solver.name;
    EXPECT_LE(std::abs(r.response.residual_slip_m) * W * W, mu * g);
  }
}

// On ice its swing keeps its energy: v^2 + W^2 u^2.
TEST(CenteringSpring, KeepsItsEnergyOnIce) {
  const double f = 0.8, W = 2 * pi * f;
  const FloorMotion push = staircase({0.15, 3}, {-8, 0});
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(0, {effect("centering_spring", {f})}), {&push});
    const auto energy = [&](std::size_t i) {
      return std::pow(r.points.at(i).slip_velocity_mps, 2) + std::pow(W * r.points.at(i).slip_m, 2);
    };
    for (const std::size_t i : {500u, 1500u, 3000u})
      EXPECT_NEAR(energy(i), energy(150), 1e-9 * energy(150)) << solver.name;
  }
}

}  // namespace
}  // namespace freestand::test
