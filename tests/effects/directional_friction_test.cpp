// Law: mu (1 + d sigma).
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(DirectionalFriction, General) { expect_general({"directional_friction", {0.2}, {-0.2}, {0}}); }

// A push a for t1 leaves speed (a - m g) t1 and ends after U = (a - m g) t1^2 a/(2 m g) in all, m = mu (1 + d sigma).
TEST(DirectionalFriction, SlidesFartherTheEasyWay) {
  const double mu = 0.25, d = 0.2, a = 6, t1 = 0.1;
  const FloorMotion push = rectangular_pulse(-a, t1);
  for (const Solver& solver : both_solvers)
    for (const int sigma : {1, -1}) {
      const double m = mu * (1 + d * sigma) * g;
      const Response r = solver(sliding(mu, {effect("directional_friction", {d})}), {&push, double(sigma)});
      EXPECT_NEAR(r.residual_slip_m, sigma * (a - m) * t1 * t1 * a / (2 * m), 1e-10) << solver.name;
    }
}

TEST(DirectionalFriction, HoldsDifferentPushesToEitherSide) {
  for (const int sigma : {1, -1})
    for (const double share : {0.999, 1.001}) {
      const double m = 0.25 * (1 + 0.2 * sigma) * g;
      const FloorMotion push = rectangular_pulse(-sigma * m * share, 0.5);
      const Response r = respond(sliding(0.25, {effect("directional_friction", {0.2})}), {&push});
      EXPECT_EQ(r.outcome, share < 1 ? Outcome::at_rest : Outcome::moved) << sigma;
    }
}

}  // namespace
}  // namespace freestand::test
