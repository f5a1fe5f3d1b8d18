// Blocks that are on their way when the floor begins to move, and blocks whose mass is not spread evenly: closed forms,
// quadrature, symmetry, and one integrator against the other.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "effects/effect_fixture.hpp"
#include "support/floor_motions.hpp"
#include "support/keyed_random.hpp"
#include "support/random_cases.hpp"
#include "support/rocking.hpp"
#include "support/solvers.hpp"

namespace freestand::test::start_test {
namespace {

constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(Start);

Settings tight() {
  Settings settings;
  settings.tolerance = 1e-13;
  return settings;
}

const FloorMotion& still_floor() {
  static const FloorMotion motion = rectangular_pulse(0, 0.1);
  return motion;
}

std::vector<double> impacts(const History& history) {
  std::vector<double> times;
  for (const Event& event : history.events)
    if (event.impact) times.push_back(event.time_s);
  return times;
}

// Set down at theta_0 and let go. About a corner (k^2 + R^2) theta'' = -g R sin(alpha - theta), so that p and alpha tell all but
// the rate that an impact leaves: moments about the new corner, (k^2 + h^2 + b^2) q+ = (k^2 + h^2 - b^2) q-.
TEST_P(Start, ABlockThatIsLetGoRocksAsItsCentreOfMassAndInertiaSay) {
  struct Body {
    double centre_height_m, gyration_radius_m;
  };
  for (const Body body : {Body{0.9, std::sqrt((0.09 + 0.81) / 3)}, Body{0.5, 0.6}, Body{1.3, 0.4}}) {
    Specimen specimen;
    specimen.block = Block::of_outline(0.6, 1.8, 100, body.centre_height_m, body.gyration_radius_m);
    specimen.friction = {20, 20};
    const double alpha = std::atan(0.3 / body.centre_height_m), R = std::hypot(0.3, body.centre_height_m);
    const double k2 = body.gyration_radius_m * body.gyration_radius_m, p = std::sqrt(g * R / (k2 + R * R));
    const double e = (k2 + body.centre_height_m * body.centre_height_m - 0.09) / (k2 + R * R);
    const RockingBlock block{p, alpha};
    for (const double share : {0.3, 0.8}) {
      specimen.start.rotation_rad = share * alpha;
      double peak = share * alpha, t = fall_time_s(block, peak);
      History history;
      history.step_s = 0;
      const Response r = GetParam()(specimen, {&still_floor()}, tight(), &history);
      EXPECT_EQ(r.outcome, Outcome::moved);
      EXPECT_NEAR(r.peak_rotation_rad, share * alpha, 1e-12);
      // Its corner stands where it stood, the middle of its base beside that by b (1 - cos(theta)), and it comes to rest in place.
      EXPECT_NEAR(r.peak_slip_m, 0.3 * (1 - std::cos(share * alpha)), 1e-12);
      EXPECT_NEAR(r.residual_slip_m, 0, 1e-12);
      const std::vector<double> found = impacts(history);
      ASSERT_GE(found.size(), 5U);
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(found[i], t, 1e-9 * t) << "impact " << i << ", centre at " << body.centre_height_m;
        const double drop = std::cos(alpha - peak) - std::cos(alpha);
        peak = alpha - std::acos(std::cos(alpha) + e * e * drop);
        t += 2 * fall_time_s(block, peak);
      }
    }
  }
}

// What leans beyond alpha falls, what leans less comes back.
TEST_P(Start, OverturnsBeyondItsSlenderness) {
  Specimen specimen;
  specimen.block = Block::of_outline(0.6, 1.8, 100, 1.2, {});
  specimen.friction = {20, 20};
  const double alpha = std::atan(0.3 / 1.2);
  for (const double side : {1.0, -1.0}) {
    specimen.start.rotation_rad = side * 1.001 * alpha;
    EXPECT_EQ(GetParam()(specimen, {&still_floor()}, {}, nullptr).outcome, Outcome::overturned);
    specimen.start.rotation_rad = side * 0.999 * alpha;
    EXPECT_EQ(GetParam()(specimen, {&still_floor()}, {}, nullptr).outcome, Outcome::moved);
    // The rate that just reaches the edge: q^2/2 (k^2 + R^2) = g (R - h).
    specimen.start = {.rotation_rate_radps = 0};
    const double R = std::hypot(0.3, 1.2), k2 = specimen.block.gyration2_m2;
    const double edge = std::sqrt(2 * g * (R - 1.2) / (k2 + R * R));
    specimen.start.rotation_rate_radps = side * 1.001 * edge;
    EXPECT_EQ(GetParam()(specimen, {&still_floor()}, {}, nullptr).outcome, Outcome::overturned);
    specimen.start.rotation_rate_radps = side * 0.999 * edge;
    EXPECT_EQ(GetParam()(specimen, {&still_floor()}, {}, nullptr).outcome, Outcome::moved);
    specimen.start = {};
  }
}

// v^2/(2 mu g) from where it starts.
TEST_P(Start, APushedBlockSlidesToAStop) {
  for (const Model model : {Model::slide, Model::slide_rock}) {
    Specimen specimen{Block::rectangular(2, 1, 10), {0.4, 0.3}, {}, model};
    specimen.start = {.slip_m = 0.25, .slip_velocity_mps = -1.2};
    const Response r = GetParam()(specimen, {&still_floor()}, tight(), nullptr);
    const double path = 1.2 * 1.2 / (2 * 0.3 * g);
    EXPECT_NEAR(r.slid_path_m, path, 1e-11);
    EXPECT_NEAR(r.residual_slip_m, 0.25 - path, 1e-11);
    EXPECT_NEAR(r.peak_slip_m, 0.25, 1e-15);
    EXPECT_EQ(r.outcome, Outcome::moved);
  }
}

// A block that is set down at rest away from where it is counted from has slipped that far, and no further.
TEST_P(Start, ADisplacedBlockStays) {
  Specimen specimen{Block::rectangular(2, 1, 10), {0.4, 0.3}, {}};
  specimen.start = {.slip_m = -0.1};
  const Response r = GetParam()(specimen, {&still_floor()}, {}, nullptr);
  EXPECT_EQ(r.residual_slip_m, -0.1);
  EXPECT_EQ(r.peak_slip_m, 0.1);
  EXPECT_EQ(r.slid_path_m, 0);
}

TEST_P(Start, WhatTheModelCannotDoIsNotFinite) {
  const auto outcome = [&](Model model, freestand::Start start, std::vector<EffectUse> effects = {}) {
    Specimen specimen{Block::rectangular(0.6, 1.8, 10), {0.4, 0.3}, {}, model, std::move(effects)};
    specimen.start = start;
    return GetParam()(specimen, {&still_floor()}, {}, nullptr).outcome;
  };
  EXPECT_EQ(outcome(Model::slide_rock, {.rotation_rad = pi / 2}), Outcome::not_finite);
  EXPECT_EQ(outcome(Model::slide_rock, {.rotation_rad = std::nan("")}), Outcome::not_finite);
  EXPECT_EQ(outcome(Model::slide, {.rotation_rad = 0.1}), Outcome::not_finite);
  EXPECT_EQ(outcome(Model::rock, {.slip_velocity_mps = 0.1}), Outcome::not_finite);
  EXPECT_EQ(outcome(Model::bouc_wen, {.slip_m = 0.1}), Outcome::not_finite);
  // Beyond a wall 0.1 m away: by its base, and by its upper edge alone.
  const std::vector<EffectUse> wall{effect("wall_impact", {0.1, 0.5})};
  EXPECT_EQ(outcome(Model::slide_rock, {.slip_m = 0.2}, wall), Outcome::not_finite);
  EXPECT_EQ(outcome(Model::slide_rock, {.rotation_rad = 0.1}, wall), Outcome::not_finite);
  EXPECT_EQ(outcome(Model::slide_rock, {.rotation_rad = -0.1}, wall), Outcome::moved);
}

struct Drawn {
  RandomCase made;
  freestand::Start start() const { return made.specimen.start; }
};

// Random blocks on random floors, on their way in random ways.
Drawn drawn(std::uint64_t number) {
  CaseFamily family;
  family.seed = 77;
  family.asymmetric = 0.5;
  family.duration_low_s = 2, family.duration_high_s = 3;
  Drawn out{random_case(family, number)};
  Specimen& s = out.made.specimen;
  KeyedRandom random(771, number);
  const double p = s.block.p_radps(), alpha = s.block.alpha_rad(), R = s.block.size_m();
  if (s.model != Model::slide) {
    s.start.rotation_rad = random.uniform(-0.8, 0.8) * alpha;
    s.start.rotation_rate_radps = random.uniform(-0.3, 0.3) * p * alpha;
  }
  if (s.model != Model::rock) s.start.slip_velocity_mps = random.uniform(-0.3, 0.3) * p * R;
  s.start.slip_m = random.uniform(-0.1, 0.1);
  return out;
}

TEST(StartOfRandomBlocks, IsTheSameInBothIntegratorsAndMirrored) {
  int compared = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const Drawn d = drawn(i);
    Settings settings = tight();
    settings.tolerance = 1e-11;
    const Response fast = respond(d.made.specimen, d.made.shaking, settings);
    const Response slow = respond_reference(d.made.specimen, d.made.shaking, settings);
    ASSERT_EQ(fast.outcome, slow.outcome) << d.made.text();
    const double R = d.made.specimen.block.size_m();
    if (fast.outcome != Outcome::moved) continue;
    EXPECT_NEAR(fast.peak_slip_m, slow.peak_slip_m, 1e-6 * R) << d.made.text();
    EXPECT_NEAR(fast.residual_slip_m, slow.residual_slip_m, 1e-6 * R) << d.made.text();
    EXPECT_NEAR(fast.peak_rotation_rad, slow.peak_rotation_rad, 1e-6) << d.made.text();
    ++compared;
    Specimen other = d.made.specimen;
    std::swap(other.block.left_m, other.block.right_m);
    other.start = {-d.start().rotation_rad, -d.start().rotation_rate_radps, -d.start().slip_m,
                   -d.start().slip_velocity_mps};
    Shaking mirrored = d.made.shaking;
    mirrored.scale = -mirrored.scale;
    const Response back = respond(other, mirrored, settings);
    EXPECT_EQ(back.peak_slip_m, fast.peak_slip_m);
    EXPECT_EQ(back.residual_slip_m, -fast.residual_slip_m);
  }
  EXPECT_GE(compared, 30);
}

TEST(StartOfRandomBlocks, BlocksOfSamplesAreSingleSamples) {
  std::vector<Drawn> all;
  for (std::uint64_t i = 0; i < 24; ++i) all.push_back(drawn(i));
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (const Drawn& d : all) specimens.push_back(d.made.specimen), shakings.push_back(d.made.shaking);
  std::vector<Response> responses(all.size());
  respond_batch(specimens, shakings, {}, responses);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Response single = respond(specimens[i], shakings[i], {});
    EXPECT_EQ(responses[i].peak_slip_m, single.peak_slip_m);
    EXPECT_EQ(responses[i].peak_rotation_rad, single.peak_rotation_rad);
  }
}

}  // namespace
}  // namespace freestand::test::start_test
