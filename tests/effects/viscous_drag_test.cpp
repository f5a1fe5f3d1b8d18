// Law: force -m c v.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(ViscousDrag, General) { expect_general({"viscous_drag", {2}, {2}, {0}}); }

// w' = a - mu g - c w: w = (a - mu g)/c (1 - exp(-c t)); then w' = -mu g - c w: it stops after
// t = ln(1 + c v/(mu g))/c.
TEST(ViscousDrag, SpeedsUpAndStopsExponentially) {
  const double mu = 0.2, c = 3, a = 5, t1 = 0.4;
  const FloorMotion push = rectangular_pulse(-a, t1);
  for (const Solver& solver : both_solvers) {
    const Path r = run(solver, sliding(mu, {effect("viscous_drag", {c})}), {&push});
    const double v = (a - mu * g) / c * (1 - std::exp(-c * t1));
    EXPECT_NEAR(r.points.at(400).slip_velocity_mps, v, 1e-10) << solver.name;
    EXPECT_NEAR(r.response.end_time_s, t1 + std::log(1 + c * v / (mu * g)) / c, 1e-9) << solver.name;
    // What was slid in the second part: (v - mu g t)/c with t the time to stop.
    const double stop = std::log(1 + c * v / (mu * g)) / c;
    EXPECT_NEAR(r.response.residual_slip_m - r.points.at(400).slip_m, (v - mu * g * stop) / c, 1e-10) << solver.name;
  }
}

}  // namespace
}  // namespace freestand::test
