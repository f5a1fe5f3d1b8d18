// Laws with a root, a power or a branch that has no series where the block rests or a slip begins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "formula/formula.hpp"
#include "support/bouc_wen_cases.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"

namespace freestand::formula {
namespace {

template <class F>
double integral(F&& f, double from, double to) {
  constexpr int panels = 4000;  // Simpson
  const double h = (to - from) / panels;
  double sum = f(from) + f(to);
  for (int i = 1; i < panels; ++i) sum += (i % 2 ? 4 : 2) * f(from + i * h);
  return sum * h / 3;
}

Specimen sliding_block(const dynamics::Effect& law) {
  Specimen specimen{Block::rectangular(1, 1, 1), {0.3, 0.3}, {}};
  specimen.model = Model::slide;
  specimen.effects = {{&law, {}}};
  return specimen;
}

// The floor is pushed by A for a second, and friction c (1 + sqrt(w)) holds the block: with s = sqrt(w), 2 s s' = A - c - c s, so
// that time and path are integrals of smooth functions of s. Then it stops: 2 s s' = -c - c s.
TEST(NearZero, FrictionWithARootOfTheSpeedIsItsClosedForm) {
  const double A = 5, c = 0.3 * standard_gravity_mps2;
  const auto rate = [&](double s) { return A - c - c * s; };
  double low = 0, high = (A - c) / c;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high);
    (integral([&](double x) { return 2 * x / rate(x); }, 0, s) < 1 ? low : high) = s;
  }
  const double slip = integral([&](double s) { return 2 * s * s * s / rate(s); }, 0, low) +
                      integral([&](double s) { return 2 * s * s * s / (c + c * s); }, 0, low);
  const dynamics::Effect law = effect("root", "0.3*(1 + sqrt(speed))", "", {});
  const Specimen specimen = sliding_block(law);
  const FloorMotion motion = test::staircase({1, 2}, {A, 0});
  for (const auto solve : {respond, respond_reference}) {
    const Response r = solve(specimen, {&motion, 1}, {}, nullptr);
    EXPECT_EQ(r.outcome, Outcome::moved);
    EXPECT_NEAR(r.slid_path_m, slip, 1e-8);
  }
}

TEST(NearZero, LawsThatAUserWritesHaveAnAnswer) {
  const std::vector<std::pair<const char*, const char*>> laws = {{"0.3*(1 + sqrt(speed))", ""},
                                                                 {"0.2 + 0.1*abs(v)^0.3", ""},
                                                                 {"0.3 + sqrt(max(u - 0.02, 0))", ""},
                                                                 {"0.2 + 0.05*speed^(0.5 + path)", ""},
                                                                 {"", "-1e3*max(u - 0.02, 0)^1.5"},
                                                                 {"", "-5*abs(v)^1.5*if(v > 0, 1, -1)"},
                                                                 {"", "-30*if(u > 0.02, sqrt(u - 0.02), 0)"}};
  test::CaseFamily family;
  family.seed = 21;
  family.alpha_high = 0.6;
  family.duration_high_s = 6;
  Settings tight;
  tight.tolerance = 1e-11;  // a hundred impacts amplify what a step may miss
  for (const auto& [friction, force] : laws) {
    const dynamics::Effect law = effect("law", friction, force, {});
    int moved = 0;
    for (std::uint64_t number = 0; number < 12; ++number) {
      test::RandomCase c = test::random_case(family, number);
      c.specimen.effects = {{&law, {}}};
      const Response fast = respond(c.specimen, c.shaking, tight),
                     reference = respond_reference(c.specimen, c.shaking, tight);
      EXPECT_THAT(fast.outcome, testing::AnyOf(Outcome::moved, Outcome::at_rest, Outcome::overturned))
          << friction << force << c.text();
      moved += fast.outcome == Outcome::moved;
      EXPECT_EQ(fast.outcome, reference.outcome) << friction << force << c.text();
      if (fast.outcome == Outcome::overturned) continue;
      EXPECT_NEAR(fast.peak_slip_m, reference.peak_slip_m, 1e-6) << friction << force << c.text();
      EXPECT_NEAR(fast.peak_rotation_rad, reference.peak_rotation_rad, 1e-6) << friction << force << c.text();
    }
    EXPECT_GE(moved, 4) << friction << force;
  }
}

// Under such friction a slip may be steady at 1e-11 m/s, below what the steps of the reference miss: their errors turn it, the motion
// does not, and a reference that believed them stopped it ten thousand times, and gave up.
TEST(NearZero, ASteadySlipSlowerThanTheErrorsOfStepsGoesOn) {
  test::CaseFamily family;
  family.seed = 21;
  family.alpha_high = 0.6;
  family.duration_high_s = 6;
  const dynamics::Effect law = effect("law", "0.3 + 0.2*speed^0.2", "", {});
  test::RandomCase c = test::random_case(family, 15);
  c.specimen.effects = {{&law, {}}};
  const Response fast = respond(c.specimen, c.shaking), reference = respond_reference(c.specimen, c.shaking);
  EXPECT_EQ(fast.outcome, Outcome::moved);
  EXPECT_EQ(reference.outcome, Outcome::moved);
  EXPECT_NEAR(fast.peak_slip_m, reference.peak_slip_m, 1e-7);
  EXPECT_NEAR(fast.slid_path_m, reference.slid_path_m, 1e-7);
}

