// Law: a share r of the mass on a spring W and damping z inside; friction keeps the full weight.
#include "dynamics/laws.hpp"
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(MovingContents, General) {
  expect_general(
      {"moving_contents", {0.3, 2, 0.05}, {0.3, 2, 0.05}, {0, 2, 0.05}, {Model::slide, Model::slide_rock}, 8});
}

// Two states each: there is room for three of them in one sample. A fourth is an outcome, not dropped without a word.
TEST(MovingContents, StatesForWhichThereIsNoRoom) {
  const FloorMotion push = rectangular_pulse(4, 0.3);
  for (const Model model : {Model::slide, Model::slide_rock, Model::bouc_wen})
    for (const bool too_many : {false, true}) {
      Specimen block =
          sliding(0.2, std::vector<EffectUse>(too_many ? 4 : 3, effect("moving_contents", {0.1, 2, 0.05})));
      block.model = model;
      const Outcome wanted = too_many ? Outcome::not_finite : Outcome::moved;
      EXPECT_EQ(dynamics::Laws(block).excess, too_many ? dynamics::Excess::states : dynamics::Excess::none);
      for (const Solver& solver : both_solvers) EXPECT_EQ(solver(block, {&push}).outcome, wanted) << solver.name;
      const std::vector<Specimen> blocks(8, block);
      const std::vector<Shaking> shaking(8, Shaking{&push});
      std::vector<Response> responses(8);
      respond_batch(blocks, shaking, {}, responses);
      for (const Response& r : responses) EXPECT_EQ(r.outcome, wanted);
    }
}

// On ice nothing outside holds block and contents: their centre of mass stays where it was in space, and the block moves
// by r times the relative swing. After a floor step a the two swing against each other with W/sqrt(1 - r):
//   u' = -a t relative to the floor for both together; the block feels nothing else, since the floor does not touch it.
// A kick through friction that then vanishes cannot be had, so the swing is excited through friction: energy is kept
// between the stops. Here: the block stuck, contents at resonance give the force (1 - r) a - r (W^2 q + 2 z W q').
TEST(MovingContents, ShakeAStuckBlock) {
  const double r = 0.3, f = 1.5, W = 2 * pi * f, z = 0.05, Wd = W * std::sqrt(1 - z * z), a = 1;
  // Step a: q = -(a/W^2)[1 - exp(-zWt)(cos + z W/Wd sin)], and W^2 q + 2 z W q' = -(q'' + a) with
  // q'' = -a exp(-z W t) (cos W_d t - (z W/W_d) sin W_d t). The base carries f_x = a + r q''.
  double most = 0;
  for (double t = 0; t < 2; t += 1e-5) {
    const double q2 = -a * std::exp(-z * W * t) * (std::cos(Wd * t) - z * W / Wd * std::sin(Wd * t));
    most = std::fmax(most, a + r * q2);
  }
  const FloorMotion step = rectangular_pulse(a, 2);
  const auto outcome = [&](double mu, const Solver& solver) {
    return solver(sliding(mu, {effect("moving_contents", {r, f, z})}), {&step}).outcome;
  };
  for (const Solver& solver : both_solvers) {
    EXPECT_EQ(outcome(most / g * (1 + 1e-6), solver), Outcome::at_rest) << solver.name;
    EXPECT_EQ(outcome(most / g * (1 - 1e-6), solver), Outcome::moved) << solver.name;
  }
}

// Without damping and friction block and contents exchange their energy and keep it; the block swings about the motion
// of both with W/sqrt(1 - r). Excited by a centering spring's pull on the block, the two modes of
//   (1 - r) u'' = -S^2 u + r W^2 q,  q'' = -u'' - W^2 q      keep  (1 - r) u'^2 + r (u' + q')^2 + S^2 u^2 + r W^2 q^2.
TEST(MovingContents, KeepTheirEnergyOnIce) {
  const double r = 0.3, W = 2 * pi * 1.5, S = 2 * pi * 0.8, v = 0.3;
  const FloorMotion kick = staircase({0.02, 4}, {-v / 0.02, 0});
  for (const Solver& solver : both_solvers) {
    const Path found =
        run(solver, sliding(0, {effect("moving_contents", {r, 1.5, 0}), effect("centering_spring", {0.8})}), {&kick});
    // Fourth-order Runge-Kutta of the two equations from the end of the kick.
    double y[4] = {0, 0, 0, 0};  // u, u', q, q'
    const double h = 1e-4;
    for (int n = 0; n < 40000; ++n) {
      const double a = n < 200 ? -v / 0.02 : 0;
      const auto rate = [&](const double* s, double* d) {
        d[0] = s[1], d[2] = s[3];
        const double absolute = (-S * S * s[0] + r * W * W * s[2]) / (1 - r);
        d[1] = absolute - a, d[3] = -absolute - W * W * s[2];
      };
      double k1[4], k2[4], k3[4], k4[4], s[4];
      rate(y, k1);
      for (int i = 0; i < 4; ++i) s[i] = y[i] + h / 2 * k1[i];
      rate(s, k2);
      for (int i = 0; i < 4; ++i) s[i] = y[i] + h / 2 * k2[i];
      rate(s, k3);
      for (int i = 0; i < 4; ++i) s[i] = y[i] + h * k3[i];
      rate(s, k4);
      for (int i = 0; i < 4; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    EXPECT_NEAR(found.points.at(4000).slip_m, y[0], 1e-9) << solver.name;
    EXPECT_NEAR(found.points.at(4000).slip_velocity_mps, y[1], 1e-8) << solver.name;
  }
}

}  // namespace
}  // namespace freestand::test
