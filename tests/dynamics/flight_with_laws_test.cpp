// Flight under laws, against what a body in free fall does.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "dynamics/laws_by_hand.hpp"
#include "support/floor_motions.hpp"
#include "support/solvers.hpp"

namespace freestand::test::flight_with_laws_test {
namespace {

constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(FlightWithLaws);

// The floor falls away under the block at twice gravity, and moves to the left.
FloorMotion falling_floor() { return staircase({0.3, 1.0}, {-1.0, 0.0}, {-2 * g, 0.0}); }

Specimen block(std::vector<EffectUse> effects) {
  return {Block::rectangular(0.5, 0.8, 100), {0.3, 0.3}, {}, Model::slide_rock, std::move(effects)};
}

Response shaken(const Solver& solver, const Specimen& specimen, const FloorMotion& motion) {
  Settings settings;
  settings.tolerance = 1e-12;
  settings.free_vibration_s = 2;
  return solver(specimen, Shaking{&motion, 1, 1, 1}, settings);
}

// A kink that is met in the air changes the law, not where the block is.
TEST_P(FlightWithLaws, AKinkLeavesTheBlockWhereItIs) {
  const FloorMotion motion = falling_floor();
  const Response plain = shaken(GetParam(), block({}), motion);
  ASSERT_GT(plain.peak_slip_m, 0.1);
  for (const double at : {0.0115, 0.05, 0.11}) {
    const EffectUse weak = force_law([at](const dynamics::At& here) { return -1e-9 * positive(here.u - at); });
    const Response bent = shaken(GetParam(), block({weak}), motion);
    EXPECT_NEAR(bent.peak_slip_m, plain.peak_slip_m, 1e-7) << at;
    EXPECT_NEAR(bent.residual_slip_m, plain.residual_slip_m, 1e-7) << at;
  }
}

// A piecewise linear motion is the same motion on a finer grid. On a spring of 20 Hz a block in the air swings.
TEST_P(FlightWithLaws, DoesNotDependOnTheGridOfTheRecord) {
  const double W = 2 * pi * 20;
  const EffectUse spring = force_law([W](const dynamics::At& at) { return -(W * W) * at.u; });
  const auto response = [&](int splits) {
    FloorMotion motion;
    motion.degree = 1;
    const double coarse = 0.05;
    for (int i = 0; i <= 20 * splits; ++i) motion.knot_s.push_back(coarse / splits * i);
    const auto value = [&](double peak, double t) {  // a triangle of 0.2 s, again and again
      const double phase = std::fmod(t, 0.2) / 0.1;
      return peak * (phase < 1 ? phase : 2 - phase);
    };
    for (int i = 0; i < 20 * splits; ++i) {
      const double t0 = motion.knot_s[static_cast<std::size_t>(i)], t1 = motion.knot_s[static_cast<std::size_t>(i) + 1];
      const double middle = 0.5 * (t0 + t1), slope = std::fmod(middle, 0.2) < 0.1 ? 1 / 0.1 : -1 / 0.1;
      motion.horizontal_mps2.insert(motion.horizontal_mps2.end(),
                                    {value(4, middle) - 4 * slope * (middle - t0), 4 * slope});
      motion.vertical_mps2.insert(motion.vertical_mps2.end(),
                                  {-(value(15, middle) - 15 * slope * (middle - t0)), -15 * slope});
    }
    return shaken(GetParam(), block({spring}), motion);
  };
  const Response coarse = response(1), fine = response(10);
  ASSERT_GT(fine.impacts, 0);
  EXPECT_EQ(coarse.outcome, Outcome::moved);
  EXPECT_NEAR(coarse.peak_slip_m, fine.peak_slip_m, 1e-9);
  EXPECT_NEAR(coarse.residual_slip_m, fine.residual_slip_m, 1e-9);
}

// In the air the block's own acceleration is gravity and what laws add, on a tilted floor as on a level one.
TEST_P(FlightWithLaws, PeakAccelerationIsGravityAndTheAddedForce) {
  const FloorMotion motion = falling_floor();
  const double pull = 4.0;
  const EffectUse steady = force_law([pull](const dynamics::At& at) { return at.u.tape->constant(pull); });
  Specimen icy = block({steady});
  icy.friction = {0, 0};
  EXPECT_NEAR(shaken(GetParam(), icy, motion).peak_acceleration_mps2, std::hypot(g, pull), 1e-6);

  auto* tilt = new dynamics::Effect{};
  const double angle = 0.3;
  tilt->floor = [angle](dynamics::FloorInput& floor, const dynamics::Parameters&) {
    floor.push_mps2 = g * std::sin(angle);
    floor.gravity_factor = std::cos(angle);
  };
  Specimen tilted = block({{tilt, {}}});
  tilted.model = Model::slide;
  tilted.friction = {0, 0};
  EXPECT_NEAR(shaken(GetParam(), tilted, motion).peak_acceleration_mps2, g, 1e-9);
}

// A moment turns nothing that the model does not let turn, in the air neither.
TEST_P(FlightWithLaws, ABlockThatOnlySlidesFliesWithoutTurning) {
  const FloorMotion throws = staircase({0.2, 0.3, 0.5}, {-4.0, -1.0, 0.0}, {0.0, -14.0, 5.0});
  Specimen block{Block::rectangular(0.5, 1.6, 100), {0.2, 0.2}, {}, Model::slide, {}};
  const auto pull = [](const dynamics::At& at) { return -1.0 * at.u; };
  block.effects = {law({}, pull)};
  const Response plain = GetParam()(block, Shaking{&throws, 1, 1, 1});
  block.effects = {law({}, pull, [](const dynamics::At& at) { return -2.0 * at.u; })};
  const Response turned = GetParam()(block, Shaking{&throws, 1, 1, 1});
  EXPECT_EQ(plain.outcome, Outcome::moved);
  EXPECT_EQ(turned.outcome, Outcome::moved);
  EXPECT_EQ(turned.peak_rotation_rad, 0);
  EXPECT_EQ(turned.residual_slip_m, plain.residual_slip_m);
}

}  // namespace
}  // namespace freestand::test::flight_with_laws_test
