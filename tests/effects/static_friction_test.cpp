// Law: mu_s = r mu_k.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(StaticFriction, General) { expect_general({"static_friction", {1.5}, {1.5}, {1}}); }

// On a ramp a = j t the slip starts at t = r mu g/j; from then on w' = j t - mu g, so that after s seconds
// w = (r - 1) mu g s + j s^2/2.
TEST(StaticFriction, SlipStartsLateAndWithAJerk) {
  const double mu = 0.2, r = 1.4, j = 5, start = r * mu * g / j;
  const FloorMotion ramp = piecewise_linear("ramp", 1.0, {0, -j, 0});
  for (const Solver& solver : both_solvers) {
    const Path found = run(solver, sliding(mu, {effect("static_friction", {r})}), {&ramp});
    const std::size_t i = 700;
    const double s = 0.7 - start;
    ASSERT_GT(s, 0.1);
    EXPECT_NEAR(found.points.at(i).slip_velocity_mps, (r - 1) * mu * g * s + j * s * s / 2, 1e-10) << solver.name;
    EXPECT_EQ(found.points.at(static_cast<std::size_t>(start * 1000) - 1).mode, Mode::rest);
  }
}

}  // namespace
}  // namespace freestand::test
