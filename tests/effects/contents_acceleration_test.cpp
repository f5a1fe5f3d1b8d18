// What hangs inside feels the force of its spring: a response spectrum in a block that is stuck, and the histories of its states elsewhere.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/effect_fixture.hpp"
#include "motion/spectrum.hpp"
#include "support/floor_motions.hpp"

namespace freestand::test::contents_acceleration_test {
namespace {

double felt(const Solver& solver, const Specimen& specimen, const Shaking& shaking) {
  Settings settings;
  settings.tolerance = 1e-12;
  settings.contact_forces = true;
  return solver(specimen, shaking, settings, nullptr).peak_contents_acceleration_mps2;
}

// Without damping the total acceleration is W^2 |q|, the pseudo-acceleration, whatever the mass.
TEST(ContentsAcceleration, InABlockThatIsStuckIsTheResponseSpectrum) {
  const FloorMotion sine = one_sine();
  CaseFamily family;
  family.seed = 5;
  family.vertical = 0;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  const RandomCase noise = random_case(family, 1);
  for (const double frequency_hz : {0.7, 2.0, 6.0})
    for (const Shaking& shaking : {Shaking{.motion = &sine, .scale = 3, .stretch = 0.6}, noise.shaking}) {
      const double spectrum = std::abs(shaking.scale) * motion::spectral_acceleration_mps2(
                                                            *shaking.motion, 1 / (frequency_hz * shaking.stretch), 0);
      const Specimen block = sliding(50, {effect("moving_contents", {0.3, frequency_hz, 0})});
      EXPECT_NEAR(felt(fast_solver, block, shaking), spectrum, 1e-9 * spectrum) << frequency_hz;
      // The reference looks at its steps alone, h long, between which a peak stands out by (W h)^2/8 of it.
      EXPECT_NEAR(felt(reference_solver, block, shaking), spectrum, 1e-4 * spectrum) << frequency_hz;
    }
}

// On ice the block and its contents are two masses on a spring, which the floor leaves alone: from its jerk on both go on at W / sqrt(1 - r)
// about their common centre. Friction that is next to nothing moves them by as little.
TEST(ContentsAcceleration, OnIceIsNextToNothing) {
  const FloorMotion push = rectangular_pulse(4, 0.3);
  const double stuck = felt(fast_solver, sliding(50, {effect("moving_contents", {0.3, 2.0, 0})}), {&push});
  const double ice = felt(fast_solver, sliding(1e-3, {effect("moving_contents", {0.3, 2.0, 0})}), {&push});
  EXPECT_GT(stuck, 4);
  EXPECT_LT(ice, 0.05);
}

TEST(ContentsAcceleration, IsNoNumberWhereNothingAsksForIt) {
  const FloorMotion push = rectangular_pulse(4, 0.3);
  const Specimen block = sliding(0.2, {effect("moving_contents", {0.3, 2.0, 0.02})});
  EXPECT_TRUE(std::isnan(respond(block, {&push}).peak_contents_acceleration_mps2));
  EXPECT_EQ(respond(sliding(0.2), {&push}, {.contact_forces = true}).peak_contents_acceleration_mps2, 0);
}

}  // namespace
}  // namespace freestand::test::contents_acceleration_test
