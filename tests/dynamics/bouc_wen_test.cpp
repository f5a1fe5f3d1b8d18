// Model bouc_wen against closed forms, against quadratures of its law, and against the SUNDIALS reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "base/units.hpp"
#include "dynamics/bouc_wen_ring.hpp"
#include "support/bouc_wen_cases.hpp"
#include "support/floor_motions.hpp"
#include "support/solvers.hpp"

namespace freestand::test::bouc_wen_test {
namespace {

constexpr double g = standard_gravity_mps2, inch = 0.0254;
FREESTAND_ON_BOTH_SOLVERS(BoucWen);

Specimen on_contact(double mu, double yield_displacement_m, double exponent) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 1.8, 100);
  specimen.friction = {mu, mu};
  specimen.model = Model::bouc_wen;
  specimen.bouc_wen = {yield_displacement_m, exponent, 0.5, 0.5};
  return specimen;
}

// int_0^z f dz by Simpson's rule after z = z_1 - z_1 (1 - s)^4, which crowds its points where 1/(1 - z^n) is steep.
template <class Function>
double integral(double z1, Function&& f) {
  constexpr int half_steps = 4000;
  double sum = 0;
  for (int i = 0; i <= half_steps; ++i) {
    const double s = static_cast<double>(i) / half_steps, r = 1 - s;
    const double weight = i == 0 || i == half_steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * f(z1 * (1 - r * r * r * r)) * 4 * z1 * r * r * r;
  }
  return sum / (3 * half_steps);
}

// Under a push far below the yield the contact is a spring: u = -(a/w^2)(1 - cos wt), w^2 = mu g/u_y.
TEST_P(BoucWen, BelowTheYieldItRingsAtTheElasticFrequency) {
  const double mu = 0.3, yield = 0.1 * inch, w = std::sqrt(mu * g / yield), a = 0.1 * mu * g;
  const FloorMotion push = rectangular_pulse(a, 4.0);
  History history;
  const Response r = GetParam()(on_contact(mu, yield, 20), {&push}, {.tolerance = 1e-12}, &history);
  EXPECT_EQ(r.outcome, Outcome::at_rest);
  EXPECT_EQ(r.events, 0);
  ASSERT_GT(history.points.size(), 790U);
  for (const HistoryPoint& p : history.points) {
    if (p.time_s >= 4) break;
    ASSERT_NEAR(p.slip_m, -a / (w * w) * (1 - std::cos(w * p.time_s)), 1e-9 * yield) << p.time_s;
    ASSERT_NEAR(p.slip_velocity_mps, -a / w * std::sin(w * p.time_s), 1e-9 * yield * w);
  }
  EXPECT_NEAR(r.peak_slip_m, 2 * a / (w * w), 1e-9 * yield);
  EXPECT_NEAR(r.peak_acceleration_mps2, 2 * a, 1e-9 * a);
  EXPECT_NEAR(r.residual_slip_m, 0, 1e-9 * yield);
  EXPECT_NEAR(r.slid_path_m, 0, 1e-9 * yield);
}

// A steady push through the yield. The contact has u = u_y int_0^z dz/(1 - z^n) and takes the energy
// mu g u_y int_0^z z dz/(1 - z^n); the push a does the work a u.
TEST_P(BoucWen, TheFirstLoadingFollowsTheClosedCurveAndItsEnergy) {
  for (const double n : {1.0, 2.0, 5.5, 20.0, 50.0}) {
    int compared = 0;
    const double mu = 0.3, yield = 0.02 * inch, a = 1.4 * mu * g;
    const FloorMotion push = rectangular_pulse(-a, 0.02);
    History history;
    history.step_s = 1e-3;
    GetParam()(on_contact(mu, yield, n), {&push}, {.tolerance = 1e-12}, &history);
    for (std::size_t i = 1; i <= 12; ++i) {
      const HistoryPoint& p = history.points.at(i);
      const auto reach = [&](double z) {
        return yield * integral(z, [&](double x) { return 1 / (1 - std::pow(x, n)); });
      };
      double low = 0, high = 1 - 1e-6;
      if (reach(high) < p.slip_m) continue;
      for (int k = 0; k < 60; ++k) (reach(0.5 * (low + high)) < p.slip_m ? low : high) = 0.5 * (low + high);
      const double stored = mu * g * yield * integral(low, [&](double x) { return x / (1 - std::pow(x, n)); });
      const double kinetic = 0.5 * p.slip_velocity_mps * p.slip_velocity_mps;
      ASSERT_NEAR(kinetic + stored, a * p.slip_m, 2e-9 * a * p.slip_m + 1e-13) << n << ' ' << p.time_s;
      ++compared;
    }
    EXPECT_GE(compared, 5) << n;
  }
}

