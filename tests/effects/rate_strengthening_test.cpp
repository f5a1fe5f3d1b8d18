// Law: mu(w) = mu [1 + d (1 - exp(-w/c))].
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(RateStrengthening, General) { expect_general({"rate_strengthening", {0.6, 0.1}, {0.6, 0.1}, {0, 0.1}}); }

// Under a steady push a the block nears the speed at which mu(w) g = a: w = -c ln(1 - (a/(mu g) - 1)/d).
TEST(RateStrengthening, NearsTheSpeedAtWhichFrictionHoldsThePush) {
  const double mu = 0.2, d = 0.8, c = 0.05, a = 1.3 * mu * g;
  const FloorMotion push = rectangular_pulse(-a, 4);
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(mu, {effect("rate_strengthening", {d, c})}), {&push});
    EXPECT_NEAR(r.points.at(3990).slip_velocity_mps, -c * std::log(1 - 0.3 / d), 1e-9) << solver.name;
  }
}

}  // namespace
}  // namespace freestand::test
