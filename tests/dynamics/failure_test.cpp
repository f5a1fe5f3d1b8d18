// Failure is data: Painleve's paradox, limits, and input that is no number end in an outcome, never in a NaN or a hang.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/units.hpp"
#include "dynamics/effect.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test::failure_test {
namespace {

constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(Failure);

bool finite(const Response& r) {
  for (const double value : {r.peak_slip_m, r.residual_slip_m, r.slid_path_m, r.peak_rotation_rad,
                             r.residual_rotation_rad, r.peak_acceleration_mps2, r.end_time_s})
    if (!std::isfinite(value)) return false;
  return true;
}

// Least of mu_k - (1/3 + sin^2 phi)/(|sin phi| cos phi) at a history point: above 0 the corner can be in the paradox.
double beyond_painleve(const Specimen& specimen, const HistoryPoint& point) {
  const double phi = specimen.block.alpha_rad() - std::abs(point.rotation_rad);
  const double s = std::abs(std::sin(phi));
  return specimen.friction.mu_k - (1.0 / 3 + s * s) / (s * std::cos(phi));
}

CaseFamily paradox_family() {
  CaseFamily family;
  family.seed = 31;
  family.alpha_low = 0.3;
  family.alpha_high = 0.7;
  family.mu_low = 1.4;
  family.mu_high = 2.5;
  family.two_coefficients = 0;
  family.asymmetric = 0;
  family.one_model = 0;
  family.vertical = 1;
  family.vertical_peak_g = 2.5;
  family.excess_low = 2;
  family.excess_high = 8;
  family.duration_low_s = 3;
  family.duration_high_s = 4;
  return family;
}

TEST(Painleve, IsAnOutcomeAndNeverANaN) {
  int paradox = 0, other = 0, agree = 0;
  for (std::uint64_t number = 0; number < 200; ++number) {
    const RandomCase c = random_case(paradox_family(), number);
    History history;
    history.step_s = 1e-3;
    const Response fast = respond(c.specimen, c.shaking, {}, &history),
                   reference = respond_reference(c.specimen, c.shaking);
    ASSERT_TRUE(finite(fast)) << number << ' ' << c.text();
    ASSERT_TRUE(finite(reference)) << number << ' ' << c.text();
    ASSERT_NE(fast.outcome, Outcome::not_finite) << number << ' ' << c.text();
    ASSERT_NE(reference.outcome, Outcome::not_finite) << number << ' ' << c.text();
    ASSERT_NE(fast.outcome, Outcome::step_limit) << number << ' ' << c.text();
    agree += fast.outcome == reference.outcome ? 1 : 0;
    if (fast.outcome != Outcome::painleve) {
      ++other;
      continue;
    }
    ++paradox;
    ASSERT_FALSE(history.points.empty());
    const auto last = std::find_if(history.points.begin(), history.points.end(),
                                   [&](const HistoryPoint& point) { return point.time_s >= fast.end_time_s - 1e-3; });
    ASSERT_NE(last, history.points.end());
    EXPECT_GT(beyond_painleve(c.specimen, *last), -0.05) << number << ' ' << c.text();
  }
  std::printf("painleve in %d of %d samples, both integrators agree on %d outcomes\n", paradox, paradox + other, agree);
  EXPECT_GE(paradox, 3);
  EXPECT_GE(other, 20);
  EXPECT_GE(agree, 196);
}

// Below 4/3, the least value of the bound, no uniform block can meet it.
TEST(Painleve, NeverHappensBelowFourThirds) {
  CaseFamily family = paradox_family();
  family.mu_low = 1.0;
  family.mu_high = 1.33;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const RandomCase c = random_case(family, number);
    ASSERT_NE(respond(c.specimen, c.shaking).outcome, Outcome::painleve) << number << ' ' << c.text();
    if (number % 10 == 0) {
      ASSERT_NE(respond_reference(c.specimen, c.shaking).outcome, Outcome::painleve) << number << ' ' << c.text();
    }
  }
}

Specimen plain_block() {
  Specimen specimen;
  specimen.block = Block::rectangular(0.5, 1.5, 100);
  specimen.friction = {0.5, 0.4};
  return specimen;
}

TEST_P(Failure, InputThatIsNoNumberIsAnOutcome) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const FloorMotion pulse = rectangular_pulse(0.6 * g, 0.2);
  for (const double bad : {nan, infinite}) {
    for (int which = 0; which < 7; ++which) {
      Specimen specimen = plain_block();
      FloorMotion motion = pulse;
      Shaking shaking{&motion};
      if (which == 0) specimen.block.left_m = bad;
      if (which == 1) specimen.block.height_m = bad;
      if (which == 2) specimen.block.gyration2_m2 = bad;
      if (which == 3) specimen.friction.mu_s = specimen.friction.mu_k = nan;
      if (which == 4) motion.horizontal_mps2[0] = bad;
      if (which == 5) shaking.scale = bad;
      if (which == 6) shaking.stretch = bad;
      const Response r = GetParam()(specimen, shaking);
      EXPECT_EQ(r.outcome, Outcome::not_finite) << "which " << which << " bad " << bad;
    }
  }
}

