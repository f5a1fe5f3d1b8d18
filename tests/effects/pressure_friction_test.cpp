// Law: mu (N/(m g))^k.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(PressureFriction, General) { expect_general({"pressure_friction", {-0.4}, {-0.4}, {0}, {Model::slide_rock}}); }

// The floor accelerates upwards by v: N = m (g + v), so that w' = a - mu ((g + v)/g)^k (g + v).
TEST(PressureFriction, FollowsTheNormalForce) {
  const double mu = 0.2, v = 3;
  const FloorMotion lift = staircase({0.2, 0.5}, {-5, 0}, {v, 0});
  for (const Solver& solver : both_solvers)
    for (const double k : {-0.4, 0.5, 2.0}) {
      const Path r = run(solver, sliding(mu, {effect("pressure_friction", {k})}), {&lift, 1, 1, 1});
      EXPECT_NEAR(r.points.at(150).slip_velocity_mps, (5 - mu * std::pow((g + v) / g, k) * (g + v)) * 0.15, 1e-11)
          << solver.name << k;
    }
}

}  // namespace
}  // namespace freestand::test
