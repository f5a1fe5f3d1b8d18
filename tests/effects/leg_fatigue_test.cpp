// How legs flex: of a foot that is stuck an oscillator, whose sway is integrated here in small steps and counted at its turning points.
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/rainflow.hpp"
#include "effects/effect_fixture.hpp"
#include "support/floor_motions.hpp"

namespace freestand::test::leg_fatigue_test {
namespace {

Response on_legs(const Solver& solver, double mu, double frequency_hz, double damping, const Shaking& shaking) {
  Settings settings;
  settings.tolerance = 1e-12;
  settings.contact_forces = true;
  return solver(sliding(mu, {effect("flexible_legs", {frequency_hz, damping})}), shaking, settings, nullptr);
}

struct Sway {
  double peak = 0, fatigue = 0;
};

// y'' + 2 z W y' + W^2 y = -a(t), Runge and Kutta.
Sway oscillator(double frequency_hz, double damping, const Shaking& shaking, double until) {
  const double W = 2 * M_PI * frequency_hz, h = 1e-4;
  const auto rate = [&](double t, double y, double v) {
    return -horizontal_acceleration(shaking, t) - 2 * damping * W * v - W * W * y;
  };
  Sway sway;
  dynamics::Rainflow cycles;
  cycles.see(0);
  double y = 0, v = 0;
  for (double t = 0; t < until; t += h) {
    const double k1 = rate(t, y, v), y2 = y + h / 2 * v, v2 = v + h / 2 * k1, k2 = rate(t + h / 2, y2, v2),
                 y3 = y + h / 2 * v2, v3 = v + h / 2 * k2, k3 = rate(t + h / 2, y3, v3), y4 = y + h * v3,
                 v4 = v + h * k3, k4 = rate(t + h, y4, v4);
    y += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    sway.peak = std::max(sway.peak, std::abs(y));
    cycles.see(y);
  }
  sway.fatigue = cycles.amplitude();
  return sway;
}

TEST(LegFatigue, OfAFootThatIsStuckIsThatOfAnOscillator) {
  CaseFamily family;
  family.seed = 9;
  family.vertical = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 4;
  const RandomCase noise = random_case(family, 2);
  for (const double frequency_hz : {1.5, 4.0, 9.0}) {
    const Response found = on_legs(fast_solver, 50, frequency_hz, 0.03, noise.shaking);
    const Sway exact = oscillator(frequency_hz, 0.03, noise.shaking, noise.shaking.duration_s() + 20 / frequency_hz);
    // Between steps of h a turning point stands out by (W h)^2/8.
    EXPECT_NEAR(found.peak_leg_deflection_m, exact.peak, 1e-5 * exact.peak) << frequency_hz;
    EXPECT_NEAR(found.leg_fatigue_m, exact.fatigue, 1e-4 * exact.fatigue) << frequency_hz;
    const Response reference = on_legs(reference_solver, 50, frequency_hz, 0.03, noise.shaking);
    EXPECT_NEAR(reference.leg_fatigue_m, exact.fatigue, 1e-3 * exact.fatigue) << frequency_hz;
  }
}

// A floor that starts with a jump: the first swing, from upright to its far end, counts as well, at the tolerance of a sweep too.
TEST(LegFatigue, CountsTheFirstSwing) {
  const FloorMotion push = rectangular_pulse(2, 2);
  Settings settings;
  settings.contact_forces = true;
  for (const double damping : {0.02, 0.08, 0.3})
    for (const Solver& solver : both_solvers) {
      const Response found = solver(sliding(50, {effect("flexible_legs", {5, damping})}), {&push}, settings, nullptr);
      EXPECT_NEAR(found.leg_fatigue_m, oscillator(5, damping, {&push}, 6).fatigue, 1e-6) << damping;
    }
}

// Legs pull a foot that slips with no more than its friction: W^2 y <= mu g but for damping.
TEST(LegFatigue, OfAFootThatSlipsIsHeldByFriction) {
  const FloorMotion sine = one_sine();
  const double W = 2 * M_PI * 3, mu = 0.1;
  const Response found = on_legs(fast_solver, mu, 3, 0.005, {.motion = &sine, .scale = 10});
  EXPECT_GT(found.peak_slip_m, 0.1);
  EXPECT_LE(found.peak_leg_deflection_m, mu * 9.80665 / (W * W) * 1.02);
  EXPECT_GT(found.peak_leg_deflection_m, mu * 9.80665 / (W * W) * 0.9);
}

TEST(LegFatigue, IsNoNumberWhereNothingAsksForIt) {
  const FloorMotion push = rectangular_pulse(4, 0.3);
  const Specimen block = sliding(0.2, {effect("flexible_legs", {5.0, 0.02})});
  EXPECT_TRUE(std::isnan(respond(block, {&push}).leg_fatigue_m));
  EXPECT_EQ(respond(sliding(0.2), {&push}, {.contact_forces = true}).leg_fatigue_m, 0);
}

}  // namespace
}  // namespace freestand::test::leg_fatigue_test
