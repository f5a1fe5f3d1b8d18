// The acceleration of a point of the block, the forces of the floor, and blows: against differences of the positions, the
// momentum of the block, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "effects/effect_fixture.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/rocking.hpp"
#include "support/solvers.hpp"

namespace freestand::test::point_test {
namespace {

constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(FollowedPoint);

// Height over the floor of the middle of the base, of a block on a corner.
double middle_height(const Block& block, double theta) { return block.half_base_m() * std::abs(std::sin(theta)); }

// A point z above the middle of the base is at u + z sin(theta) beside it and z cos(theta) over it. Second differences of
// three points of a history, where no event and no knot of the record lies between them: there they miss the acceleration by
// dt^2/12 of its second derivative, 1e-4 for 1200 m/s4.
void expect_differences_of_the_positions(const Specimen& specimen, const Shaking& shaking, const History& history,
                                         double z, int& compared) {
  const double dt = history.step_s;
  const auto x = [&](const HistoryPoint& p) { return p.slip_m + z * std::sin(p.rotation_rad); };
  const auto y = [&](const HistoryPoint& p) {
    return middle_height(specimen.block, p.rotation_rad) + z * std::cos(p.rotation_rad);
  };
  for (std::size_t i = 1; i + 1 < history.points.size(); ++i) {
    const HistoryPoint &before = history.points[i - 1], &now = history.points[i], &after = history.points[i + 1];
    const bool event = std::any_of(history.events.begin(), history.events.end(), [&](const Event& e) {
      return e.time_s >= before.time_s - dt && e.time_s <= after.time_s + dt;
    });
    const auto& knots = shaking.motion->knot_s;
    const auto knot = std::upper_bound(knots.begin(), knots.end(), before.time_s + 1e-9);
    const bool kink = knot != knots.end() && *knot < after.time_s - 1e-9;
    if (event || kink || now.mode == Mode::flight || before.mode != after.mode || after.time_s > shaking.duration_s())
      continue;
    const double ax = (x(after) - 2 * x(now) + x(before)) / (dt * dt) + now.floor_acceleration_mps2;
    const double ay = (y(after) - 2 * y(now) + y(before)) / (dt * dt) + vertical_acceleration(shaking, now.time_s);
    ASSERT_NEAR(now.acceleration_mps2, ax, 1e-4) << name(now.mode) << " at " << now.time_s;
    ASSERT_NEAR(now.vertical_acceleration_mps2, ay, 1e-4) << name(now.mode) << " at " << now.time_s;
    ++compared;
  }
}

TEST_P(FollowedPoint, HasTheAccelerationOfItsPosition) {
  int compared = 0;
  for (std::uint64_t i = 0; i < 8; ++i) {
    CaseFamily family;
    family.seed = 5;
    family.duration_low_s = 1, family.duration_high_s = 2;
    const RandomCase c = random_case(family, i);
    Settings settings;
    settings.tolerance = 1e-12;
    settings.free_vibration_s = 0;
    settings.acceleration_height_m = 1.7 * c.specimen.block.height_m;
    History history;
    history.step_s = 1e-3;
    history.forces = true;
    const Response r = GetParam()(c.specimen, c.shaking, settings, &history);
    expect_differences_of_the_positions(c.specimen, c.shaking, history, settings.acceleration_height_m, compared);
    double most = 0;
    for (const HistoryPoint& p : history.points)
      if (p.time_s <= r.end_time_s)
        most = std::max(most, std::hypot(p.acceleration_mps2, p.vertical_acceleration_mps2));
    EXPECT_GE(r.peak_acceleration_at_height_mps2, most * (1 - 1e-9));
    // Between two points no polynomial of a record changes by more than a jump at an event, which both count.
    EXPECT_LE(r.peak_acceleration_at_height_mps2, 1.5 * most + 1);
  }
  EXPECT_GT(compared, 2000);
}

// The same where effects push: their forces are no part of what the floor does, and of what moves the point.
TEST_P(FollowedPoint, HasTheAccelerationOfItsPositionUnderForcesOfEffects) {
  CaseFamily family;
  family.seed = 5;
  family.duration_low_s = 1, family.duration_high_s = 2;
  for (const auto& [use, least] :
       {std::pair{effect("centering_spring", {0.8}), 500}, {effect("viscous_drag", {2}), 500}}) {
    int compared = 0;
    for (std::uint64_t i = 0; i < 4; ++i) {
      RandomCase c = random_case(family, i);
      c.specimen.effects.push_back(use);
      Settings settings;
      settings.tolerance = 1e-12;
      settings.free_vibration_s = 0;
      settings.acceleration_height_m = 1.7 * c.specimen.block.height_m;
      History history;
      history.step_s = 5e-4;  // the accelerations bend more
      history.forces = true;
      GetParam()(c.specimen, c.shaking, settings, &history);
      expect_differences_of_the_positions(c.specimen, c.shaking, history, settings.acceleration_height_m, compared);
    }
    EXPECT_GT(compared, least);
  }
}

// Pressed against a wall that it touches, the base takes what friction can, and the wall the rest: m a = mu m g + wall.
TEST_P(FollowedPoint, AWallTakesWhatFrictionCannot) {
  Specimen specimen{Block::rectangular(2, 1, 100), {0.2, 0.2}, {}, Model::slide};
  specimen.effects = {effect("wall_impact", {0, 0.4})};
  const FloorMotion push = rectangular_pulse(-4, 0.2);
  History history;
  history.step_s = 0.05;
  history.forces = true;
  GetParam()(specimen, {&push}, {}, &history);
  EXPECT_EQ(history.points.at(2).slip_m, 0);
  EXPECT_NEAR(history.points.at(2).acceleration_mps2, -4, 1e-12);
  EXPECT_NEAR(history.points.at(2).contact_x_mps2, -0.2 * g, 1e-12);
}

// Momentum: what the floor does to the block, and its weight, make the acceleration of the centre of mass. Friction is
// within its cone, and at its edge where the contact slips.
TEST_P(FollowedPoint, ForcesOfTheFloorMakeTheMomentumAndKeepTheCone) {
  int slips = 0;
  for (std::uint64_t i = 0; i < 8; ++i) {
    CaseFamily family;
    family.seed = 6;
    family.duration_low_s = 1, family.duration_high_s = 2;
    const RandomCase c = random_case(family, i);
    History history;
    history.step_s = 0.01;
    history.forces = true;
    GetParam()(c.specimen, c.shaking, {}, &history);
    for (const HistoryPoint& p : history.points) {
      EXPECT_NEAR(p.acceleration_mps2, p.contact_x_mps2, 1e-9);
      EXPECT_NEAR(p.vertical_acceleration_mps2, p.contact_y_mps2 - g, 1e-9);
      const bool slides = p.mode == Mode::slide || p.mode == Mode::slide_rock;
      if (c.specimen.model == Model::rock || p.mode == Mode::overturned) continue;
      const double most = (slides ? c.specimen.friction.mu_k : c.specimen.friction.mu_s) * p.contact_y_mps2;
      EXPECT_LE(std::abs(p.contact_x_mps2), most + 1e-6);
      if (slides) {
        EXPECT_GE(std::abs(p.contact_x_mps2), most - 1e-6);
      }
      slips += slides;
    }
  }
  EXPECT_GT(slips, 50);
}

// Let go at theta_0, a block that does not slip comes down at q with q^2/2 (k^2 + R^2) = g (R cos(alpha - theta_0) - h); e q
// is left. The point turns about one corner before, about the other one after: its velocity jumps by
// q (z (1 - e), b (1 + e)).
TEST_P(FollowedPoint, FeelsTheBlowOfAnImpact) {
  const double theta = 0.1, z = 1.5;
  Specimen specimen{Block::rectangular(0.6, 1.8, 100), {20, 20}, {}};
  specimen.start.rotation_rad = theta;
  const Block& b = specimen.block;
  const double R = b.size_m(), e = 1 - 1.5 * std::pow(std::sin(b.alpha_rad()), 2);
  const double q = std::sqrt(2 * g * (R * std::cos(b.alpha_rad() - theta) - b.height_m) / (b.gyration2_m2 + R * R));
  Settings settings;
  settings.tolerance = 1e-12;
  settings.acceleration_height_m = z;
  const FloorMotion still = rectangular_pulse(0, 0.1);
  const Response r = GetParam()(specimen, {&still}, settings, nullptr);
  EXPECT_NEAR(r.largest_blow_mps, q * std::hypot(z * (1 - e), b.half_base_m() * (1 + e)), 1e-9);
}

// A sliding block that meets a wall at v comes back at e v: the jump is (1 + e) v at any height.
TEST_P(FollowedPoint, FeelsTheBlowOfAWall) {
  Specimen specimen{Block::rectangular(2, 1, 100), {0, 0}, {}, Model::slide};
  specimen.effects = {effect("wall_impact", {0.1, 0.4})};
  specimen.start.slip_velocity_mps = 0.5;
  Settings settings;
  settings.acceleration_height_m = 0.8;
  settings.free_vibration_s = 1;
  const FloorMotion still = rectangular_pulse(0, 0.1);
  const Response r = GetParam()(specimen, {&still}, settings, nullptr);
  EXPECT_EQ(r.wall_hits, 1);
  EXPECT_NEAR(r.largest_blow_mps, 1.4 * 0.5, 1e-12);
}

TEST(FollowedPointOfNone, IsNotANumberAndBlocksOfSamplesFollowItToo) {
  CaseFamily family;
  family.seed = 7;
  const RandomCase c = random_case(family, 3);
  EXPECT_TRUE(std::isnan(respond(c.specimen, c.shaking).peak_acceleration_at_height_mps2));
  Settings settings;
  settings.acceleration_height_m = c.specimen.block.height_m;  // of the centre of mass, beside the middle
  Response in_block;
  respond_batch({&c.specimen, 1}, {&c.shaking, 1}, settings, {&in_block, 1});
  const Response single = respond(c.specimen, c.shaking, settings);
  EXPECT_EQ(in_block.peak_acceleration_at_height_mps2, single.peak_acceleration_at_height_mps2);
  if (c.specimen.block.left_m == c.specimen.block.right_m) {
    EXPECT_NEAR(single.peak_acceleration_at_height_mps2, single.peak_acceleration_mps2, 1e-9);
  }
}

// The floor's acceleration in a history is that of the record, on a slope too, by Bouc-Wen's contact as by Coulomb's.
TEST_P(FollowedPoint, HistoriesHoldTheAccelerationOfTheRecord) {
  const FloorMotion push = rectangular_pulse(1.5, 0.5);
  for (const Model model : {Model::slide, Model::bouc_wen}) {
    Specimen specimen{Block::rectangular(2, 1, 100), {0.3, 0.3}, {}, model};
    specimen.effects = {effect("floor_tilt", {0.05})};
    History history;
    history.step_s = 0.1;
    GetParam()(specimen, {&push}, {}, &history);
    EXPECT_NEAR(history.points.at(2).floor_acceleration_mps2, 1.5, 1e-12);
  }
}

}  // namespace
}  // namespace freestand::test::point_test
