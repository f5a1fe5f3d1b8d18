// Free rocking after a pulse: exact times of impact by quadrature, energy, the ratio of successive amplitudes, and the
// impact law `coulomb` where it sticks.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/rocking.hpp"
#include "support/solvers.hpp"

namespace freestand::test::free_rocking_test {
namespace {

constexpr double g = standard_gravity_mps2;
FREESTAND_ON_BOTH_SOLVERS(FreeRocking);

Settings tight() {
  Settings settings;
  settings.tolerance = 1e-13;
  return settings;
}

Specimen rocking_block(double R, double alpha, double factor = 1) {
  Specimen specimen;
  specimen.block = Block::rectangular(2 * R * std::sin(alpha), 2 * R * std::cos(alpha), 100);
  specimen.friction = {20, 20};
  specimen.impact = {ImpactLaw::housner, factor};
  return specimen;
}

TEST(RockingTheory, QuarterPeriodIsHousnersForSlenderBlocks) {
  for (const double ratio : {0.1, 0.5, 0.9}) {
    const RockingBlock slender{2, 1e-4};
    EXPECT_NEAR(fall_time_s(slender, ratio * 1e-4), std::acosh(1 / (1 - ratio)) / 2, 1e-8);
    const RockingBlock stocky{2, 0.4};
    const double exact = fall_time_s(stocky, ratio * 0.4), housner = std::acosh(1 / (1 - ratio)) / 2;
    EXPECT_GT(std::abs(exact - housner), 1e-4);  // so it is no test at 1e-9 of a block that is not slender
  }
}

// The quadrature against a plain integration of the equation of motion.
TEST(RockingTheory, QuadratureAgreesWithIntegration) {
  const RockingBlock block{3, 0.3};
  const double peak = 0.2, h = 1e-5, T = fall_time_s(block, peak);
  RockingState state{peak, 0};
  const auto still = [](double) { return 0.0; };
  for (double t = 0; t < T; t += h) state = advance_rocking(block, state, 1, t, std::min(h, T - t), still);
  EXPECT_NEAR(state.theta, 0, 1e-11);
}

struct Released {  // what the pulse left behind: rocking about one corner, moving outwards
  double time_s, theta, rate;
};

// Constant acceleration a_g g for T seconds, by fine integration with the state before lift-off at rest.
Released after_pulse(const RockingBlock& block, double a_g, double T) {
  RockingState state;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i)
    state = advance_rocking(block, state, a_g > 0 ? -1 : 1, 0, T / steps, [=](double) { return a_g; });
  return {T, std::abs(state.theta), std::abs(state.rate)};
}

// Impact times after the pulse: outwards to the peak, back, and a whole swing between impacts.
std::vector<double> impact_times(const RockingBlock& block, const Released& start, double e, int count) {
  double peak = peak_of(block, start.theta, start.rate);
  double t = start.time_s + fall_time_s(block, peak, start.theta) + fall_time_s(block, peak);
  std::vector<double> times{t};
  for (int i = 1; i < count; ++i) {
    const double cos_alpha = std::cos(block.alpha_rad), drop = std::cos(block.alpha_rad - peak) - cos_alpha;
    peak = block.alpha_rad - std::acos(cos_alpha + e * e * drop);
    t += 2 * fall_time_s(block, peak);
    times.push_back(t);
  }
  return times;
}

TEST_P(FreeRocking, ImpactTimesAreThoseOfTheQuadrature) {
  for (const double alpha : {0.12, 0.25, 0.45}) {
    for (const double R : {0.5, 2.0}) {
      for (const double factor : {1.0, 0.85}) {
        const Specimen specimen = rocking_block(R, alpha, factor);
        const RockingBlock block{specimen.block.p_radps(), alpha};
        const double a_g = -1.8 * std::tan(alpha), T = 0.5 / block.p_radps;
        const FloorMotion motion = rectangular_pulse(a_g * g, T);
        History history;
        history.step_s = 0;
        const Response r = GetParam()(specimen, {&motion}, tight(), &history);
        ASSERT_EQ(r.outcome, Outcome::moved);
        std::vector<double> found;
        for (const Event& event : history.events)
          if (event.impact) found.push_back(event.time_s);
        const std::vector<double> expected =
            impact_times(block, after_pulse(block, a_g, T), factor * block.restitution(), 6);
        ASSERT_GE(found.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
          EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]) << "impact " << i << " alpha " << alpha << " R " << R;
        const Released start = after_pulse(block, a_g, T);
        EXPECT_NEAR(r.peak_rotation_rad, peak_of(block, start.theta, start.rate), 1e-9 * alpha);
        EXPECT_EQ(r.slid_path_m, 0);
      }
    }
  }
}