// An impact that gives back more than Housner's rate makes energy; static friction below kinetic is none. In every way
// to an answer, and for each model.
TEST(InadmissibleInput, IsAnOutcomeInEveryWayToAnAnswer) {
  const FloorMotion record = piecewise_linear("steps", 0.1, {0, 4, -5, 6, -4, 0});
  const Shaking shaking{&record};
  for (const Model model : {Model::slide, Model::rock, Model::slide_rock, Model::bouc_wen})
    for (int which = 0; which < 3; ++which) {
      std::vector<Specimen> specimens(9, plain_block());
      for (Specimen& specimen : specimens) specimen.model = model;
      Specimen& bad = specimens[4];
      if (which == 1) bad.impact.factor = 1.0001;
      if (which == 2) bad.friction = {0.3, 0.3001};
      const Outcome expected = which == 0 ? Outcome::moved : Outcome::not_finite;
      EXPECT_EQ(respond(bad, shaking).outcome, expected) << static_cast<int>(model) << ' ' << which;
      EXPECT_EQ(respond_reference(bad, shaking).outcome, expected) << static_cast<int>(model) << ' ' << which;
      std::vector<Response> block(specimens.size());
      respond_batch(specimens, std::vector<Shaking>(specimens.size(), shaking), {}, block);
      for (std::size_t i = 0; i < block.size(); ++i)
        EXPECT_EQ(block[i].outcome, i == 4 ? expected : Outcome::moved) << static_cast<int>(model) << ' ' << which;
    }
}

// Laws that do not find room together: none of them acts, and no sample is computed.
TEST(InadmissibleInput, MoreStatesOrOperationsThanThereIsRoomFor) {
  const dynamics::Effect states{
      .name = "states",
      .force = [](const dynamics::At& at, const auto&) { return -1e-3 * at.own_state.at(6); },
      .states = std::vector<dynamics::OwnState>(
          7, {.name = "s", .rate = [](const dynamics::At& at, const auto&) { return at.own_state.at(6) + at.v; }})};
  const dynamics::Effect operations{.name = "operations", .force = [](const dynamics::At& at, const auto&) {
                                      dynamics::Value sum = at.u;
                                      for (int i = 0; i < 200; ++i) sum = sum * at.v + at.u;
                                      return sum;
                                    }};
  const dynamics::Effect bends{.name = "bends", .force = [](const dynamics::At& at, const auto&) {
                                 dynamics::Value sum = at.u;
                                 for (int i = 0; i < 20; ++i) sum = sum + abs(at.u - 0.01 * i);
                                 return -1e-3 * sum;
                               }};
  const FloorMotion record = piecewise_linear("steps", 0.1, {0, 4, -5, 6, -4, 0});
  for (const Model model : {Model::slide, Model::slide_rock, Model::bouc_wen})
    for (const dynamics::Effect* effect : {&states, &operations, &bends}) {
      Specimen specimen = plain_block();
      specimen.model = model;
      specimen.effects = {{effect, {}}};
      std::vector<Response> block(1);
      respond_batch({&specimen, 1}, std::vector<Shaking>{{&record}}, {}, block);
      EXPECT_EQ(block[0].outcome, Outcome::not_finite) << effect->name;
      EXPECT_EQ(respond(specimen, {&record}).outcome, Outcome::not_finite) << effect->name;
      EXPECT_EQ(respond_reference(specimen, {&record}).outcome, Outcome::not_finite) << effect->name;
    }
}

// X = 100 u: the slip grows as exp(10 t) for as long as the block is watched.
TEST_P(Failure, ALawThatFeedsTheMotionIsAnOutcome) {
  const dynamics::Effect feed{.name = "feed",
                              .force = [](const dynamics::At& at, const auto&) { return 100.0 * at.u; }};
  const FloorMotion pulse = rectangular_pulse(0.6 * g, 0.2);
  Specimen specimen = plain_block();
  specimen.model = Model::slide;
  specimen.effects = {{&feed, {}}};
  const Response r = GetParam()(specimen, {&pulse});
  EXPECT_EQ(r.outcome, Outcome::not_finite);
  EXPECT_TRUE(finite(r));
  EXPECT_LT(r.end_time_s, 5);
}