// As u_y goes to zero the contact becomes Coulomb's. In one slip the elastic part lets the block gain a speed of the
// order of sqrt(mu g u_y) before the full friction acts: the error falls with the root of u_y.
TEST(BoucWenLimit, CoulombsSlidingIsReachedWithTheRootOfTheYieldDisplacement) {
  const double mu = 0.2;
  const FloorMotion push = rectangular_pulse(0.5 * g, 0.5);
  Specimen rigid = on_contact(mu, 1, 1);
  rigid.model = Model::slide;
  const Response exact = respond(rigid, {&push});
  std::vector<double> errors;
  for (double yield = 1e-3; yield > 2e-7; yield /= 4) {
    const Response r = respond(on_contact(mu, yield, 20), {&push});
    EXPECT_EQ(r.outcome, Outcome::moved);
    errors.push_back(std::abs(r.peak_slip_m - exact.peak_slip_m));
    EXPECT_NEAR(r.residual_slip_m, exact.residual_slip_m, 3 * std::sqrt(yield * mu * g) + 3 * yield);
    EXPECT_NEAR(r.peak_acceleration_mps2, mu * g, 1e-8);
    EXPECT_EQ(r.events, 2);
  }
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_NEAR(errors[i - 1] / errors[i], 2, 0.25) << i;
}

TEST_P(BoucWen, MirroredMotionGivesTheMirroredAnswerToTheBit) {
  for (std::uint64_t number = 0; number < 20; ++number) {
    const RandomCase c = random_bouc_wen_case({.seed = 3, .yield_low_m = 1e-4}, number);
    Shaking negative = c.shaking;
    negative.scale = -negative.scale;
    History a, b;
    const Response ra = GetParam()(c.specimen, c.shaking, {}, &a), rb = GetParam()(c.specimen, negative, {}, &b);
    ASSERT_EQ(ra.outcome, rb.outcome);
    ASSERT_EQ(ra.peak_slip_m, rb.peak_slip_m);
    ASSERT_EQ(ra.residual_slip_m, -rb.residual_slip_m);
    ASSERT_EQ(ra.slid_path_m, rb.slid_path_m);
    ASSERT_EQ(ra.peak_acceleration_mps2, rb.peak_acceleration_mps2);
    ASSERT_EQ(ra.events, rb.events);
    ASSERT_EQ(ra.end_time_s, rb.end_time_s);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) ASSERT_EQ(a.points[i].slip_m, -b.points[i].slip_m);
  }
}

// A history changes nothing, and halving the segments of the motion nothing but round-off.
TEST(BoucWenSteps, HistoriesAndKnotsChangeNothing) {
  for (std::uint64_t number = 0; number < 30; ++number) {
    const RandomCase c = random_bouc_wen_case({.seed = 4, .yield_low_m = 1e-4}, number);
    History history;
    const Response told = respond(c.specimen, c.shaking, {}, &history), silent = respond(c.specimen, c.shaking);
    ASSERT_EQ(told.peak_slip_m, silent.peak_slip_m);
    ASSERT_EQ(told.residual_slip_m, silent.residual_slip_m);
    ASSERT_EQ(told.events, silent.events);
    ASSERT_EQ(static_cast<std::size_t>(told.events), history.events.size());
    const FloorMotion halved = with_halved_segments(*c.motion);
    Shaking shaking = c.shaking;
    shaking.motion = &halved;
    const Response again = respond(c.specimen, shaking, {.tolerance = 1e-12}),
                   once = respond(c.specimen, c.shaking, {.tolerance = 1e-12});
    ASSERT_NEAR(again.peak_slip_m, once.peak_slip_m,
                1e-9 * (once.peak_slip_m + c.specimen.bouc_wen.yield_displacement_m))
        << text(c.specimen.bouc_wen) << c.text();
  }
}