// E = theta'^2/(2 p^2) + cos(alpha - |theta|) - cos(alpha), zero for the block standing still.
double energy(const RockingBlock& block, const HistoryPoint& point) {
  const double rate = point.rotation_rate_radps / block.p_radps, theta = std::abs(point.rotation_rad);
  // cos(alpha - theta) - cos(alpha) without cancellation
  return 0.5 * rate * rate + 2 * std::sin(block.alpha_rad - 0.5 * theta) * std::sin(0.5 * theta);
}

TEST_P(FreeRocking, EnergyIsKeptBetweenImpactsAndFallsByTheSquareOfTheRateRatio) {
  const double alpha = 0.2;
  for (const double factor : {1.0, 0.9}) {
    const Specimen specimen = rocking_block(1.2, alpha, factor);
    const RockingBlock block{specimen.block.p_radps(), alpha};
    const double T = 0.2, e = factor * block.restitution();
    const FloorMotion motion = rectangular_pulse(2 * g * std::tan(alpha), T);
    History history;
    history.step_s = 1e-3;
    GetParam()(specimen, {&motion}, tight(), &history);
    std::vector<double> impacts{T};
    for (const Event& event : history.events)
      if (event.impact) impacts.push_back(event.time_s);
    ASSERT_GE(impacts.size(), 8u);
    double before = 0;
    for (std::size_t swing = 0; swing + 1 < 8; ++swing) {
      double least = 1e300, most = 0;
      int points = 0;
      for (const HistoryPoint& point : history.points) {
        if (point.time_s < impacts[swing] + 1e-6 || point.time_s > impacts[swing + 1] - 1e-6) continue;
        ASSERT_EQ(point.mode, Mode::rock);
        const double value = energy(block, point);
        least = std::min(least, value);
        most = std::max(most, value);
        ++points;
      }
      ASSERT_GT(points, 10);
      EXPECT_LT(most - least, 1e-9 * most) << "swing " << swing;
      // Amplitudes: cos(alpha - peak_n) - cos(alpha) falls by e^2 from swing to swing.
      if (swing > 0) {
        EXPECT_NEAR(most / before, e * e, 1e-9);
      }
      before = most;
    }
  }
}

