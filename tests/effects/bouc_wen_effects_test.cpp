// Effects on a Bouc-Wen contact: closed forms, and every effect that goes with the model on both integrators.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "effects/effect_fixture.hpp"
#include "support/bouc_wen_cases.hpp"

namespace freestand::test {
namespace {

Specimen on_contact(double mu, double yield_displacement_m, double exponent, const std::vector<EffectUse>& effects) {
  Specimen specimen = sliding(mu, effects);
  specimen.model = Model::bouc_wen;
  specimen.bouc_wen = {yield_displacement_m, exponent, 0.5, 0.5};
  return specimen;
}

bool goes_with(const effects::Effect& effect, const std::string& name) {
  return std::find(effect.excludes.begin(), effect.excludes.end(), name) == effect.excludes.end();
}

// Below the yield the spring adds to the contact's stiffness: u = -(a/w^2)(1 - cos wt), w^2 = mu g/u_y + (2 pi f)^2.
TEST(BoucWenEffects, ACenteringSpringAddsToTheElasticStiffness) {
  const double mu = 0.3, yield = 0.002, f = 5, w = std::sqrt(mu * g / yield + std::pow(2 * pi * f, 2)), a = 0.05 * g;
  const FloorMotion push = rectangular_pulse(a, 1.0);
  for (const Solver& solver : both_solvers) {
    const Path path = run(solver, on_contact(mu, yield, 20, {effect("centering_spring", {f})}), {&push});
    for (const HistoryPoint& p : path.points) {
      if (p.time_s >= 1) break;
      ASSERT_NEAR(p.slip_m, -a / (w * w) * (1 - std::cos(w * p.time_s)), 1e-9 * yield) << solver;
    }
    EXPECT_NEAR(path.response.peak_acceleration_mps2, 2 * a, 1e-6) << solver;
  }
}

// A drag that stops the block within a tenth of a microsecond takes steps of that length: the sample is given up, not followed for minutes.
TEST(BoucWenEffects, ALawThatIsFarTooStiffIsGivenUp) {
  const FloorMotion push = rectangular_pulse(0.5 * g, 20);
  EXPECT_EQ(respond(on_contact(0.2, 1e-5, 20, {effect("viscous_drag", {1e7})}), {&push}).outcome, Outcome::step_limit);
  EXPECT_EQ(respond(on_contact(0.2, 1e-5, 20, {effect("viscous_drag", {10})}), {&push}).outcome, Outcome::moved);
}

// Sliding under a steady push, as u_y goes to zero, Coulomb's block with the same effect: drag brings it to the speed
// (a - mu g)/c, weakening friction to (a - mu (1 - d) g) t.
TEST(BoucWenEffects, StiffContactsSlideAsCoulombsBlockWithTheSameEffect) {
  const double mu = 0.2;
  const FloorMotion push = rectangular_pulse(0.5 * g, 0.6);
  for (const auto& use : {effect("viscous_drag", {1.5}), effect("rate_weakening", {0.4, 0.1}),
                          effect("friction_wear", {0.6, 0.3}), effect("directional_friction", {0.2}),
                          effect("moving_contents", {0.3, 2.0, 0.05}), effect("slack_tether", {-0.2, 1.0, 0.5})}) {
    const Response stiff = respond(on_contact(mu, 1e-7, 20, {use}), {&push}),
                   rigid = respond(sliding(mu, {use}), {&push});
    EXPECT_EQ(stiff.outcome, Outcome::moved);
    EXPECT_NEAR(stiff.peak_slip_m, rigid.peak_slip_m, 2e-3 * rigid.peak_slip_m) << use.effect->name;
  }
}

// On a slope the contact carries a share of its strength, about which it rings. A swing uphill gives that share back and leaves
// no slip, the next one downhill creeps, for ever less but without end: a sample is not over before both leave none, or time
// is up. A floor that says itself that it is still, for 20 s, is waited for.
TEST(BoucWenEffects, ASwingUphillWithoutSlipIsNotTheLastOne) {
  const FloorMotion floors[] = {piecewise_linear("short", 0.2, {0, 1, -1, 0}, {}),
                                piecewise_linear("long", 0.2,
                                                 [] {
                                                   std::vector<double> a(104, 0.0);
                                                   a[1] = 1, a[2] = -1;
                                                   return a;
                                                 }(),
                                                 {})};
  for (const Solver& solver : both_solvers)
    for (const double exponent : {1.6, 3.0}) {
      const Specimen block = on_contact(0.2, 0.005, exponent, {effect("floor_tilt", {0.1})});
      const Response r = solver(block, {&floors[0]}, {.free_vibration_s = 30}),
                     waited_for = solver(block, {&floors[1]}, {.free_vibration_s = 10});
      EXPECT_NEAR(r.residual_slip_m, waited_for.residual_slip_m, 1e-4 * 0.005) << solver.name << " " << exponent;
      EXPECT_NEAR(r.peak_slip_m, waited_for.peak_slip_m, 1e-9) << solver.name << " " << exponent;
    }
}

TEST(BoucWenEffects, VanishAtTheirNeutralParameters) {
  int compared = 0;
  for (const auto& e : effects::all()) {
    if (!goes_with(e, "bouc_wen")) continue;
    EffectUse use{&e, {}};
    for (const auto& p : e.parameters)
      use.parameters.push_back(p.neutral && std::isfinite(*p.neutral) ? *p.neutral : p.high);
    if (std::none_of(e.parameters.begin(), e.parameters.end(),
                     [](const auto& p) { return p.neutral && std::isfinite(*p.neutral); }))
      continue;
    for (std::uint64_t number = 0; number < 4; ++number) {
      RandomCase c = random_bouc_wen_case({.seed = 7, .yield_low_m = 1e-3, .vertical = 0}, number);
      const Response plain = respond(c.specimen, c.shaking);
      c.specimen.effects = {use};
      const Response with = respond(c.specimen, c.shaking);
      ASSERT_NEAR(with.peak_slip_m, plain.peak_slip_m, 1e-7 * plain.peak_slip_m) << e.name << text(c.specimen.bouc_wen);
      ASSERT_NEAR(with.peak_acceleration_mps2, plain.peak_acceleration_mps2, 1e-6) << e.name;
      ASSERT_EQ(with.outcome, plain.outcome);
    }
    ++compared;
  }
  EXPECT_GE(compared, 9);
}

TEST(BoucWenEffects, BothIntegratorsAgreeWithEveryEffect) {
  int compared = 0, sensitive = 0, matters = 0;
  for (const auto& e : effects::all()) {
    if (!goes_with(e, "bouc_wen")) continue;
    for (std::uint64_t number = 0; number < 5; ++number) {
      KeyedRandom random(8, number);
      RandomCase c = random_bouc_wen_case({.seed = 9, .yield_low_m = 5e-4, .vertical = 0.5, .longest_s = 1.2}, number);
      EffectUse use{&e, {}};
      for (const auto& p : e.parameters) use.parameters.push_back(random.uniform(p.low, p.high));
      const Response plain = respond(c.specimen, c.shaking);
      c.specimen.effects = {use};
      const Settings settings{.tolerance = 1e-11, .free_vibration_s = 1};
      const Response fast = respond(c.specimen, c.shaking, settings),
                     slow = respond_reference(c.specimen, c.shaking, settings);
      const double size = c.specimen.bouc_wen.yield_displacement_m + slow.peak_slip_m;
      const double error = std::max(std::abs(fast.peak_slip_m - slow.peak_slip_m),
                                    std::abs(fast.residual_slip_m - slow.residual_slip_m)) /
                           size;
      ++compared;
      matters += std::abs(fast.peak_slip_m - plain.peak_slip_m) > 1e-3 * size ? 1 : 0;
      if (error < 1e-7 && fast.outcome == slow.outcome &&
          std::abs(fast.peak_acceleration_mps2 - slow.peak_acceleration_mps2) < 5e-3)
        continue;
      Shaking changed = c.shaking;
      changed.scale *= 1 + 1e-10;
      if (std::abs(respond(c.specimen, changed, settings).peak_slip_m - fast.peak_slip_m) > 1e-8 * size) {
        ++sensitive;
        continue;
      }
      ADD_FAILURE() << e.name << testing::PrintToString(use.parameters) << ' ' << number << ' '
                    << text(c.specimen.bouc_wen) << c.text() << "\n peak " << fast.peak_slip_m << ' '
                    << slow.peak_slip_m << " residual " << fast.residual_slip_m << ' ' << slow.residual_slip_m
                    << " acceleration " << fast.peak_acceleration_mps2 << ' ' << slow.peak_acceleration_mps2
                    << " events " << fast.events << ' ' << slow.events << " end " << fast.end_time_s << ' '
                    << slow.end_time_s;
    }
  }
  std::printf("%d compared, %d sensitive\n", compared, sensitive);
  EXPECT_GT(matters, compared / 2);
  EXPECT_LE(sensitive, compared / 10);
}

}  // namespace
}  // namespace freestand::test
