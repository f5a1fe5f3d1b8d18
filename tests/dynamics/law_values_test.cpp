// Laws that look at the normal force, that have no value, or that differ by direction at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "dynamics/law_step.hpp"
#include "dynamics/laws_by_hand.hpp"
#include "support/floor_motions.hpp"
#include "support/solvers.hpp"

namespace freestand::test::law_values_test {
namespace {

using dynamics::At;
constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(LawValues);

Specimen block(Model model, std::vector<EffectUse> effects) {
  return {Block::rectangular(0.5, 1.6, 100), {0.2, 0.2}, {}, model, std::move(effects)};
}

// On a level floor the weight of a block that does not turn is m g: normal is 1.
TEST_P(LawValues, AForceMayLookAtTheNormalForce) {
  const FloorMotion motion = staircase({0.4, 0.5, 0.4}, {3.0, -4.0, 2.5});
  const auto run = [&](Law force) { return GetParam()(block(Model::slide, {force_law(force)}), {&motion}); };
  const Response by_weight = run([](const At& at) { return -0.5 * at.normal; });
  const Response steady = run([](const At& at) { return at.u.tape->constant(-0.5); });
  EXPECT_EQ(by_weight.peak_slip_m, steady.peak_slip_m);
  EXPECT_EQ(by_weight.residual_slip_m, steady.residual_slip_m);
}

// Half of the friction of a slipping corner, written as a force that looks at the normal force and as its moment about the
// centre of mass: on a corner the normal force depends on the force, and the force on it.
TEST_P(LawValues, HalfOfTheFrictionMayBeWrittenAsAForce) {
  const double mu = 0.28, b = 0.2, h = 0.8;
  for (const double peak : {7.0, 9.0, 12.0}) {
    const FloorMotion motion = rectangular_pulse(-peak, 0.15);
    const auto slides_on_a_corner = [&](double share) {
      const auto friction = [=](const At& at) { return (-share * mu * g) * (at.sigma * at.normal); };
      const auto turn = [=](const At& at) { return -(h * cos(at.theta) + b * at.side * sin(at.theta)) * friction(at); };
      Specimen s = block(Model::slide_rock, {law({}, friction, turn)});
      s.block = Block::rectangular(2 * b, 2 * h, 100);
      s.friction = {(1 - share) * mu, (1 - share) * mu};
      Settings settings;
      settings.free_vibration_s = 0;
      settings.tolerance = 1e-11;
      return GetParam()(s, {&motion}, settings);
    };
    const Response all = slides_on_a_corner(0), half = slides_on_a_corner(0.5);
    ASSERT_GT(all.peak_rotation_rad, 0.01);
    ASSERT_GT(all.slid_path_m, 0.005);
    EXPECT_NEAR(half.peak_rotation_rad, all.peak_rotation_rad, 1e-9) << peak;
    EXPECT_NEAR(half.slid_path_m, all.slid_path_m, 1e-9) << peak;
  }
}

// Where friction has no value the sample says so: it does not rest for ever.
TEST_P(LawValues, FrictionWithoutAValueIsAnOutcome) {
  const FloorMotion motion = rectangular_pulse(3.0, 0.4);
  const double none = std::nan("");
  for (const Model model : {Model::slide, Model::slide_rock}) {
    const auto nowhere = friction_law([none](const At& at) { return at.u.tape->constant(none); });
    EXPECT_EQ(GetParam()(block(model, {nowhere}), {&motion}).outcome, Outcome::not_finite);
    const auto no_force = force_law([none](const At& at) { return at.u.tape->constant(none); });
    EXPECT_EQ(GetParam()(block(model, {no_force}), {&motion}).outcome, Outcome::not_finite);
  }
}

// A force that pushes to the right only as the block is about to go there.
TEST_P(LawValues, RestLooksAtBothDirections) {
  const FloorMotion motion = rectangular_pulse(-1.5, 0.4);  // mu g = 1.96
  const auto helped = force_law([](const At& at) { return 0.7 * (at.sigma + 1.0); });
  const Response still = GetParam()(block(Model::slide, {}), {&motion});
  ASSERT_EQ(still.outcome, Outcome::at_rest);
  EXPECT_EQ(GetParam()(block(Model::slide, {helped}), {&motion}).outcome, Outcome::moved);
}

// Stuck on a corner that turns, the friction that could be had is that of the force on the corner, which is not the weight:
// with mu (N/(m g))^k it is mu_s (f_y/g)^k f_y.
TEST(LawAtRest, GripOnACornerLooksAtItsOwnNormalForce) {
  const double k = 0.4;
  Specimen s = block(Model::slide_rock, {friction_law([k](const At& at) { return pow(at.normal, k); })});
  const dynamics::Rig rig(s, {});
  dynamics::State state;
  state.mode = Mode::rock;
  state.pivot = 1;
  state.theta = 0.05;
  state.omega = -0.3;
  const dynamics::Floor<double, 3> floor{{2.0, 1.0, 0, 0}, {g, 0.5, 0, 0}};
  const dynamics::LawArc<3> arc = dynamics::LawStep<3>(rig, state, 0, floor).run();
  ASSERT_LT(arc.fy[0], 0.95 * g);
  const double grip = 0.2 * std::pow(arc.fy[0] / g, k) * arc.fy[0];
  EXPECT_NEAR(arc.limit_right[0], grip, 1e-14);
  EXPECT_NEAR(arc.limit_left[0], grip, 1e-14);
  EXPECT_NEAR(arc.limit_right[1], grip * (1 + k) * arc.fy[1] / arc.fy[0], 1e-12);  // its rate
}

// if(sigma > 0, ...) is directional_friction, whichever way the block is about to go.
TEST_P(LawValues, ACaseForEachDirectionHoldsAtRest) {
  const FloorMotion motion = staircase({0.4, 0.5, 0.4, 0.5}, {-1.75, 0.0, 1.75, 0.0});  // mu g = 1.96
  for (const double asymmetry : {-0.2, 0.2}) {
    const auto smooth = friction_law([=](const At& at) { return 1.0 + asymmetry * at.sigma; });
    const auto by_case = friction_law([=](const At& at) { return (1 - asymmetry) + step(at.sigma) * (2 * asymmetry); });
    for (const Model model : {Model::slide, Model::slide_rock}) {
      const Response expected = GetParam()(block(model, {smooth}), {&motion});
      const Response found = GetParam()(block(model, {by_case}), {&motion});
      ASSERT_GT(expected.peak_slip_m, 0.001);
      EXPECT_NEAR(found.peak_slip_m, expected.peak_slip_m, 1e-9) << asymmetry;
      EXPECT_NEAR(found.residual_slip_m, expected.residual_slip_m, 1e-9) << asymmetry;
    }
  }
}

// What is zero for long (a speed at rest, the rotation of a block that stands) is not greater than zero: friction that falls when the
// block slips is static friction, that of a tilted block no affair of one that stands, and one of a first slip holds until then.
TEST_P(LawValues, WhatIsZeroForLongIsNotGreater) {
  const FloorMotion motion = staircase({0.3, 0.2, 0.4, 0.3, 0.2, 0.5, 0.4}, {-4.5, 5.0, -4.8, 4.2, -3.0, -5.0, 0.0});
  const auto falls_by_half_beyond = [](auto what) {
    return friction_law([what](const At& at) { return 2.0 - step(what(at)); });
  };
  const auto same = [&](const Specimen& law, const Specimen& plain) {
    const Response found = GetParam()(law, {&motion}), expected = GetParam()(plain, {&motion});
    ASSERT_GT(expected.peak_slip_m, 0.01);
    EXPECT_EQ(found.outcome, expected.outcome);
    EXPECT_NEAR(found.peak_slip_m, expected.peak_slip_m, 1e-9);
    EXPECT_NEAR(found.residual_slip_m, expected.residual_slip_m, 1e-9);
    EXPECT_NEAR(found.slid_path_m, expected.slid_path_m, 1e-9);
  };
  Specimen with_static = block(Model::slide, {});
  with_static.friction.mu_s = 2 * with_static.friction.mu_k;
  Specimen rough = with_static;
  rough.friction.mu_k = rough.friction.mu_s;
  same(block(Model::slide, {falls_by_half_beyond([](const At& at) { return at.speed; })}), with_static);
  same(block(Model::slide, {falls_by_half_beyond([](const At& at) { return abs(at.v); })}), with_static);
  same(block(Model::slide, {falls_by_half_beyond([](const At& at) { return abs(at.theta); })}), rough);

  const FloorMotion once = staircase({0.2, 0.3, 0.5, 1.0}, {-3.0, -4.5, 0.0, 0.0});
  const Response held =
      GetParam()(block(Model::slide, {falls_by_half_beyond([](const At& at) { return at.path; })}), {&once});
  const Response expected = GetParam()(with_static, {&once});
  ASSERT_GT(expected.peak_slip_m, 0.01);
  EXPECT_NEAR(held.peak_slip_m, expected.peak_slip_m, 1e-9);
}

// A slip to the left ends while the floor pushes to the right, by less than friction at rest holds: it is at rest, though the condition
// on its velocity was met at that very instant. Between +2.5 m/s2 for 0.2 s and -1.2 m/s2: w = -(2.5 - 0.17 g) 0.2 s, ended by
// 1.2 m/s2 + 0.17 g.
TEST_P(LawValues, AConditionThatIsMetWhereASlipEndsIsOver) {
  const FloorMotion motion = staircase({0.2, 0.6, 0.2}, {2.5, -1.2, 0.0});
  Specimen s = block(Model::slide, {friction_law([](const At& at) { return 1.7 - 0.9 * step(at.v); })});
  s.friction = {0.1, 0.1};
  const double hold = 0.17 * g, w = (2.5 - hold) * 0.2;
  const double slip = 0.5 * w * 0.2 + 0.5 * w * w / (1.2 + hold);
  const Response found = GetParam()(s, {&motion});
  EXPECT_NEAR(found.peak_slip_m, slip, 1e-9);
  EXPECT_NEAR(found.residual_slip_m, -slip, 1e-9);
}

// A condition on conditions turns with them: friction that falls after 0.3 s lets the block go, however that is written.
TEST_P(LawValues, ConditionsOnConditionsTurnWithThem) {
  const FloorMotion motion = staircase({0.2, 0.5, 0.2}, {1.5, -1.75, 1.4});  // mu g = 1.96
  const auto run = [&](Law friction) { return GetParam()(block(Model::slide, {friction_law(friction)}), {&motion}); };
  const Response plain = run([](const At& at) { return where(at.t - 0.3, at.t * 0.0 + 0.4, at.t * 0.0 + 1.0); });
  const Response either =
      run([](const At& at) { return where(step(at.t - 0.3) + step(at.u - 10.0), at.t * 0.0 + 0.4, at.t * 0.0 + 1.0); });
  const Response least = run([](const At& at) { return min(at.t * 0.0 + 1.0, 1.1 - 0.7 * step(at.t - 0.3)); });
  ASSERT_EQ(plain.outcome, Outcome::moved);
  // Of a condition on the velocity: it asks which way the block goes, which depends on what it says.
  const auto both = [](const At& at) { return min(at.t * 0.0 + 0.85, 0.95 - 0.55 * step(at.v)); };
  const auto one = [](const At& at) { return 0.85 - 0.45 * step(at.v); };
  EXPECT_NEAR(run(both).peak_slip_m, run(one).peak_slip_m, 1e-7);
  EXPECT_NEAR(run(both).residual_slip_m, run(one).residual_slip_m, 1e-7);
  ASSERT_GT(run(one).peak_slip_m, 0.01);
  for (const Response& other : {either, least}) {
    EXPECT_EQ(other.outcome, Outcome::moved);
    EXPECT_NEAR(other.peak_slip_m, plain.peak_slip_m, 1e-9);
    EXPECT_NEAR(other.residual_slip_m, plain.residual_slip_m, 1e-9);
  }
}

// max(normal, 1e-6) bends where the block takes off, and is normal again when it has landed.
TEST_P(LawValues, AKinkOfTheNormalForceIsOverAfterALanding) {
  const FloorMotion throws = staircase({0.3, 0.2, 0.5, 0.6}, {-3.0, 2.0, -4.0, 0.0}, {4.0, -14.0, 6.0, 0.0});
  for (const Model model : {Model::slide, Model::slide_rock}) {
    const auto plain = friction_law([](const At& at) { return at.normal; });
    const auto bent = friction_law([](const At& at) { return max(at.normal, at.normal * 0.0 + 1e-6); });
    const Shaking shaking{&throws, 1, 1, 1};
    const Response expected = GetParam()(block(model, {plain}), shaking);
    const Response found = GetParam()(block(model, {bent}), shaking);
    ASSERT_EQ(expected.outcome, Outcome::moved);
    EXPECT_EQ(found.outcome, Outcome::moved);
    EXPECT_NEAR(found.slid_path_m, expected.slid_path_m, 1e-8);
    EXPECT_NEAR(found.residual_slip_m, expected.residual_slip_m, 1e-8);
  }
}

// Ten thousand knots within a tenth of 1/p are a fine record, not a standstill.
TEST_P(LawValues, ManyKnotsAreNoStandstill) {
  FloorMotion fine;
  fine.degree = 1;
  const int knots = 30000;
  const double step = 1e-6;
  for (int i = 0; i <= knots; ++i) fine.knot_s.push_back(step * i);
  for (int i = 0; i < knots; ++i) fine.horizontal_mps2.insert(fine.horizontal_mps2.end(), {-6.0, 0.0});
  Settings settings;
  settings.free_vibration_s = 1;
  const Specimen plain = block(Model::slide_rock, {});
  const auto drag = force_law([](const At& at) { return -0.1 * at.v; });
  EXPECT_EQ(respond(plain, {&fine}, settings).outcome, Outcome::moved);
  EXPECT_EQ(respond(block(Model::slide_rock, {drag}), {&fine}, settings).outcome, Outcome::moved);
}

}  // namespace
}  // namespace freestand::test::law_values_test
