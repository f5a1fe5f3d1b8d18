// Pure sliding: Newmark's closed form, blocks that must stay still, and the onset of motion.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/keyed_random.hpp"
#include "support/solvers.hpp"

namespace freestand::test::sliding_test {
namespace {

constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(Sliding);
FREESTAND_ON_BOTH_SOLVERS(Onset);

Specimen wide_block(double mu_s, double mu_k) {
  Specimen specimen;
  specimen.block = Block::rectangular(2.5, 1, 100);
  specimen.friction = {mu_s, mu_k};
  return specimen;
}

// [KM05 5.10] U w^2/a_p = 2 pi^2 (a_p/(mu g) - 1), w = 2 pi/T. It belongs to one constant pulse a_p of duration T:
// the block gains (a_p - mu g) T on the floor and loses it at mu g, so U = (a_p - mu g) T^2/2 + ((a_p - mu g) T)^2/(2
// mu g), slip after the pulse included.
TEST_P(Sliding, NewmarksPulse) {
  for (const double mu : {0.02, 0.1, 0.3, 0.7, 1.2}) {
    for (const double ratio : {1.01, 1.5, 3.0, 20.0}) {
      for (const double T : {0.05, 0.5, 3.0}) {
        for (const double sign : {1.0, -1.0}) {
          const double a_p = ratio * mu * g, w = 2 * pi / T;
          const FloorMotion motion = rectangular_pulse(sign * a_p, T);
          const Response r = GetParam()(wide_block(mu, mu), {&motion});
          const double expected = 2 * pi * pi * (ratio - 1);
          ASSERT_EQ(r.outcome, Outcome::moved);
          ASSERT_NEAR(r.peak_slip_m * w * w / a_p, expected, 1e-10 * expected) << mu << ' ' << ratio << ' ' << T;
          ASSERT_NEAR(r.residual_slip_m, -sign * r.peak_slip_m, 1e-10 * r.peak_slip_m);
          ASSERT_NEAR(r.slid_path_m, r.peak_slip_m, 1e-10 * r.peak_slip_m);
          ASSERT_NEAR(r.end_time_s, T * ratio, 1e-10 * T * ratio);
          ASSERT_NEAR(r.peak_acceleration_mps2, mu * g, 1e-10 * mu * g);
          ASSERT_EQ(r.peak_rotation_rad, 0);
          ASSERT_EQ(r.impacts, 0);
        }
      }
    }
  }
}

// The pulse is the same motion however its record is cut.
TEST_P(Sliding, KnotsDoNotMatter) {
  const double mu = 0.3, a_p = 2 * mu * g, T = 0.5;
  const FloorMotion whole = rectangular_pulse(a_p, T);
  FloorMotion cut = whole;
  for (int i = 0; i < 7; ++i) cut = with_halved_segments(cut);
  const Response a = GetParam()(wide_block(mu, mu), {&whole}), b = GetParam()(wide_block(mu, mu), {&cut});
  EXPECT_NEAR(a.peak_slip_m, b.peak_slip_m, 1e-12 * a.peak_slip_m);
  EXPECT_EQ(a.events, b.events);
}

// Static friction decides when it starts, kinetic friction how far it goes.
TEST_P(Sliding, TwoCoefficients) {
  const double mu_s = 0.4, mu_k = 0.25, T = 0.4;
  const FloorMotion below = rectangular_pulse(0.399 * g, T), above = rectangular_pulse(0.401 * g, T);
  EXPECT_EQ(GetParam()(wide_block(mu_s, mu_k), {&below}).outcome, Outcome::at_rest);
  const Response r = GetParam()(wide_block(mu_s, mu_k), {&above});
  const double ratio = 0.401 / mu_k, expected = 0.5 * mu_k * g * T * T * ratio * (ratio - 1);
  EXPECT_NEAR(r.peak_slip_m, expected, 1e-10 * expected);
}

// Forward and back: constant accelerations, slip stops, sticks, and starts the other way. All in closed form.
TEST_P(Sliding, ForwardStickAndBack) {
  const double mu = 0.2, a1 = 0.5 * g, a2 = -0.45 * g;
  // 0.3 s at a1: slips back; stops after v/(mu g) = 0.45 s; still until 1 s; 0.2 s at a2.
  const FloorMotion motion = staircase({0.3, 0.7, 0.2}, {a1, 0, a2});
  const double v1 = (0.5 - mu) * g * 0.3, u1 = -0.5 * v1 * 0.3 - v1 * v1 / (2 * mu * g);
  const double v2 = (0.45 - mu) * g * 0.2, u2 = u1 + 0.5 * v2 * 0.2 + v2 * v2 / (2 * mu * g);
  History history;
  const Response r = GetParam()(wide_block(mu, mu), {&motion}, {}, &history);
  EXPECT_NEAR(r.peak_slip_m, -u1, 1e-10);
  EXPECT_NEAR(r.residual_slip_m, u2, 1e-10);
  EXPECT_NEAR(r.slid_path_m, -u1 + (u2 - u1), 1e-10);
  ASSERT_EQ(history.events.size(), 4u);
  const double expected_s[] = {0, 0.3 + v1 / (mu * g), 1, 1.2 + v2 / (mu * g)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(history.events[i].time_s, expected_s[i], 1e-9);
    EXPECT_EQ(history.events[i].to, i % 2 == 0 ? Mode::slide : Mode::rest);
  }
}

// Slip reverses at once where the floor's deceleration is above the threshold when the slip speed passes zero.
TEST_P(Sliding, Reversal) {
  const double mu = 0.2, a1 = 0.5 * g, a2 = -0.6 * g;
  const FloorMotion motion = staircase({0.3, 0.5}, {a1, a2});
  const double v1 = (0.5 - mu) * g * 0.3, back = (0.6 + mu) * g, t1 = v1 / back;
  const double u1 = -0.5 * v1 * 0.3 - 0.5 * v1 * t1, t2 = 0.5 - t1, v2 = (0.6 - mu) * g * t2;
  const double u2 = u1 + 0.5 * v2 * t2 + v2 * v2 / (2 * mu * g);
  const Response r = GetParam()(wide_block(mu, mu), {&motion});
  EXPECT_NEAR(r.peak_slip_m, std::max(-u1, u2), 1e-10);
  EXPECT_NEAR(r.residual_slip_m, u2, 1e-10);
  EXPECT_NEAR(r.slid_path_m, -u1 + (u2 - u1), 1e-10);
}

// Vertical shaking changes the friction: g' = g + v. Constant v and a: Newmark with g' during the pulse, g after it.
TEST_P(Sliding, VerticalShakingChangesFriction) {
  const double mu = 0.3, a = 0.6 * g, v = -0.4 * g, T = 0.3, with = g + v;
  const FloorMotion motion = staircase({T}, {a}, {v});
  Shaking shaking{&motion};
  shaking.vertical_scale = 1;
  const double speed = (a - mu * with) * T, expected = 0.5 * speed * T + speed * speed / (2 * mu * g);
  EXPECT_NEAR(GetParam()(wide_block(mu, mu), shaking).peak_slip_m, expected, 1e-10 * expected);
}

FloorMotion noise_below(double fraction, const Block& block, double mu_s, std::uint64_t number, bool vertical) {
  KeyedRandom random(11, number);
  std::vector<double> a, v;
  double x = 0, y = 0;
  for (int i = 0; i < 400; ++i) {
    x = 0.8 * x + random.normal();
    y = 0.8 * y + random.normal();
    a.push_back(x);
    v.push_back(std::max(-0.9 * g, std::min(0.9 * g, 0.2 * g * y)));
  }
  // |a| - c (g + v) is linear between knots, so the knots decide. a > 0 tips over the left corner.
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double arm = (a[i] > 0 ? block.left_m : block.right_m) / block.height_m;
    most = std::max(most, std::abs(a[i]) / (std::min(mu_s, arm) * (g + (vertical ? v[i] : 0.0))));
  }
  for (double& value : a) value *= fraction / most;
  return piecewise_linear("noise", 0.01, a, vertical ? v : std::vector<double>{});
}

TEST_P(Onset, BelowTheThresholdNothingMovesAtAll) {
  for (std::uint64_t number = 0; number < 100; ++number) {
    KeyedRandom random(3, number);
    Specimen specimen;
    specimen.block = Block::rectangular(random.uniform(0.2, 2), random.uniform(0.4, 2), 100);
    if (number % 3 == 0) specimen.block.left_m *= 0.7;
    const double mu = random.uniform(0.05, 1.2);
    specimen.friction = {mu, mu * random.uniform(0.5, 1)};
    if (number % 2 == 0) specimen.impact.law = ImpactLaw::coulomb;
    const bool vertical = number % 4 < 2;
    const FloorMotion motion = noise_below(1 - 1e-9, specimen.block, mu, number, vertical);
    Shaking shaking{&motion};
    shaking.vertical_scale = vertical ? 1 : 0;
    History history;
    const Response r = GetParam()(specimen, shaking, {}, &history);
    ASSERT_EQ(r.outcome, Outcome::at_rest) << number;
    ASSERT_EQ(r.peak_slip_m, 0);
    ASSERT_EQ(r.residual_slip_m, 0);
    ASSERT_EQ(r.slid_path_m, 0);
    ASSERT_EQ(r.peak_rotation_rad, 0);
    ASSERT_EQ(r.events, 0);
    for (const HistoryPoint& p : history.points)
      ASSERT_TRUE(p.slip_m == 0 && p.rotation_rad == 0 && p.mode == Mode::rest);
    const FloorMotion stronger = noise_below(1 + 1e-6, specimen.block, mu, number, vertical);
    Shaking above = shaking;
    above.motion = &stronger;
    ASSERT_EQ(GetParam()(specimen, above).outcome, Outcome::moved) << number;
  }
}

TEST_P(Onset, SlidesAsSoonAsTheThresholdIsPassed) {
  const double mu = 0.3, excess = 1e-6, T = 1;
  const FloorMotion motion = rectangular_pulse(mu * g * (1 + excess), T);
  const Response r = GetParam()(wide_block(mu, mu), {&motion});
  EXPECT_EQ(r.outcome, Outcome::moved);
  const double expected = 0.5 * mu * g * excess * (1 + excess) * T * T;
  EXPECT_NEAR(r.peak_slip_m, expected, 1e-6 * expected);
}

// Just above a = g tan(alpha): theta'' = p^2 (theta + excess sin alpha), so theta = excess sin(alpha) (cosh(p T) - 1)
// at T.
TEST_P(Onset, RocksAsSoonAsTheThresholdIsPassed) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.5, 1.5, 100);
  specimen.friction = {0.9, 0.9};
  const double alpha = specimen.block.alpha_rad(), p = specimen.block.p_radps(), excess = 1e-6;
  const double T = 0.5;
  const FloorMotion motion = rectangular_pulse(g * std::tan(alpha) * (1 + excess), T);
  History history;
  history.step_s = 0.1;
  const Response r = GetParam()(specimen, {&motion}, {}, &history);
  EXPECT_EQ(r.outcome, Outcome::moved);
  // The tilted gravity of a and g together is g/cos(alpha) at the threshold, and so is its stiffness.
  const double stiff = p / std::sqrt(std::cos(alpha)), amount = excess * std::sin(alpha) * std::cos(alpha);
  for (const HistoryPoint& point : history.points) {
    if (point.time_s > T || point.time_s < 0.05) continue;
    const double expected = -amount * (std::cosh(stiff * point.time_s) - 1);
    EXPECT_NEAR(point.rotation_rad, expected, 1e-3 * std::abs(expected));
  }
}

}  // namespace
}  // namespace freestand::test::sliding_test
