// The independent simulator of tests/support, checked against closed forms before anything is checked against it.
#include "support/contact_stepper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"

namespace freestand::test::contact_stepper_test {
namespace {

constexpr double g = standard_gravity_mps2;

Specimen block_of(double width_m, double height_m, double mu) {
  Specimen specimen;
  specimen.block = Block::rectangular(width_m, height_m, 100);
  specimen.friction = {mu, mu};
  specimen.impact.law = ImpactLaw::coulomb;
  return specimen;
}

FloorAt constant_floor(double acceleration_mps2, double duration_s) {
  return [=](double t) { return FloorAcceleration{t < duration_s ? acceleration_mps2 : 0.0, 0.0}; };
}

FloorAt sine_floor(double amplitude_mps2, double period_s) {
  return [=](double t) {
    return FloorAcceleration{t < period_s ? amplitude_mps2 * std::sin(2 * pi * t / period_s) : 0.0, 0.0};
  };
}

TEST(ContactStepper, SlidesAsNewmarkSays) {
  const double mu = 0.3, ratio = 2, T = 0.5;
  const StepperResult r = step_contacts(block_of(1, 1, mu), constant_floor(ratio * mu * g, T), {4e-6, 2, 1e-3});
  const double expected = 0.5 * ratio * mu * g * (ratio - 1) * T * T;
  EXPECT_NEAR(r.peak_slip_m, expected, 1e-5 * expected);
  EXPECT_NEAR(r.residual_slip_m, -expected, 1e-5 * expected);
  EXPECT_NEAR(r.slid_path_m, expected, 1e-4 * expected);
  EXPECT_EQ(r.peak_rotation_rad, 0);
}

TEST(ContactStepper, AStuckBlockDoesNotMoveAtAll) {
  const StepperResult r = step_contacts(block_of(0.6, 1, 0.5), sine_floor(0.499 * g, 0.7), {1e-5, 2, 1e-3});
  EXPECT_EQ(r.peak_slip_m, 0);
  EXPECT_EQ(r.peak_rotation_rad, 0);
}

TEST(ContactStepper, StickingImpactKeepsHousnersRate) {
  const Specimen specimen = block_of(0.4, 1.2, 5);
  const StepperResult r = step_contacts(specimen, constant_floor(6, 0.12), {5e-6, 2.5, 5e-6});
  const double alpha = specimen.block.alpha_rad(), e = 1 - 1.5 * std::pow(std::sin(alpha), 2);
  int found = 0;
  for (std::size_t i = 1; i < r.points.size() && found < 4; ++i) {
    const StepperPoint &before = r.points[i - 1], &after = r.points[i];
    const bool impact = before.left_closed != after.left_closed && before.right_closed != after.right_closed;
    if (!impact || after.left_closed == after.right_closed) continue;
    EXPECT_NEAR(after.rotation_rate_radps / before.rotation_rate_radps, e, 2e-4);
    ++found;
  }
  EXPECT_EQ(found, 4);
}

// Angular acceleration by PHYSICS section 2, rows rock and slide-rock (uniform block).
double expected_acceleration(const Specimen& specimen, const StepperPoint& p, double a) {
  const double alpha = specimen.block.alpha_rad(), R = specimen.block.size_m(), mu = specimen.friction.mu_k;
  const double s = p.right_closed ? 1 : -1, phi = alpha - std::abs(p.rotation_rad);
  const double sin_phi = std::sin(phi), cos_phi = std::cos(phi);
  if (p.contact_speed_mps == 0) return -0.75 / R * (s * g * sin_phi + a * cos_phi);
  const double sigma = p.contact_speed_mps > 0 ? 1 : -1;
  const double pull = g - R * p.rotation_rate_radps * p.rotation_rate_radps * cos_phi;
  return -pull / R * (s * sin_phi - sigma * mu * cos_phi) / (1.0 / 3 + sin_phi * (sin_phi - s * sigma * mu * cos_phi));
}

TEST(ContactStepper, ObeysTheEquationsOfRockAndSlideRock) {
  int rocking = 0, slide_rocking = 0;
  for (const double mu : {0.36, 0.42, 0.5, 0.7}) {
    const Specimen specimen = block_of(0.4, 1.0, mu);
    const FloorAt floor = sine_floor(1.1 * g, 0.7);
    const double dt = 1e-4;
    const StepperResult r = step_contacts(specimen, floor, {5e-6, 1.2, dt});
    for (std::size_t i = 10; i + 10 < r.points.size(); ++i) {
      bool one_mode = r.points[i].left_closed != r.points[i].right_closed;
      for (std::size_t k = i - 10; k <= i + 10; ++k) {
        one_mode = one_mode && r.points[k].left_closed == r.points[i].left_closed &&
                   r.points[k].right_closed == r.points[i].right_closed &&
                   (r.points[k].contact_speed_mps > 0) == (r.points[i].contact_speed_mps > 0) &&
                   (r.points[k].contact_speed_mps < 0) == (r.points[i].contact_speed_mps < 0);
      }
      const double t = r.points[i].time_s;
      if (!one_mode || std::abs(t - 0.7) < 5e-3) continue;
      const double measured = (r.points[i + 1].rotation_rate_radps - r.points[i - 1].rotation_rate_radps) / (2 * dt);
      const double expected = expected_acceleration(specimen, r.points[i], floor(t).horizontal_mps2);
      ASSERT_NEAR(measured, expected, 1e-4 * (1 + std::abs(expected))) << "mu " << mu << " at " << t << " s";
      ++(r.points[i].contact_speed_mps == 0 ? rocking : slide_rocking);
    }
  }
  EXPECT_GT(rocking, 1000);
  EXPECT_GT(slide_rocking, 1000);
}

// PHYSICS section 3, law `coulomb`: rate and slip speed after the impact from those before it.
void expect_coulomb_impact(const Specimen& specimen, const StepperPoint& before, const StepperPoint& after) {
  const double R2 = std::pow(specimen.block.size_m(), 2), b = specimen.block.left_m, h = specimen.block.height_m;
  const double mu = specimen.friction.mu_k, s = before.right_closed ? 1 : -1;
  const double q = before.rotation_rate_radps, w = before.contact_speed_mps;
  double q_after = ((4.0 / 3 * R2 - 2 * b * b) * q + h * w) / (4.0 / 3 * R2);
  double w_after = 0;
  const double p_y = -s * b * (q_after + q), p_x = h * q_after - w - h * q;
  if (std::abs(p_x) > mu * p_y) {
    const double sigma = p_x > 0 ? -1 : 1, arm = s * b + sigma * mu * h;
    q_after = q * (R2 / 3 - s * b * arm) / (R2 / 3 + s * b * arm);
    // X' = w + h q changes by p_x = -sigma mu p_y
    w_after = w + h * q - sigma * mu * (-s * b * (q_after + q)) - h * q_after;
    EXPECT_GT(sigma * w_after, 0);
  }
  EXPECT_NEAR(after.rotation_rate_radps, q_after, 1e-3 * std::abs(q));
  EXPECT_NEAR(after.contact_speed_mps, w_after, 1e-3 * (std::abs(w) + h * std::abs(q)));
}

TEST(ContactStepper, SlippingImpactsObeyTheImpulseEquations) {
  int slipping = 0;
  for (const double width : {0.2, 0.25, 0.3}) {
    for (const double period : {0.3, 0.4, 0.5}) {
      const Specimen specimen = block_of(width, 1.0, width + 0.05);
      const double amplitude = 1.2;
      const FloorAt floor = [=](double t) {
        return FloorAcceleration{t < 3 * period ? amplitude * g * std::sin(2 * pi * t / period) : 0.0, 0.0};
      };
      const StepperResult r = step_contacts(specimen, floor, {1e-5, 2, 1e-5});
      for (std::size_t i = 1; i < r.points.size(); ++i) {
        const StepperPoint &before = r.points[i - 1], &after = r.points[i];
        const bool one_each = before.left_closed != before.right_closed && after.left_closed != after.right_closed;
        if (!one_each || before.left_closed == after.left_closed || std::abs(before.rotation_rate_radps) < 0.05)
          continue;
        expect_coulomb_impact(specimen, before, after);
        slipping += after.contact_speed_mps != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GE(slipping, 3);
}

TEST(ContactStepper, ErrorFallsAtLeastInStepWithTheStep) {
  CaseFamily family;
  family.seed = 5;
  family.duration_low_s = family.duration_high_s = 1.5;
  family.one_model = 0;
  family.alpha_high = 0.6;
  std::vector<double> coarse, fine;
  for (std::uint64_t i = 0; i < 31; ++i) {
    const RandomCase c = random_case(family, i);
    StepperResult r[3];
    for (int k = 0; k < 3; ++k)
      r[k] = step_contacts(c.specimen, floor_of(c.shaking), {1.28e-4 / std::pow(8, k), c.shaking.duration_s(), 1e-2});
    coarse.push_back(std::abs(r[0].peak_slip_m - r[2].peak_slip_m));
    fine.push_back(std::abs(r[1].peak_slip_m - r[2].peak_slip_m));
  }
  std::sort(coarse.begin(), coarse.end());
  std::sort(fine.begin(), fine.end());
  EXPECT_LT(fine[15], coarse[15] / 6);  // medians: long rattling is chaotic, so the worst cases say nothing
  EXPECT_LT(fine[15], 5e-6);
}

}  // namespace
}  // namespace freestand::test::contact_stepper_test