TEST(BoucWenSteps, ErrorsFallWithTheTolerance) {
  constexpr std::uint64_t samples = 60;
  const auto run = [](double tolerance) {
    std::vector<Response> out;
    for (std::uint64_t i = 0; i < samples; ++i) {
      const RandomCase c = random_bouc_wen_case({.seed = 5, .yield_low_m = 1e-4}, i);
      out.push_back(respond(c.specimen, c.shaking, {.tolerance = tolerance}));
    }
    return out;
  };
  const std::vector<Response> exact = run(1e-14);
  double before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const std::vector<Response> found = run(tolerance);
    std::vector<double> errors;
    for (std::size_t i = 0; i < samples; ++i)
      errors.push_back(std::max(std::abs(found[i].peak_slip_m - exact[i].peak_slip_m),
                                std::abs(found[i].residual_slip_m - exact[i].residual_slip_m)) /
                       exact[i].peak_slip_m);
    std::sort(errors.begin(), errors.end());
    std::printf("tolerance %.0e: error median %.1e, 90 %% %.1e, worst %.1e\n", tolerance, errors[samples / 2],
                errors[samples * 9 / 10], errors.back());
    EXPECT_LT(errors[samples / 2], 3 * tolerance);
    EXPECT_LT(errors[samples * 9 / 10], 300 * tolerance);
    EXPECT_LT(errors.back(), 3000 * tolerance);
    EXPECT_LT(errors[samples * 9 / 10], 0.1 * before);
    before = errors[samples * 9 / 10];
  }
}

// Swings followed in time come to what the closed form says of them: 20 s of a still floor, or none, after a pulse.
TEST_P(BoucWen, TheRingingInClosedFormIsThatOfTheSteps) {
  for (const double n : {1.0, 2.0, 3.5, 20.0}) {
    for (const auto& [gamma, beta] : {std::pair{0.5, 0.5}, std::pair{0.8, 0.1}}) {
      Specimen specimen = on_contact(0.2, 0.2 * inch, n);
      specimen.bouc_wen.gamma = gamma;
      specimen.bouc_wen.beta = beta;
      const FloorMotion pulse = staircase({0.1, 0.1}, {4, -4}), still = staircase({0.1, 0.1, 20}, {4, -4, 0});
      const Settings settings{.tolerance = 1e-11};
      const Response closed = GetParam()(specimen, {&pulse}, settings),
                     steps = GetParam()(specimen, {&still}, settings);
      EXPECT_NEAR(closed.residual_slip_m, steps.residual_slip_m, 1e-12) << n;
      EXPECT_NEAR(closed.peak_slip_m, steps.peak_slip_m, 1e-12) << n;
    }
  }
}

// A swing by quadrature: the energy that the contact gives back from |zeta| = m takes it to m' on the other side.
TEST(BoucWenRing, ASwingKeepsItsEnergy) {
  for (const double n : {1.0, 2.0, 7.0, 50.0}) {
    for (const double kappa : {0.0, -0.7}) {
      const dynamics::BoucWenContact contact{1, 0.2, n, kappa, 1e-3, 1e-10, 0.9};
      for (const double turn : {0.05, 0.4, 0.7}) {
        const dynamics::Swing swing = dynamics::next_swing(contact, turn);
        const auto given = [&](double x) { return x / (1 - kappa * std::pow(x, n)); };
        const auto taken = [&](double x) { return x / (1 - std::pow(x, n)); };
        EXPECT_NEAR(integral(turn, given), integral(swing.turn, taken), 1e-12);
        const double back = integral(turn, [&](double x) { return 1 / (1 - kappa * std::pow(x, n)) - 1; });
        const double on = integral(swing.turn, [&](double x) { return 1 / (1 - std::pow(x, n)) - 1; });
        EXPECT_NEAR(swing.slip, back + on, 1e-12);
      }
    }
  }
}