// Kinks that stand at one place and cancel: v, written with two. They are met together, and again at each impact.
TEST(NearZero, KinksAtOnePlaceAreMetTogether) {
  const dynamics::Effect plain = effect("plain", "", "-5*v", {}),
                         kinked = effect("kinked", "", "-5*abs(v)*if(v > 0, 1, -1)", {});
  test::CaseFamily family;
  family.seed = 21;
  family.alpha_high = 0.6;
  family.duration_high_s = 6;
  int moved = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    test::RandomCase c = test::random_case(family, number);
    c.specimen.effects = {{&plain, {}}};
    const Response expected = respond(c.specimen, c.shaking);
    c.specimen.effects = {{&kinked, {}}};
    for (const auto solve : {respond, respond_reference}) {
      const Response r = solve(c.specimen, c.shaking, {}, nullptr);
      EXPECT_EQ(r.outcome, expected.outcome) << c.text();
      if (expected.outcome == Outcome::overturned) continue;
      EXPECT_NEAR(r.peak_slip_m, expected.peak_slip_m, 1e-8) << c.text();
      EXPECT_NEAR(r.peak_rotation_rad, expected.peak_rotation_rad, 1e-8) << c.text();
    }
    moved += expected.outcome == Outcome::moved;
  }
  EXPECT_GE(moved, 20);
}

// The same on an elastoplastic contact, whose motion turns again and again, and at places that it comes by.
TEST(NearZero, KinksAtOnePlaceAreMetTogetherOnABoucWenContact) {
  const std::pair<const char*, const char*> laws[] = {
      {"-5*v", "-5*abs(v)*if(v > 0, 1, -1)"},
      {"-30*u", "-30*abs(u)*if(u > 0, 1, -1)"},
      {"-30*(u - 1e-3)", "-30*abs(u - 1e-3)*if(u > 1e-3, 1, -1)"},
      {"-30*(u - 2e-4)", "-30*abs(u - 2e-4)*if(3*u > 6e-4, 1, -1)"},
      {"-3*(normal - 1)*v", "-3*abs(normal - 1)*if(normal > 1, 1, -1)*abs(v)*if(v > 0, 1, -1)"}};
  Settings settings;
  settings.free_vibration_s = 0.5;
  for (const auto& [straight, bent] : laws) {
    const dynamics::Effect plain = effect("plain", "", straight, {}), kinked = effect("kinked", "", bent, {});
    int moved = 0;
    for (std::uint64_t number = 0; number < 8; ++number) {
      test::RandomCase c = test::random_bouc_wen_case({}, number);
      for (const auto solve : {respond, respond_reference}) {
        c.specimen.effects = {{&plain, {}}};
        const Response expected = solve(c.specimen, c.shaking, settings, nullptr);
        c.specimen.effects = {{&kinked, {}}};
        const Response r = solve(c.specimen, c.shaking, settings, nullptr);
        EXPECT_EQ(r.outcome, expected.outcome) << bent << ' ' << number << c.text();
        EXPECT_NEAR(r.peak_slip_m, expected.peak_slip_m, 1e-8) << bent << ' ' << number << c.text();
        EXPECT_NEAR(r.residual_slip_m, expected.residual_slip_m, 1e-8) << bent << ' ' << number << c.text();
        moved += expected.outcome == Outcome::moved;
      }
    }
    EXPECT_GE(moved, 8) << straight;
  }
}

// A kink on which the motion turns, and one on which it begins.
TEST(NearZero, ABoucWenContactLeavesTheKinksOnWhichItStarts) {
  Settings settings;
  settings.free_vibration_s = 0.5;
  for (const char* force : {"-5*max(v, 0)", "5*min(v, 0)", "-300*max(u, 0)", "300*max(-u, 0)"}) {
    const dynamics::Effect law = effect("law", "", force, {});
    for (std::uint64_t number = 18; number < 20; ++number) {
      test::RandomCase c = test::random_bouc_wen_case({}, number);
      c.specimen.effects = {{&law, {}}};
      const Response fast = respond(c.specimen, c.shaking, settings);
      const Response reference = respond_reference(c.specimen, c.shaking, settings);
      EXPECT_EQ(fast.outcome, reference.outcome) << force << number << c.text();
      EXPECT_NEAR(fast.peak_slip_m, reference.peak_slip_m, 1e-7) << force << number << c.text();
      EXPECT_NEAR(fast.residual_slip_m, reference.residual_slip_m, 1e-7) << force << number << c.text();
    }
  }
}

// A branch that is not taken has no say; one that is taken has, number or not.
TEST(NearZero, OnlyTheBranchThatIsTakenCounts) {
  const dynamics::Effect taken = effect("taken", "", "-3*if(u > -1, sqrt(u - 5), 0)", {});
  const dynamics::Effect hidden = effect("hidden", "", "max(sqrt(-1 - abs(u)), 0)", {});
  const FloorMotion motion = test::staircase({1, 2}, {5, 0});
  for (const dynamics::Effect* law : {&taken, &hidden})
    for (const auto solve : {respond, respond_reference})
      EXPECT_EQ(solve(sliding_block(*law), {&motion, 1}, {}, nullptr).outcome, Outcome::not_finite) << law->law;
}

// Friction that would push the slip on is no friction, and no paradox.
TEST(NearZero, FrictionBelowZeroIsAnOutcome) {
  const dynamics::Effect law = effect("waves", "0.3*cos(10*u)", "", {});
  const FloorMotion motion = test::staircase({1, 2}, {5, 0});
  for (const auto solve : {respond, respond_reference})
    EXPECT_EQ(solve(sliding_block(law), {&motion, 1}, {}, nullptr).outcome, Outcome::not_finite);
}

}  // namespace
}  // namespace freestand::formula
