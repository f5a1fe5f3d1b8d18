// Law: mu(S) = mu [r + (1 - r) exp(-S/l)].
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(FrictionWear, General) { expect_general({"friction_wear", {0.6, 0.1}, {0.6, 0.1}, {1, 0.1}}); }

// Energy: a block that slides with speed v at path S0 on the still floor has v^2/2 - w^2/2 = int mu(S) g dS
//   = mu g [r (S - S0) + (1 - r) l (exp(-S0/l) - exp(-S/l))].
TEST(FrictionWear, LosesTheWorkOfItsFriction) {
  const double mu = 0.3, r = 0.5, l = 0.05;
  const FloorMotion push = rectangular_pulse(-10, 0.1);
  for (const Solver& solver : both_solvers) {
    const Path found = run(solver, sliding(mu, {effect("friction_wear", {r, l})}), {&push});
    const auto &a = found.points.at(100), &b = found.points.at(250);
    ASSERT_GT(b.slip_velocity_mps, 0.1);
    const double work =
        mu * g * (r * (b.slip_m - a.slip_m) + (1 - r) * l * (std::exp(-a.slip_m / l) - std::exp(-b.slip_m / l)));
    EXPECT_NEAR(0.5 * (std::pow(a.slip_velocity_mps, 2) - std::pow(b.slip_velocity_mps, 2)), work, 1e-10)
        << solver.name;
  }
}

// What is worn stays worn at rest: a second push just under mu g moves the block that has slid, not the fresh one.
TEST(FrictionWear, HoldsLessAtRestAfterASlide) {
  const double mu = 0.3, low = 0.9 * mu * g;
  const FloorMotion twice = staircase({0.2, 1.0, 0.2}, {-6, 0, -low}), once = rectangular_pulse(-low, 0.2);
  const Specimen specimen = sliding(mu, {effect("friction_wear", {0.6, 0.02})});
  EXPECT_EQ(respond(specimen, {&once}).outcome, Outcome::at_rest);
  const Path r = run(fast_solver, specimen, {&twice});
  EXPECT_EQ(r.points.at(1150).mode, Mode::rest);
  EXPECT_EQ(r.points.at(1300).mode, Mode::slide);
}

}  // namespace
}  // namespace freestand::test
