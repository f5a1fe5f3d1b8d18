// The largest forces of the floor and of a chain: closed forms, and histories looked through point by point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/chain.hpp"
#include "effects/effect_fixture.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/rocking.hpp"
#include "support/solvers.hpp"

namespace freestand::test::contact_forces_test {
namespace {

FREESTAND_ON_BOTH_SOLVERS(ContactForces);

Settings followed() {
  Settings settings;
  settings.tolerance = 1e-12;
  settings.contact_forces = true;
  return settings;
}

// Sliding: f_x = mu m g', f_y = m g'. At rest f_x = m a.
TEST_P(ContactForces, AreFrictionAndWeightOfABlockThatSlides) {
  const FloorMotion push = rectangular_pulse(-5, 0.3), little = rectangular_pulse(-1.5, 0.3);
  const Specimen block = sliding(0.2);
  const Response slides = GetParam()(block, {&push}, followed(), nullptr);
  EXPECT_NEAR(slides.peak_contact_horizontal_mps2, 0.2 * g, 1e-12);
  EXPECT_NEAR(slides.peak_contact_vertical_mps2, g, 1e-12);
  EXPECT_EQ(slides.peak_chain_force_mps2, 0);
  EXPECT_NEAR(GetParam()(block, {&little}, followed(), nullptr).peak_contact_horizontal_mps2, 1.5, 1e-12);
}

// Free rocking: |f_x| = m g sin(phi) (3/4 cos(phi) - 3/2 (cos(phi_0) - cos(phi))), phi_0 at the top of the swing; of ever
// smaller swings it grows to 3/4 m g sin(alpha) cos(alpha), at the foot of the last ones. f_y stays below the weight.
TEST_P(ContactForces, OfFreeRockingGrowToThoseOfTheLastSwings) {
  Specimen block{Block::rectangular(0.6, 1.8, 100), {20, 20}, {}};
  block.start.rotation_rad = 0.1;
  const double alpha = block.block.alpha_rad();
  const FloorMotion still = rectangular_pulse(0, 0.1);
  const Response r = GetParam()(block, {&still}, followed(), nullptr);
  EXPECT_NEAR(r.peak_contact_horizontal_mps2, 0.75 * g * std::sin(alpha) * std::cos(alpha), 1e-6);
  EXPECT_NEAR(r.peak_contact_vertical_mps2, g, 1e-12);
}

// f_x = m (R cos(phi) theta'' + s R sin(phi) theta'^2 + a), f_y = m (g + s R sin(phi) theta'' - R cos(phi) theta'^2), with theta''
// by [KM05 6.10] from the angles of a history.
TEST_P(ContactForces, OfRockingFollowTheEquationOfMotion) {
  const Specimen block{Block::rectangular(0.6, 1.8, 100), {20, 20}, {}};
  const double R = block.block.size_m(), alpha = block.block.alpha_rad(), a = -6, t1 = 0.2;
  const FloorMotion push = rectangular_pulse(a, t1);
  History history;
  history.step_s = 1e-4;
  const Response r = GetParam()(block, {&push}, followed(), &history);
  ASSERT_EQ(r.outcome, Outcome::moved);
  double most_x = 0, most_y = g;
  for (const HistoryPoint& p : history.points) {
    if (p.mode != Mode::rock) continue;
    const double s = p.rotation_rad > 0 ? 1 : -1, phi = alpha - std::abs(p.rotation_rad), q = p.rotation_rate_radps;
    const double turn = -0.75 / R * (s * g * std::sin(phi) + p.floor_acceleration_mps2 * std::cos(phi));
    most_x = std::max(most_x,
                      std::abs(R * std::cos(phi) * turn + s * R * std::sin(phi) * q * q + p.floor_acceleration_mps2));
    most_y = std::max(most_y, g + s * R * std::sin(phi) * turn - R * std::cos(phi) * q * q);
  }
  EXPECT_GT(most_y, 1.05 * g);
  EXPECT_NEAR(r.peak_contact_horizontal_mps2, most_x, 1e-2);
  EXPECT_NEAR(r.peak_contact_vertical_mps2, most_y, 1e-2);
}

// On ice a block runs at v into n chains of stiffness k: each pulls k x = sqrt(k/(n m)) v m at most, or its strength.
TEST_P(ContactForces, OfAChainAreThoseOfItsSpring) {
  const double v = 0.15, mass = 200, k = 2e5;
  const FloorMotion push = rectangular_pulse(-1.5, 0.1);
  for (const double strength : {1e9, 0.6 * v * std::sqrt(k / (2 * mass)) * mass}) {
    Specimen block{Block::rectangular(0.72, 1.81, mass), {0, 0}, {}, Model::slide};
    block.effects = {dynamics::use(
        {.slack_m = 0.02, .stiffness_npm = k, .strength_n = strength, .height_m = 1.81, .number = 2}, block.block)};
    Settings settings = followed();
    settings.free_vibration_s = 0.25;
    const Response r = GetParam()(block, {&push}, settings, nullptr);
    const double most = std::fmin(v * std::sqrt(k / (2 * mass)), strength / mass);
    EXPECT_NEAR(r.peak_chain_force_mps2, most, GetParam().name == std::string("fast") ? 1e-9 : 1e-2 * most);
    EXPECT_EQ(r.connection_failed, strength < 1e6);
    EXPECT_EQ(r.peak_contact_horizontal_mps2, 0);
  }
}

// A dashpot takes hold at once, with c v: more than the strength, so that the connection fails, and was pulled up to it.
TEST_P(ContactForces, OfAChainThatFailsAsItGrowsTautReachItsStrength) {
  const double v = 0.15, mass = 200, strength = 50, c = 2000;
  const FloorMotion push = rectangular_pulse(-1.5, v / 1.5);
  Specimen block{Block::rectangular(0.72, 1.81, mass), {0, 0}, {}, Model::slide};
  block.effects = {dynamics::use(
      {.slack_m = 0.02, .stiffness_npm = 100, .strength_n = strength, .height_m = 1.81, .damping_nspm = c},
      block.block)};
  ASSERT_GT(c * v, strength);
  Settings settings = followed();
  settings.free_vibration_s = 0.25;
  const Response r = GetParam()(block, {&push}, settings, nullptr);
  EXPECT_TRUE(r.connection_failed);
  EXPECT_NEAR(r.peak_chain_force_mps2 * mass, strength, 1e-9);
}

// A chain without slack grows taut as a rocking block comes down, in the blow that leaves it e of its rate: it pulls with
// c z cos(beta) e times the rate that the fall from theta gave, and with no more before.
TEST_P(ContactForces, OfAChainWithoutSlackComeAfterTheBlow) {
  const double width = 0.7, height = 1.5, mass = 100, c = 1000, theta = 0.05;
  Specimen block{Block::rectangular(width, height, mass), {0.8, 0.8}, {}, Model::rock};
  block.start.rotation_rad = -theta;
  block.effects = {dynamics::use(
      {.slack_m = 0, .stiffness_npm = 1000, .strength_n = 700, .height_m = height, .side = 1, .damping_nspm = c},
      block.block)};
  const FloorMotion still = rectangular_pulse(0, 0.5);
  const Response r = GetParam()(block, {&still}, followed(), nullptr);
  const double b = 0.5 * width, h = 0.5 * height, R2 = b * b + h * h;
  const double fallen = b * std::sin(theta) + h * (std::cos(theta) - 1), rate = std::sqrt(1.5 * g * fallen / R2);
  const double kept = 1 - 1.5 * b * b / R2;
  EXPECT_FALSE(r.connection_failed);
  EXPECT_NEAR(r.peak_chain_force_mps2 * mass, c * height * kept * rate, 1e-6);
}

// A wall takes what friction cannot: the floor gives mu m g and no more, of a push that grows beyond that within a step and
// falls below it again.
TEST_P(ContactForces, OfABlockPressedAgainstAWallAreFriction) {
  Specimen block = sliding(0.2, {effect("wall_impact", {0, 0.4})});
  const FloorMotion push = one_sine();
  for (const double peak : {1.5, 4.0}) {
    Settings settings = followed();
    settings.free_vibration_s = 0;
    History history;
    history.forces = true;
    history.step_s = 1e-3;
    const Response r = GetParam()(block, {&push, -peak}, settings, &history);
    double most = 0;
    for (const HistoryPoint& p : history.points) most = std::max(most, std::abs(p.contact_x_mps2));
    EXPECT_NEAR(most, std::fmin(peak, 0.2 * g), 1e-4);
    EXPECT_NEAR(r.peak_contact_horizontal_mps2, std::fmin(peak, 0.2 * g), 1e-4);
  }
}

// At rest the floor holds the block against what it does itself, and against what a spring pulls: while the floor moves, and after it.
TEST_P(ContactForces, AtRestHoldAgainstLawsToo) {
  const double f = 0.4, w2 = 4 * pi * pi * f * f;
  const Specimen block = sliding(0.2, {effect("centering_spring", {f})});
  std::vector<double> floor(401, 0.0);
  for (int i = 0; i < 40; ++i) floor[static_cast<std::size_t>(i)] = -5;
  for (std::size_t i = 200; i < 300; ++i) floor[i] = 0.2;
  const FloorMotion push = piecewise_linear("push", 0.01, floor, {});
  Settings settings = followed();
  settings.free_vibration_s = 0;
  History history;
  history.forces = true;
  history.step_s = 0.01;
  GetParam()(block, {&push}, settings, &history);
  std::size_t resting = 0;
  for (const HistoryPoint& p : history.points) {
    if (p.mode != Mode::rest || p.slip_m == 0) continue;
    EXPECT_NEAR(p.contact_x_mps2, p.floor_acceleration_mps2 + w2 * p.slip_m, 1e-9) << p.time_s;
    EXPECT_NEAR(p.contact_y_mps2, g, 1e-12);
    ++resting;
  }
  EXPECT_GT(resting, 100U);
}

// No point of a history is above the peak, and between points of a millisecond no force rises by much: peaks of random blocks
// held by a chain, whose pull is computed here from where its point is.
TEST(ContactForcesAlone, AreThePeaksOfHistories) {
  int taut = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    CaseFamily family;
    family.seed = 21;
    family.duration_low_s = 1, family.duration_high_s = 2;
    RandomCase c = random_case(family, i);
    const Block& b = c.specimen.block;
    const double z = b.full_height_m(), k = 400, slack = 0.01;  // over the mass
    c.specimen.effects.push_back(
        dynamics::use({.slack_m = slack, .stiffness_npm = k * b.mass_kg, .strength_n = 1e12, .height_m = z}, b));
    Settings settings = followed();
    settings.free_vibration_s = 0;
    History history;
    history.forces = true;
    history.step_s = 1e-3;
    const Response r = respond(c.specimen, c.shaking, settings, &history);
    if (r.outcome != Outcome::moved) continue;
    double x = 0, y = 0, pull = 0;
    for (const HistoryPoint& p : history.points) {
      x = std::max(x, std::abs(p.contact_x_mps2));
      y = std::max(y, p.contact_y_mps2);
      const double stretch =
          p.slip_m + z * std::sin(p.rotation_rad) - b.half_base_m() * (std::cos(p.rotation_rad) - 1) - slack;
      pull = std::max(pull, k * stretch);
    }
    taut += pull > 0;
    EXPECT_GE(r.peak_contact_horizontal_mps2, x * (1 - 1e-9)) << c.text();
    EXPECT_GE(r.peak_contact_vertical_mps2, y * (1 - 1e-9)) << c.text();
    EXPECT_NEAR(r.peak_chain_force_mps2, pull, 0.02 * pull + 1e-9) << c.text();
    EXPECT_LE(r.peak_contact_horizontal_mps2, 1.5 * x + 1) << c.text();
    EXPECT_LE(r.peak_contact_vertical_mps2, 1.5 * y + 1) << c.text();
  }
  EXPECT_GT(taut, 4);
}

TEST(ContactForcesAlone, ChangeNoOtherNumberAndGoThroughBlocksOfSamples) {
  for (std::uint64_t i = 0; i < 8; ++i) {
    CaseFamily family;
    family.seed = 22;
    const RandomCase c = random_case(family, i);
    const Response without = respond(c.specimen, c.shaking),
                   with = respond(c.specimen, c.shaking, {.contact_forces = true});
    EXPECT_TRUE(std::isnan(without.peak_contact_vertical_mps2));
    EXPECT_EQ(with.peak_slip_m, without.peak_slip_m);
    EXPECT_EQ(with.peak_rotation_rad, without.peak_rotation_rad);
    EXPECT_EQ(with.peak_acceleration_mps2, without.peak_acceleration_mps2);
    Response in_block;
    respond_batch({&c.specimen, 1}, {&c.shaking, 1}, {.contact_forces = true}, {&in_block, 1});
    EXPECT_EQ(in_block.peak_contact_horizontal_mps2, with.peak_contact_horizontal_mps2);
    EXPECT_EQ(in_block.peak_contact_vertical_mps2, with.peak_contact_vertical_mps2);
  }
}

}  // namespace
}  // namespace freestand::test::contact_forces_test
