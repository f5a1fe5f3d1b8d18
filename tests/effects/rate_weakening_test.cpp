// Law: mu(w) = mu [1 - d (1 - exp(-w/c))].
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(RateWeakening, General) { expect_general({"rate_weakening", {0.4, 0.1}, {0.4, 0.1}, {0, 0.1}}); }

// A block kicked to speed v by a push of the floor slows down on the still floor by dw/dt = -mu(w) g; with E = exp(w/c)
// dw / (A + B/E) has the closed integral t = (c/(mu g A)) ln[(A exp(v/c) + d)/(A exp(w/c) + d)], A = 1 - d.
TEST(RateWeakening, SlowsDownAsItsIntegralSays) {
  const double mu = 0.25, d = 0.4, c = 0.1, A = 1 - d;
  const FloorMotion push = rectangular_pulse(-8, 0.1);
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(mu, {effect("rate_weakening", {d, c})}), {&push});
    const double v = r.points.at(100).slip_velocity_mps;
    ASSERT_GT(v, 0.3);
    for (const std::size_t i : {150u, 200u, 250u}) {
      const double w = r.points.at(i).slip_velocity_mps;
      ASSERT_GT(w, 0) << i;
      const double t = c / (mu * g * A) * std::log((A * std::exp(v / c) + d) / (A * std::exp(w / c) + d));
      EXPECT_NEAR(t, (static_cast<double>(i) - 100) * 0.001, 1e-9) << solver.name;
    }
  }
}

// At rest nothing is weaker: the block starts where mu g says.
TEST(RateWeakening, LeavesStaticFrictionAlone) {
  for (const double a : {0.2499, 0.2501}) {
    const FloorMotion push = rectangular_pulse(a * g, 0.2);
    const Response r = respond(sliding(0.25, {effect("rate_weakening", {0.5, 0.1})}), {&push});
    EXPECT_EQ(r.outcome, a < 0.25 ? Outcome::at_rest : Outcome::moved);
  }
}

}  // namespace
}  // namespace freestand::test
