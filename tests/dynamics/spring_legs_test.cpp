// A block on legs that give way up and down: closed forms, limits, and a time-stepper that shares nothing with it
// (tests/support/spring_legs_stepper.hpp). More random motions with FREESTAND_LEG_CASES=400 in the environment.
#include "dynamics/spring_legs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/keyed_random.hpp"
#include "support/random_cases.hpp"
#include "support/spring_legs_stepper.hpp"

namespace freestand::test::spring_legs_test {
namespace {

constexpr double g = standard_gravity_mps2;

Specimen on_legs(double width_m, double height_m, double mu, double frequency_hz, double damping) {
  Specimen specimen{Block::rectangular(width_m, height_m, 100), {mu, mu}, {}};
  specimen.legs = {frequency_hz, damping};
  return specimen;
}

std::vector<HistoryPoint> history_of(const Specimen& specimen, const Shaking& shaking, double free_s, double step_s,
                                     Response* response = nullptr) {
  History history;
  history.step_s = step_s;
  Settings settings;
  settings.tolerance = 1e-12;
  settings.free_vibration_s = free_s;
  const Response r = respond(specimen, shaking, settings, &history);
  if (response) *response = r;
  return history.points;
}

// What an oscillator of rate W and damping ratio z has reached of its rest under a step of force.
double after_step(double W, double z, double t) {
  const double D = W * std::sqrt(1 - z * z);
  return 1 - std::exp(-z * W * t) * (std::cos(D * t) + z * W / D * std::sin(D * t));
}

// Its feet stuck, turning by less than lifts an edge: (k^2 + h^2) theta'' + 2 c b^2 theta' + (2 k b^2 - g h) theta = -h a, and the term
// |theta| b of the lever is a 1e-6 of h.
TEST(SpringLegs, SmallWobbleHasItsPeriodAndDecay) {
  const double b = 0.3, h = 0.9, f = 4, z = 0.05, a = 1e-5, W = 2 * pi * f;
  const Specimen specimen = on_legs(2 * b, 2 * h, 0.5, f, z);
  const double k2 = specimen.block.gyration2_m2, inertia = k2 + h * h, hold = W * W * b * b - g * h;
  const double rate = std::sqrt(hold / inertia), damping = z * W * b * b / (inertia * rate);
  const FloorMotion step = rectangular_pulse(a, 3);
  const auto points = history_of(specimen, {&step}, 0, 0.001);
  ASSERT_EQ(points.size(), 3000u);
  for (const std::size_t i : {40u, 333u, 1100u, 2999u}) {
    const double expected = -h * a / hold * after_step(rate, damping, 0.001 * static_cast<double>(i));
    EXPECT_NEAR(points[i].rotation_rad, expected, 1e-5 * h * a / hold) << i;
    EXPECT_EQ(points[i].mode, Mode::rest);
  }
}

// Slipping it turns about its centre of mass, of which friction changes nothing: k^2 theta'' + 2 c b^2 theta' + (2 k b^2 - g h) theta = mu g h.
TEST(SpringLegs, SlippingItWobblesAboutItsCentre) {
  const double b = 0.4, h = 0.7, f = 40, z = 0.02, mu = 0.02, W = 2 * pi * f;
  const Specimen specimen = on_legs(2 * b, 2 * h, mu, f, z);
  const double k2 = specimen.block.gyration2_m2, hold = W * W * b * b - g * h, rest = mu * g * h / hold;
  const double rate = std::sqrt(hold / k2), damping = z * W * b * b / (k2 * rate);
  const FloorMotion push = rectangular_pulse(-5, 0.2);  // the block, left behind, slips to the right
  const auto points = history_of(specimen, {&push}, 0, 0.001);
  for (const std::size_t i : {3u, 20u, 77u, 199u}) {
    const double expected = rest * after_step(rate, damping, 0.001 * static_cast<double>(i));
    EXPECT_NEAR(points.at(i).rotation_rad, expected, 2e-3 * rest)
        << i;  // rotations of 1e-5 times h/b, and the weight's swing
    EXPECT_EQ(points.at(i).mode, Mode::slide);
  }
}

// Up and down: y'' + 2 z W y' + W^2 y = -v, and what it stands on carries g + v + y''.
TEST(SpringLegs, GoesUpAndDownAsAnOscillator) {
  const double f = 3, z = 0.1, v = 2, W = 2 * pi * f, D = W * std::sqrt(1 - z * z),
               overshoot = std::exp(-pi * z * W / D);
  const FloorMotion step = staircase({2}, {0}, {v});
  Settings settings;
  settings.contact_forces = true;
  settings.tolerance = 1e-12;
  const Response r = respond(on_legs(0.6, 1.8, 0.5, f, z), {&step, 1, 1, 1}, settings);
  // W^2 times the displacement and the dashpot's force, whose sum has its largest value where 2 z W y'' + W^2 y' = 0, a little before the
  // turning point.
  double most = 0;
  for (double t = 0; t < 0.4; t += 1e-6) {
    const double e = std::exp(-z * W * t);
    most = std::max(most, v * (1 - e * (std::cos(D * t) - z * W / D * std::sin(D * t))));
  }
  EXPECT_GT(most, v * (1 + overshoot));
  EXPECT_NEAR(r.peak_contact_vertical_mps2, g + most, 1e-8);
  EXPECT_EQ(r.peak_rotation_rad, 0);
  EXPECT_EQ(r.outcome, Outcome::at_rest);
}

// Under a constant acceleration below lift-off it comes to rest tilted by theta, S = sin, C = cos of it:
// 2 k b^2 S C - g h S = h C |a| + b |S| |a|, from moments about the lower edge's foot.
TEST(SpringLegs, LeansAgainstAConstantAcceleration) {
  const double b = 0.3, h = 0.9, f = 3, z = 0.5, W = 2 * pi * f, k = 0.5 * W * W;
  for (const double a : {1.2, -1.2}) {
    const FloorMotion push = rectangular_pulse(a, 30);
    const auto points = history_of(on_legs(2 * b, 2 * h, 0.9, f, z), {&push}, 0, 0.5);
    double low = 0, high = 0.2;
    for (int half = 0; half < 100; ++half) {
      const double theta = 0.5 * (low + high), S = std::sin(theta), C = std::cos(theta);
      (2 * k * b * b * S * C - g * h * S < (h * C + b * S) * std::abs(a) ? low : high) = theta;
    }
    ASSERT_LT(k * b * std::sin(low), 0.5 * g);  // both legs carry
    EXPECT_GT(low, 0.02);
    EXPECT_NEAR(points.back().rotation_rad, a > 0 ? -low : low, 1e-10);
    EXPECT_EQ(points.back().mode, Mode::rest);
  }
}

// A block that begins to slip at once turns by twice what friction holds it at, and lifts an edge where mu > b/(2 h) (1 - g h/(2 k b^2)): at
// half the friction that tips a rigid block.
TEST(SpringLegs, FrictionThatSetsInAtOnceLiftsAnEdgeAtHalfOfWhatTipsARigidBlock) {
  const double b = 0.3, h = 0.9, f = 60, W = 2 * pi * f, k = 0.5 * W * W;
  const double threshold = b / (2 * h) * (1 - g * h / (2 * k * b * b));
  const FloorMotion push = rectangular_pulse(-20, 0.1);
  for (const double part : {0.99, 1.01}) {
    History history;
    history.step_s = 0;
    Specimen specimen = on_legs(2 * b, 2 * h, part * threshold, f, 0);
    const Response r = respond(specimen, {&push}, {.free_vibration_s = 0}, &history);
    const bool lifted = std::any_of(history.events.begin(), history.events.end(),
                                    [](const Event& event) { return event.to == Mode::slide_rock; });
    EXPECT_EQ(lifted, part > 1) << part;
    EXPECT_GT(r.peak_slip_m, 0.05);
    specimen.legs.reset();
    EXPECT_EQ(respond(specimen, {&push}).peak_rotation_rad, 0);
  }
}

// Legs that are stiffer and stiffer: up to its first blow the block rocks as on rigid edges, and it slides as on a rigid base. An edge sinks by
// 1/W^2, and what comes on at once lets it swing at speeds of 1/W, which a slip that turns round at that moment keeps: eight times as stiff, at
// most an eighth of the difference is left.
TEST(SpringLegs, StiffLegsAreRigidEdges) {
  const FloorMotion sine = one_sine();
  const Shaking shaking{&sine, 6, 0.8};
  Specimen rigid{Block::rectangular(0.5, 1.5, 100), {2, 2}, {}};
  const auto plain = history_of(rigid, shaking, 0, 0.01);
  const auto blow = static_cast<std::size_t>(
      std::find_if(plain.begin(), plain.end(), [](const HistoryPoint& p) { return p.rotation_rad > 0.001; }) -
      plain.begin());
  const auto off = [&](double f) {
    const auto points = history_of(on_legs(0.5, 1.5, 2, f, 0.3), shaking, 0, 0.01);
    double most = 0;
    for (std::size_t i = 0; i + 2 < std::min(blow, points.size()); ++i)
      most = std::max(most, std::abs(points[i].rotation_rad - plain[i].rotation_rad));
    return most;
  };
  ASSERT_GT(blow, 10u);
  EXPECT_LT(off(800), off(100) / 8);
  for (const double mu : {0.05, 0.1}) {
    rigid.friction = {mu, mu};
    const double slid = respond(rigid, shaking).residual_slip_m;
    const auto slid_off = [&](double f) {
      return std::abs(respond(on_legs(0.5, 1.5, mu, f, 0.3), shaking).residual_slip_m - slid);
    };
    EXPECT_GT(std::abs(slid), 0.2);
    EXPECT_LT(slid_off(800), slid_off(100) / 8) << mu;
  }
}

// The history of a block that falls ends where it fell: its slip stays what it was, though the fall is no part of the peak and of what is left.
TEST(SpringLegs, AHistoryEndsWhereTheBlockFell) {
  std::vector<double> a(61, 0.0);
  std::fill(a.begin(), a.begin() + 8, 6.0);
  const FloorMotion push = piecewise_linear("push", 0.1, a, {});
  Response r;
  const auto points = history_of(on_legs(0.5, 1.5, 0.45, 6, 0.1), {&push}, 10, 0.01, &r);
  ASSERT_EQ(r.outcome, Outcome::overturned);
  const auto fallen = static_cast<std::size_t>(
      std::find_if(points.begin(), points.end(), [](const HistoryPoint& p) { return p.mode == Mode::overturned; }) -
      points.begin());
  ASSERT_LT(fallen, points.size());
  ASSERT_GT(fallen, 2u);
  const double before = points[fallen - 1].slip_m - points[fallen - 2].slip_m,
               at = points[fallen].slip_m - points[fallen - 1].slip_m;
  EXPECT_LT(std::abs(at), 0.001 + 2 * std::abs(before));
  EXPECT_GT(std::abs(points[fallen].slip_m - r.residual_slip_m), 0.01);
}

TEST(SpringLegs, MirrorToTheBit) {
  CaseFamily family;
  family.seed = 18;
  family.one_model = family.asymmetric = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    RandomCase c = random_case(family, i);
    c.specimen.legs = {3 + static_cast<double>(i), 0.05};
    Shaking mirrored = c.shaking;
    mirrored.scale = -mirrored.scale;
    const Response a = respond(c.specimen, c.shaking), b = respond(c.specimen, mirrored);
    EXPECT_EQ(a.outcome, b.outcome);
    EXPECT_EQ(a.peak_slip_m, b.peak_slip_m);
    EXPECT_EQ(a.residual_slip_m, -b.residual_slip_m);
    EXPECT_EQ(a.peak_rotation_rad, b.peak_rotation_rad);
    EXPECT_EQ(a.peak_acceleration_mps2, b.peak_acceleration_mps2);
    Response together;
    respond_batch({&c.specimen, 1}, {&c.shaking, 1}, {}, {&together, 1});
    EXPECT_EQ(together.peak_rotation_rad, a.peak_rotation_rad);
  }
}

TEST(SpringLegs, WhatDoesNotGoWithThemIsRefused) {
  const FloorMotion sine = one_sine();
  const Shaking shaking{&sine, 5, 0.5};
  const Specimen good = on_legs(0.5, 1.5, 0.3, 4, 0.05);
  EXPECT_EQ(respond(good, shaking).outcome, Outcome::moved);
  std::vector<Specimen> wrong(6, good);
  wrong[0].model = Model::slide;
  wrong[1].model = Model::rock;
  wrong[2].legs->frequency_hz = 0;
  wrong[3].legs->damping = -0.1;
  wrong[4].start.slip_m = 0.1;
  wrong[5].model = Model::bouc_wen;
  for (const Specimen& specimen : wrong) EXPECT_EQ(respond(specimen, shaking).outcome, Outcome::not_finite);
  EXPECT_EQ(respond_reference(good, shaking).outcome, Outcome::not_finite);
}

struct LegCase {
  RandomCase random;
  BlockOnLegs block;
};

LegCase leg_case(std::uint64_t number) {
  CaseFamily family;
  family.seed = 1801;
  family.one_model = 0;
  family.alpha_high = 0.8;
  family.duration_low_s = 1.5;
  family.duration_high_s = 3;
  family.excess_high = 3;
  LegCase c{random_case(family, number), {}};
  KeyedRandom random(1802, number);
  Specimen& s = c.random.specimen;
  // Stiff enough to stand: 2 k b^2 > g h.
  const double b = std::min(s.block.left_m, s.block.right_m), stands = std::sqrt(g * s.block.height_m) / (2 * pi * b);
  s.legs = {stands * random.log_uniform(1.3, 12), random.chance(0.1) ? 0 : random.log_uniform(0.01, 0.6)};
  c.block = {s.block.left_m,       s.block.right_m, s.block.height_m,
             s.block.gyration2_m2, s.friction.mu_s, s.friction.mu_k,
             s.legs->frequency_hz, s.legs->damping, g};
  return c;
}

// By how much two histories differ, up to each point.
std::vector<double> apart(const std::vector<OnLegsAt>& a, const std::vector<OnLegsAt>& b) {
  std::vector<double> most;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most.push_back(std::max({i == 0 ? 0.0 : most.back(), std::abs(a[i].slip_m - b[i].slip_m),
                             std::abs(a[i].rotation_rad - b[i].rotation_rad)}));
  return most;
}

// The stepper's error falls with its step, so that a finer one leaves at most what it changed; six for what a change can hide. Steps that are
// no halves of each other do not err alike by chance. A disagreement is looked at in steps 8 and 64 times as fine. Where its own change has passed 0.1 mm errors have fanned out.
TEST(SpringLegs, AgreeWithTheTimeStepper) {
  const char* wanted = std::getenv("FREESTAND_LEG_CASES");
  const std::uint64_t count = wanted ? std::strtoull(wanted, nullptr, 10) : 40;
  constexpr double every_s = 0.005;
  unsigned seen = 0;
  std::size_t compared = 0, all = 0;
  for (std::uint64_t number = 0; number < count; ++number) {
    const LegCase c = leg_case(number);
    const Shaking& shaking = c.random.shaking;
    History history;
    history.step_s = every_s;
    Settings settings;
    settings.tolerance = 1e-12;
    settings.free_vibration_s = 1;
    const Response r = respond(c.random.specimen, shaking, settings, &history);
    ASSERT_TRUE(r.outcome == Outcome::moved || r.outcome == Outcome::at_rest || r.outcome == Outcome::overturned)
        << number << ' ' << name(r.outcome) << ' ' << c.random.text();
    const auto floor = [&](double t) {
      return FloorPush{horizontal_acceleration(shaking, t), vertical_acceleration(shaking, t)};
    };
    std::string what;
    for (const int steps : {200, 1600, 12800}) {
      const auto points = static_cast<int>(history.points.size());
      const auto coarse = step_on_legs(c.block, floor, every_s / steps, steps, points);
      const auto fine = step_on_legs(c.block, floor, 0.5 * every_s / steps, 2 * steps, points);
      const auto other = step_on_legs(c.block, floor, every_s / (1.4 * steps), 7 * steps / 5, points);
      std::vector<double> own = apart(coarse, fine);
      const std::vector<double> too = apart(other, fine);
      own.resize(std::min(own.size(), too.size()));
      for (std::size_t k = 0; k < own.size(); ++k) own[k] = std::max(own[k], too[k]);
      what.clear();
      std::size_t i = 0;
      for (; i < own.size() && own[i] < 1e-4 && what.empty(); ++i) {
        const HistoryPoint& p = history.points[i];
        const double off =
            std::max(std::abs(p.slip_m - fine[i].slip_m), std::abs(p.rotation_rad - fine[i].rotation_rad));
        if (off > 1e-6 + 6 * own[i])
          what = "at " + std::to_string(p.time_s) + " s: slip " + std::to_string(p.slip_m) + " against " +
                 std::to_string(fine[i].slip_m) + ", rotation " + std::to_string(p.rotation_rad) + " against " +
                 std::to_string(fine[i].rotation_rad) + ", own " + std::to_string(own[i]);
        seen |= 1U << static_cast<int>(p.mode);
      }
      if (!what.empty()) continue;
      compared += i;
      break;
    }
    all += history.points.size();
    EXPECT_EQ(what, "") << number << ' ' << c.random.text() << " legs " << c.block.frequency_hz << ' '
                        << c.block.damping;
  }
  EXPECT_GT(compared, all / 2);
  for (const Mode mode : {Mode::rest, Mode::slide, Mode::rock, Mode::slide_rock, Mode::flight})
    EXPECT_TRUE(seen >> static_cast<int>(mode) & 1U) << name(mode);
}

}  // namespace
}  // namespace freestand::test::spring_legs_test
