// Where the floor's last push holds a block that a force pulls: when it stands still the block goes, as on a floor that is told to
// stand still.
#include "effects/effect_fixture.hpp"

namespace freestand::test::end_of_motion_test {
namespace {

// Pushed at a steady a for 0.7 s, and then at nothing for another 3 s: told, or not.
FloorMotion pushed(double a_mps2, bool told) {
  return told ? staircase({0.7, 3.0}, {a_mps2, 0.0}) : staircase({0.7}, {a_mps2});
}

void expect_goes_on(const Specimen& specimen, double a_mps2) {
  const FloorMotion ends = pushed(a_mps2, false), stands_still = pushed(a_mps2, true);
  const Settings long_after{.free_vibration_s = 5}, after{.free_vibration_s = 2};
  for (const Solver& solver : both_solvers) {
    const Response found = solver(specimen, {&ends}, long_after, nullptr);
    const Response expected = solver(specimen, {&stands_still}, after, nullptr);
    EXPECT_EQ(found.outcome, expected.outcome);
    EXPECT_NEAR(found.slid_path_m, expected.slid_path_m, 1e-7);
    EXPECT_NEAR(found.residual_slip_m, expected.residual_slip_m, 1e-7);
    EXPECT_GT(found.end_time_s, 0.7);
  }
}

TEST(EndOfMotion, ATetherPullsTheBlockBack) {
  const Specimen block = sliding(0.4, {effect("slack_tether", {0.02, 3, 0})});
  expect_goes_on(block, -4.9);
  const FloorMotion push = pushed(-4.9, false);
  // Over 0.4 g it is pulled by (2 pi 3)^2 (u - 0.02 m): it comes back.
  const Response r = respond(block, {&push});
  EXPECT_LT(r.residual_slip_m, r.peak_slip_m - 0.002);
}

TEST(EndOfMotion, ASpringPullsTheBlockBack) { expect_goes_on(sliding(0.2, {effect("centering_spring", {1.6})}), -4.9); }

// tan(0.45) is more than the friction: without the floor's push, which held it, the block slides; one that is more slender falls.
TEST(EndOfMotion, ABlockOnASlopeGoes) {
  expect_goes_on(sliding(0.4, {effect("floor_tilt", {0.45})}), -4.2);
  Specimen tall = slender(1.0, {effect("floor_tilt", {0.3})});  // b/h = 0.22
  const FloorMotion push = pushed(-2.8, false);
  for (const Solver& solver : both_solvers) EXPECT_EQ(solver(tall, {&push}, {}, nullptr).outcome, Outcome::overturned);
}

// The same on a record, which packs know.
TEST(EndOfMotion, ABlockOnASlopeGoesInPacksToo) {
  const FloorMotion record = piecewise_linear("push", 0.01, std::vector<double>(71, -4.2));
  Specimen specimens[2] = {sliding(0.4, {effect("floor_tilt", {0.45})}), slender(1.0, {effect("floor_tilt", {0.45})})};
  const Shaking shakings[2] = {{&record}, {&record}};
  Response packed[2];
  respond_batch(specimens, shakings, {.free_vibration_s = 1}, packed);
  for (int i = 0; i < 2; ++i) {
    const Response alone = respond(specimens[i], shakings[i], {.free_vibration_s = 1});
    EXPECT_NE(alone.outcome, Outcome::at_rest);
    EXPECT_EQ(packed[i].outcome, alone.outcome);
    EXPECT_NEAR(packed[i].slid_path_m, alone.slid_path_m, 1e-7);
    EXPECT_NEAR(packed[i].peak_rotation_rad, alone.peak_rotation_rad, 1e-7);
  }
}

}  // namespace
}  // namespace freestand::test::end_of_motion_test