// All swings at once against one after the other, until nothing is left to sum.
TEST(BoucWenRing, TheSumOfAllSwingsDoesNotDependOnWhereItStarts) {
  for (const double n : {1.0, 1.5, 3.0, 20.0}) {
    for (const double kappa : {0.0, -0.5, -3.0}) {
      const dynamics::BoucWenContact contact{1, 0.2, n, kappa, 1e-3, 1e-10, 0.9};
      double turn = std::pow(0.74 / std::max(1.0, -kappa), 1 / n), slip = 0, sign = 1;
      const dynamics::RingOut whole = dynamics::ring_out(contact, turn);
      for (int i = 0; i < 500; ++i, sign = -sign) {
        const dynamics::Swing swing = dynamics::next_swing(contact, turn);
        slip += sign * swing.slip;
        turn = swing.turn;
      }
      const dynamics::RingOut rest = dynamics::ring_out(contact, turn);
      EXPECT_NEAR(whole.slip_m, slip + sign * rest.slip_m, 1e-11) << n << ' ' << kappa;
    }
  }
}

struct Differences {
  int samples = 0, moved = 0, outcome = 0, demand = 0, sensitive = 0;
  double worst = 0;
};

double difference(const Response& a, const Response& b, double yield) {
  const double size = yield + b.peak_slip_m;
  return std::max({std::abs(a.peak_slip_m - b.peak_slip_m), std::abs(a.residual_slip_m - b.residual_slip_m),
                   std::abs(a.slid_path_m - b.slid_path_m)}) /
         size;
}

Differences against_reference(const BoucWenFamily& family, std::uint64_t samples) {
  Differences d;
  const Settings settings{.tolerance = 1e-11};
  for (std::uint64_t number = 0; number < samples; ++number) {
    const RandomCase c = random_bouc_wen_case(family, number);
    const double yield = c.specimen.bouc_wen.yield_displacement_m;
    const Response fast = respond(c.specimen, c.shaking, settings),
                   slow = respond_reference(c.specimen, c.shaking, settings);
    ++d.samples;
    d.moved += slow.outcome == Outcome::moved ? 1 : 0;
    const double demand = difference(fast, slow, yield);
    const double acceleration = std::abs(fast.peak_acceleration_mps2 - slow.peak_acceleration_mps2);
    const bool same = fast.outcome == slow.outcome && fast.events == slow.events;
    if (same && demand < 1e-7 && acceleration < (c.shaking.vertical_scale != 0 ? 2e-3 : 1e-7)) {
      d.worst = std::max(d.worst, demand);
      continue;
    }
    Shaking changed = c.shaking;
    changed.scale *= 1 + 1e-10;
    const Response other = respond(c.specimen, changed, settings);
    if (difference(fast, other, yield) > 1e-8 || other.events != fast.events) {
      ++d.sensitive;
      continue;
    }
    ++(same ? d.demand : d.outcome);
    std::printf("  differs: sample %llu, %s%s; peak %.9e %.9e, events %d %d, acceleration %.9f %.9f\n",
                static_cast<unsigned long long>(number), text(c.specimen.bouc_wen).c_str(), c.text().c_str(),
                fast.peak_slip_m, slow.peak_slip_m, fast.events, slow.events, fast.peak_acceleration_mps2,
                slow.peak_acceleration_mps2);
  }
  std::printf(
      "%d samples, %d moved; differ in outcome or events %d, in demand %d, and %d sensitive ones; the others "
      "agree within %.1e of the slip\n",
      d.samples, d.moved, d.outcome, d.demand, d.sensitive, d.worst);
  return d;
}

void expect_agreement(const Differences& d) {
  EXPECT_EQ(d.outcome + d.demand, 0);
  EXPECT_LE(d.sensitive, 0.02 * d.samples);
  EXPECT_GT(d.moved, 0.6 * d.samples);
}