// F = 1 + sqrt(2 + 30 u) has no value from u = -1/15 on.
TEST_P(Failure, ALawThatEndsIsAnOutcome) {
  const dynamics::Effect ends{
      .name = "ends", .friction = [](const dynamics::At& at, const auto&) { return 1.0 + sqrt(30.0 * at.u + 2.0); }};
  const FloorMotion sine = one_sine();
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 2, 100);
  specimen.friction = {0.2, 0.2};
  specimen.effects = {{&ends, {}}};
  const Response r = GetParam()(specimen, {.motion = &sine, .scale = 1.2 * g, .stretch = 0.8});
  EXPECT_THAT(r.outcome, testing::AnyOf(Outcome::not_finite, Outcome::step_limit));
  EXPECT_TRUE(finite(r));
  EXPECT_NEAR(r.peak_slip_m, 1.0 / 15, 1e-3);
}

TEST_P(Failure, TooManyEventsIsAnOutcome) {
  CaseFamily family;
  family.seed = 32;
  family.alpha_high = 0.3;
  family.mu_low = 0.8;
  family.excess_low = 2;
  const RandomCase c = random_case(family, 1);
  ASSERT_GT(GetParam()(c.specimen, c.shaking).events, 20);
  Settings settings;
  settings.event_limit = 5;
  const Response r = GetParam()(c.specimen, c.shaking, settings);
  EXPECT_EQ(r.outcome, Outcome::step_limit);
  EXPECT_LE(r.events, 6);
  EXPECT_TRUE(finite(r));
}

TEST_P(Failure, FrictionWithoutBoundIsARockingBlock) {
  const FloorMotion motion = rectangular_pulse(0.6 * g, 0.2);
  Specimen rock = plain_block();
  rock.model = Model::rock;
  const Response expected = GetParam()(rock, {&motion});
  ASSERT_EQ(expected.outcome, Outcome::moved);
  for (const double mu : {1e3, 1e9, 1e300}) {
    Specimen specimen = plain_block();
    specimen.friction = {mu, mu};
    const Response r = GetParam()(specimen, {&motion});
    EXPECT_EQ(r.outcome, Outcome::moved) << mu;
    EXPECT_NEAR(r.peak_rotation_rad, expected.peak_rotation_rad, 1e-12) << mu;
    EXPECT_EQ(r.slid_path_m, 0) << mu;
  }
}

TEST_P(Failure, NoFrictionAtAllMovesWithTheFloorMirrored) {
  const double a = 2, T = 0.5;
  const FloorMotion motion = staircase({T, T}, {a, -a});
  Specimen specimen = plain_block();
  specimen.friction = {0, 0};
  Settings settings;
  settings.free_vibration_s = 5;
  const Response r = GetParam()(specimen, {&motion}, settings);
  EXPECT_EQ(r.outcome, Outcome::moved);
  EXPECT_NEAR(r.peak_slip_m, a * T * T, 1e-10);
  EXPECT_EQ(r.peak_rotation_rad, 0);
}

TEST_P(Failure, FlightAndLanding) {
  // The floor drops away at 2 g for 0.1 s, while it accelerates sideways: the block is left behind by a t^2/2 in
  // flight.
  const double a = 0.2 * g, v = -2 * g, T = 0.1;
  const FloorMotion motion = staircase({T}, {a}, {v});
  Shaking shaking{&motion};
  shaking.vertical_scale = 1;
  Specimen specimen = plain_block();
  specimen.friction = {0.01, 0.01};
  specimen.block = Block::rectangular(1.5, 0.3, 100);
  History history;
  const Response r = GetParam()(specimen, shaking, {}, &history);
  ASSERT_GE(history.events.size(), 2u);
  EXPECT_EQ(history.events[0].to, Mode::flight);
  EXPECT_EQ(history.events[0].time_s, 0);
  // Relative to the floor: rises at (2 - 1) g for T, then falls at g. Height g T^2/2 and speed g T at T:
  // lands after (1 + sqrt 2) T more.
  const double landing = T + (1 + std::sqrt(2)) * T;
  EXPECT_NEAR(history.events[1].time_s, landing, 1e-8);
  EXPECT_TRUE(history.events[1].impact);
  // Landing impulse m g T sqrt(2); friction takes mu times that off the slip speed a T.
  const double mu = 0.01, speed = a * T - mu * std::sqrt(2) * g * T;
  const double in_flight = 0.5 * a * T * T + a * T * (landing - T), after = speed * speed / (2 * mu * g);
  EXPECT_NEAR(r.peak_slip_m, in_flight + after, 1e-8);
  EXPECT_NEAR(r.residual_slip_m, -(in_flight + after), 1e-8);
}

}  // namespace
}  // namespace freestand::test::failure_test
