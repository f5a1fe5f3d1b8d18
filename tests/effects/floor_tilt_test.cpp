// Law: g sin(beta) added to a, g cos(beta) in place of g.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(FloorTilt, General) { expect_general({"floor_tilt", {0.03}, {-0.03}, {0}}); }

// After a push the block slides down the slope (to the left) with g (mu cos b - sin b) of deceleration, up the slope
// with g (mu cos b + sin b).
TEST(FloorTilt, SlidesFartherDownTheSlope) {
  const double mu = 0.25, b = 0.05, a = 6, t1 = 0.1;
  const FloorMotion push = rectangular_pulse(-a, t1);
  for (const Solver& solver : both_solvers)
    for (const int sigma : {1, -1}) {
      const double m = g * (mu * std::cos(b) + sigma * std::sin(b));
      const Response r = solver(sliding(mu, {effect("floor_tilt", {b})}), {&push, double(sigma)});
      EXPECT_NEAR(r.residual_slip_m, sigma * (a - m) * t1 * t1 * a / (2 * m), 1e-10) << solver.name;
    }
}

// Steeper than the angle of friction nothing holds the block, without any shaking.
TEST(FloorTilt, ASlopeSteeperThanFrictionStartsTheSlide) {
  const FloorMotion still = rectangular_pulse(0, 1);
  for (const double b : {std::atan(0.2) - 1e-6, std::atan(0.2) + 1e-6}) {
    const Path r = run(fast_solver, sliding(0.2, {effect("floor_tilt", {b})}), {&still});
    EXPECT_EQ(r.response.outcome, b < std::atan(0.2) ? Outcome::at_rest : Outcome::moved);
    EXPECT_EQ(r.points.at(500).floor_acceleration_mps2, 0);  // the floor's own, without the slope
  }
}

// A steep enough slope turns the block over its lower corner: tan b > b/h.
TEST(FloorTilt, ASlopeSteeperThanTheBlockTurnsItOver) {
  const FloorMotion still = rectangular_pulse(0, 1);
  const double alpha = std::atan(0.4 / 1.8);
  EXPECT_EQ(respond(slender(0.8, {effect("floor_tilt", {alpha - 1e-3})}), {&still}).outcome, Outcome::at_rest);
  EXPECT_EQ(respond(slender(0.8, {effect("floor_tilt", {alpha + 1e-3})}), {&still}).outcome, Outcome::overturned);
}

}  // namespace
}  // namespace freestand::test