TEST(BoucWenAgainstReference, AllContacts) { expect_agreement(against_reference({.seed = 1}, 60)); }

// Down to where the floor falls away under the block.
TEST(BoucWenAgainstReference, StrongVerticalShaking) {
  expect_agreement(
      against_reference({.seed = 2, .yield_low_m = 1e-4, .vertical = 1, .vertical_peak_g = 1.8, .longest_s = 1.5}, 15));
}

TEST(BoucWenAgainstReference, Pulses) {
  const FloorMotion sine = one_sine();
  for (const double yield : {1e-5 * inch, 1e-3 * inch, 0.1 * inch, 1 * inch}) {
    for (const double n : {1.0, 2.0, 20.0, 50.0}) {
      const Shaking shaking{&sine, 5.0, yield < 1e-5 ? 0.2 : 0.8};
      const Specimen specimen = on_contact(0.2, yield, n);
      const Settings settings{.tolerance = 1e-11};
      const Response fast = respond(specimen, shaking, settings), slow = respond_reference(specimen, shaking, settings);
      EXPECT_EQ(fast.outcome, Outcome::moved);
      EXPECT_EQ(fast.events, slow.events) << yield << ' ' << n;
      EXPECT_LT(difference(fast, slow, yield), 1e-8) << yield << ' ' << n;
    }
  }
}

// A floor that falls away faster than g lets go of a block that stands still: it is weightless then, and feels g and no more.
TEST_P(BoucWen, AFloorThatFallsAwayPullsAtNothing) {
  const FloorMotion drop = piecewise_linear("drop", 0.2, {0, 0, 0, 0}, {0, -1.5 * g, 0, 0});
  const Response r = GetParam()(on_contact(0.3, 0.1 * inch, 20), {&drop, 1, 1, 1}, {}, nullptr);
  EXPECT_EQ(r.outcome, Outcome::at_rest);
  EXPECT_NEAR(r.peak_acceleration_mps2, g, 1e-9);
}

TEST_P(BoucWen, BadInputIsAnOutcome) {
  const FloorMotion push = rectangular_pulse(4, 0.2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Specimen sound = on_contact(0.2, 1e-3, 2);
  for (const auto& law : {freestand::BoucWen{0, 2, 0.5, 0.5}, freestand::BoucWen{1e-3, 0.5, 0.5, 0.5},
                          freestand::BoucWen{1e-3, 2, 0.5, 0.6}, freestand::BoucWen{1e-3, 2, 0.5, -0.5},
                          freestand::BoucWen{nan, 2, 0.5, 0.5}, freestand::BoucWen{1e-3, nan, 0.5, 0.5}}) {
    Specimen specimen = sound;
    specimen.bouc_wen = law;
    EXPECT_EQ(GetParam()(specimen, {&push}).outcome, Outcome::not_finite) << text(law);
  }
  EXPECT_EQ(GetParam()(sound, {&push, nan}).outcome, Outcome::not_finite);
  EXPECT_EQ(GetParam()(sound, {&push}, {.event_limit = 1}).outcome, Outcome::step_limit);
}

TEST_P(BoucWen, NoFrictionNoShakingAndAFlatPush) {
  const FloorMotion push = rectangular_pulse(4, 0.2), none = rectangular_pulse(0, 0.2);
  const Response still = GetParam()(on_contact(0.2, 1e-3, 2), {&none});
  EXPECT_EQ(still.outcome, Outcome::at_rest);
  EXPECT_EQ(still.peak_slip_m, 0);
  EXPECT_EQ(still.peak_acceleration_mps2, 0);
  const Response free = GetParam()(on_contact(0, 1e-3, 2), {&push}, {.free_vibration_s = 1});
  EXPECT_NEAR(free.peak_slip_m, 0.5 * 4 * 0.04 + 4 * 0.2 * 1, 1e-6);  // glides on until its time is over
}

}  // namespace
}  // namespace freestand::test::bouc_wen_test