// With two half widths and a given inertia: the energy of the swing about each corner, and the rate ratio
// e = (k^2 + h^2 - b_l b_r)/(k^2 + h^2 + b_new^2) from the angular momentum about the new corner.
TEST_P(FreeRocking, UnequalHalfWidths) {
  Specimen specimen = rocking_block(1.2, 0.25);
  Block& b = specimen.block;
  b.left_m *= 0.8;
  b.right_m *= 1.1;
  b.gyration2_m2 *= 0.9;
  const FloorMotion motion = rectangular_pulse(0.4 * g, 0.15);
  History history;
  history.step_s = 1e-3;
  const Response r = GetParam()(specimen, {&motion}, tight(), &history);
  ASSERT_EQ(r.outcome, Outcome::moved);
  const auto swing_energy = [&](const HistoryPoint& point) {  // per unit mass, above standing still
    const double arm = point.rotation_rad > 0 ? b.right_m : b.left_m, theta = std::abs(point.rotation_rad);
    const double inertia = b.gyration2_m2 + b.height_m * b.height_m + arm * arm;
    const double lift = arm * std::sin(theta) - 2 * b.height_m * std::pow(std::sin(0.5 * theta), 2);
    return 0.5 * inertia * std::pow(point.rotation_rate_radps, 2) + g * lift;
  };
  double rate_before = 0;
  int swings = 0;
  std::vector<double> impacts{0.15};
  for (const Event& event : history.events)
    if (event.impact) impacts.push_back(event.time_s);
  ASSERT_GE(impacts.size(), 6u);
  for (std::size_t swing = 0; swing + 1 < 6; ++swing) {
    double first = -1, arm = 0;
    for (const HistoryPoint& point : history.points) {
      if (point.time_s < impacts[swing] + 1e-6 || point.time_s > impacts[swing + 1] - 1e-6) continue;
      const double value = swing_energy(point);
      if (first < 0) first = value;
      EXPECT_NEAR(value, first, 1e-9 * first);
      arm = point.rotation_rad > 0 ? b.right_m : b.left_m;
    }
    const double inertia = b.gyration2_m2 + b.height_m * b.height_m + arm * arm;
    const double rate = std::sqrt(2 * first / inertia);  // at rotation 0, before and after the swing
    if (swing > 0) {
      const double e = (b.gyration2_m2 + b.height_m * b.height_m - b.left_m * b.right_m) / inertia;
      EXPECT_NEAR(rate / rate_before, e, 1e-9);
    }
    rate_before = rate;
    ++swings;
  }
  EXPECT_EQ(swings, 5);
}

TEST_P(FreeRocking, CoulombImpactIsHousnersWhenItSticks) {
  Specimen housner = rocking_block(1, 0.3), coulomb = housner;
  coulomb.impact.law = ImpactLaw::coulomb;
  const FloorMotion motion = rectangular_pulse(0.6 * g, 0.2);
  History a, b;
  a.step_s = b.step_s = 0.01;
  const Response ra = GetParam()(housner, {&motion}, tight(), &a), rb = GetParam()(coulomb, {&motion}, tight(), &b);
  ASSERT_EQ(ra.outcome, Outcome::moved);
  EXPECT_EQ(rb.outcome, Outcome::moved);
  EXPECT_GT(ra.impacts, 5);
  EXPECT_EQ(ra.impacts, rb.impacts);
  EXPECT_NEAR(ra.peak_rotation_rad, rb.peak_rotation_rad, 1e-12);
  EXPECT_NEAR(ra.peak_slip_m, rb.peak_slip_m, 1e-12);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    ASSERT_NEAR(a.points[i].rotation_rad, b.points[i].rotation_rad, 1e-10);
    ASSERT_NEAR(a.points[i].slip_m, b.points[i].slip_m, 1e-10);
  }
}

// Impacts of a stocky block: 1 - 1.5 sin^2(alpha) < 0 above alpha = 0.955, so it lands flat and rocking ends there.
TEST_P(FreeRocking, AStockyBlockLandsFlat) {
  for (const ImpactLaw law : {ImpactLaw::housner, ImpactLaw::coulomb}) {
    Specimen specimen = rocking_block(1, 1.05);
    specimen.impact.law = law;
    const FloorMotion motion = rectangular_pulse(2.5 * g, 0.1);
    History history;
    const Response r = GetParam()(specimen, {&motion}, {}, &history);
    EXPECT_EQ(r.outcome, Outcome::moved);
    EXPECT_EQ(r.impacts, 1);
    EXPECT_EQ(history.events.back().to, Mode::rest);
    EXPECT_GT(r.peak_rotation_rad, 0.01);
    EXPECT_EQ(r.residual_rotation_rad, 0);
  }
}

}  // namespace
}  // namespace freestand::test::free_rocking_test
