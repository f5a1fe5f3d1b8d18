// The generator against what can be written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/units.hpp"
#include "hidden_effect/generator.hpp"

namespace freestand::test {
namespace {

constexpr double g = standard_gravity_mps2, dt_s = 0.005;

// a over the first `samples` steps, down to zero in the next, then still until end_s.
FloorSamples pushed(double a_mps2, int samples, double end_s) {
  FloorSamples floor{dt_s, std::vector<double>(static_cast<std::size_t>(end_s / dt_s), 0.0), {}};
  std::fill_n(floor.horizontal_mps2.begin(), samples + 1, a_mps2);
  return floor;
}

TEST(HiddenEffectGenerator, SlidesAsNewmarkSays) {
  const double mu = 0.3, a = 2 * mu * g, T = 0.5;
  const TruthHistory h = simulate(rectangular_truth(1, 1, mu), pushed(a, 100, 3));
  const double v1 = -(a - mu * g) * T, x1 = 0.5 * v1 * T;
  const double v2 = v1 - 0.5 * a * dt_s + mu * g * dt_s;
  const double x2 = x1 + v1 * dt_s - a * dt_s * dt_s / 3 + 0.5 * mu * g * dt_s * dt_s;
  const double end = x2 - 0.5 * v2 * v2 / (mu * g);
  EXPECT_NEAR(h.slip_m[100], x1, 1e-7);
  EXPECT_NEAR(h.residual_slip_m, end, 1e-7);
  EXPECT_NEAR(h.peak_slip_m, -end, 1e-7);
  EXPECT_EQ(h.peak_rotation_rad, 0);
  EXPECT_EQ(h.outcome, "moved");
}

// x'' = -(a - mu g) - c x'
TEST(HiddenEffectGenerator, SlidesThroughADragAsTheExponentialSays) {
  const double mu = 0.2, a = 4, c = 3, T = 0.8;
  const Truth truth = rectangular_truth(1, 0.8, mu, {{"viscous_drag", {{"rate_per_s", c}}}});
  const TruthHistory h = simulate(truth, pushed(a, 160, 1));
  const double limit = -(a - mu * g) / c;
  EXPECT_NEAR(h.slip_m[160], limit * (T - (1 - std::exp(-c * T)) / c), 1e-7);
}

TEST(HiddenEffectGenerator, DoesNotMoveAtAllUnderWhatFrictionHolds) {
  const Truth truth = rectangular_truth(0.8, 0.6, 0.3, {{"floor_tilt", {{"angle_rad", 0.05}}}});
  const double held = 0.3 * g * std::cos(0.05) - g * std::sin(0.05);
  const TruthHistory stuck = simulate(truth, pushed(0.999 * held, 200, 2));
  EXPECT_EQ(stuck.outcome, "at_rest");
  EXPECT_EQ(stuck.peak_slip_m, 0);
  EXPECT_EQ(simulate(truth, pushed(1.001 * held, 200, 2)).outcome, "moved");
}

// Largest rotations between impacts after `from`, by the parabola through the three samples about each.
std::vector<double> peaks(const std::vector<double>& rotation, std::size_t from) {
  std::vector<double> found;
  for (std::size_t i = from; i + 1 < rotation.size(); ++i) {
    const double a = std::abs(rotation[i - 1]), b = std::abs(rotation[i]), c = std::abs(rotation[i + 1]);
    if (b > a && b >= c && b > 0.01) found.push_back(b + (a - c) * (a - c) / (8 * (2 * b - a - c)));
  }
  return found;
}

// Free rocking keeps theta'^2/(2 p^2) + cos(alpha - |theta|) between impacts: two peaks tell the rates about an impact.
TEST(HiddenEffectGenerator, LosesAtAnImpactWhatHousnerSays) {
  const double width = 0.5, height = 1.6, alpha = std::atan(width / height);
  for (const double factor : {1.0, 0.9}) {
    std::vector<TruthEffect> effects;
    if (factor < 1) effects = {{"impact_loss", {{"factor", factor}}}};
    const TruthHistory h = simulate(rectangular_truth(width, height, 5, effects), pushed(5, 50, 8));
    const std::vector<double> peak = peaks(h.rotation_rad, 60);
    ASSERT_GE(peak.size(), 4u);
    const auto rate = [&](double turned) { return std::sqrt(2 * (std::cos(alpha - turned) - std::cos(alpha))); };
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(rate(peak[i + 1]) / rate(peak[i]), factor * (1 - 1.5 * std::pow(std::sin(alpha), 2)), 1e-5);
  }
}

TEST(HiddenEffectGenerator, RefusesEffectsAndParametersThatDoNotExist) {
  const FloorSamples floor = pushed(1, 10, 0.1);
  EXPECT_THROW(simulate(rectangular_truth(1, 1, 0.2, {{"glue", {}}}), floor), std::invalid_argument);
  EXPECT_THROW(simulate(rectangular_truth(1, 1, 0.2, {{"viscous_drag", {}}}), floor), std::invalid_argument);
  EXPECT_THROW(simulate(rectangular_truth(1, 1, 0.2, {{"floor_tilt", {{"angle", 1}}}}), floor), std::invalid_argument);
}

// Far below its yield a contact is a spring, w^2 = mu g/u_y: u = -(a/w^2)(1 - cos wt).
TEST(HiddenEffectGenerator, RingsOnABoucWenContact) {
  const double mu = 0.3, yield = 0.002, a = 0.2 * mu * g, w = std::sqrt(mu * g / yield);
  Truth truth = rectangular_truth(1, 1, mu);
  truth.model = TruthModel::bouc_wen;
  truth.contact = {yield, 40, 0.5, 0.5};
  const TruthHistory h = simulate(truth, pushed(a, 190, 1));
  for (std::size_t i = 0; i < 190; ++i)
    ASSERT_NEAR(h.slip_m[i], -a / (w * w) * (1 - std::cos(w * dt_s * static_cast<double>(i))), 1e-8 * yield);
  EXPECT_EQ(h.outcome, "at_rest");
}

// n = 1: z = 1 - exp(-u/u_y) in loading, and what push and contact do in work is the speed of the block. While it goes one way
// the path is what remains of the slip.
TEST(HiddenEffectGenerator, YieldsOnABoucWenContactAsTheExponentialSays) {
  const double mu = 0.3, yield = 0.01, a = 2 * mu * g;
  Truth truth = rectangular_truth(1, 1, mu);
  truth.model = TruthModel::bouc_wen;
  for (const double gamma : {0.5, 0.7}) {
    truth.contact = {yield, 1, gamma, 1 - gamma};
    const TruthHistory h = simulate(truth, pushed(a, 50, 1));
    for (std::size_t i = 1; i < 50; ++i) {
      const double u = -h.slip_m[i], z = 1 - std::exp(-u / yield);
      ASSERT_NEAR(-h.remaining_m[i], u - yield * z, 1e-7 * yield);
      ASSERT_NEAR(h.path_m[i], u - yield * z, 1e-7 * yield);
      ASSERT_NEAR(h.block_acceleration_mps2[i], mu * g * z, 1e-6);
      if (i == 1 || i == 49) continue;
      const double speed = (h.slip_m[i - 1] - h.slip_m[i + 1]) / (2 * dt_s);
      ASSERT_NEAR(0.5 * speed * speed, a * u - mu * g * (u - yield * z), 0.01 * a * u);
    }
    EXPECT_EQ(h.outcome, "moved");
  }
}

}  // namespace
}  // namespace freestand::test
