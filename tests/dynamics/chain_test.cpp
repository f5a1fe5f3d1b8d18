// The chain to the wall [KM05 ch. 9], against closed forms of a mass that runs into a spring, and the report's trend.
#include "dynamics/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/keyed_random.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand {
namespace {

using test::rectangular_pulse;

constexpr test::Solver both[] = {test::fast_solver, test::reference_solver};

constexpr double mass = 200, stiffness = 4e5, slack = 0.02;

Specimen chained(double mu, double strength_n, Model model = Model::slide) {
  Specimen specimen{Block::rectangular(0.72, 1.81, mass), {mu, mu}, {}, model};
  specimen.effects.push_back(dynamics::use(
      {.slack_m = slack, .stiffness_npm = stiffness, .strength_n = strength_n, .height_m = 1.81, .side = 1},
      specimen.block));
  return specimen;
}

// On ice: the floor jerks to the left for 0.1 s and the block, left behind, runs to the right at v = a t1. Its slack is
// taken up after the push; then x = (v/W) sin(W t), W^2 = k/m, and it comes back with the same speed.
TEST(Chain, StopsABlockOnIceAsASpringDoes) {
  const double a = 1.5, t1 = 0.1, v = a * t1, W = std::sqrt(stiffness / mass);
  ASSERT_LT(0.5 * a * t1 * t1, slack);
  const FloorMotion motion = rectangular_pulse(-a, t1);
  for (const auto& [name, solve] : both) {
    Settings settings;
    settings.free_vibration_s = 0.25;
    settings.tolerance = 1e-12;
    History history;
    history.step_s = 0.001;
    const Response r = solve(chained(0, 1e9), {&motion}, settings, &history);
    EXPECT_NEAR(r.peak_slip_m, slack + v / W, 1e-9) << name;
    // The reference looks at the acceleration at the ends of its steps only.
    EXPECT_NEAR(r.peak_acceleration_mps2, v * W, name == std::string("fast") ? 1e-8 : 1e-3) << name;
    EXPECT_FALSE(r.connection_failed);
    EXPECT_NEAR(history.points.at(330).slip_velocity_mps, -v, 1e-9) << name;
  }
}

// The connection gives way when k x exceeds its strength: what speed is left follows from the energy.
TEST(Chain, FailsWhereItsStrengthIsReachedAndHoldsNoMore) {
  const double a = 1.5, t1 = 0.1, v = a * t1, W = std::sqrt(stiffness / mass);
  const FloorMotion motion = rectangular_pulse(-a, t1);
  const double strength = 0.6 * mass * v * W, x = strength / stiffness;
  const double left = std::sqrt(v * v - W * W * x * x);
  for (const auto& [name, solve] : both) {
    Settings settings;
    settings.free_vibration_s = 0.25;
    settings.tolerance = 1e-12;
    History history;
    history.step_s = 0.001;
    const Response r = solve(chained(0, strength), {&motion}, settings, &history);
    EXPECT_TRUE(r.connection_failed) << name;
    EXPECT_NEAR(history.points.at(330).slip_velocity_mps, left, 1e-9) << name;
    EXPECT_NEAR(r.peak_acceleration_mps2, strength / mass, name == std::string("fast") ? 1e-8 : 1e-2) << name;
  }
}

TEST(Chain, LetsTheBlockMoveTowardsTheWall) {
  const FloorMotion motion = rectangular_pulse(4, 0.3);
  for (const auto& [name, solve] : both) {
    const Response r = solve(chained(0.2, 1e9), {&motion}, {}, nullptr);
    EXPECT_LT(r.residual_slip_m, 0) << name;
    EXPECT_NEAR(r.peak_acceleration_mps2, 0.2 * standard_gravity_mps2, 1e-12) << name;
  }
}

// A pull at the top turns the block: with friction that a free block slides on without rocking, the chained one rocks.
TEST(Chain, PullsTheTopBackSoThatTheBlockRocks) {
  const FloorMotion motion = rectangular_pulse(-6, 0.4);
  Specimen free = chained(0.2, 1e9, Model::slide_rock);
  const Specimen held = free;
  free.effects.clear();
  for (const auto& [name, solve] : both) {
    EXPECT_EQ(solve(free, {&motion}, {}, nullptr).peak_rotation_rad, 0) << name;
    const Response r = solve(held, {&motion}, {}, nullptr);
    EXPECT_GT(r.peak_rotation_rad, 1e-3) << name;
  }
}

TEST(Chain, MirroredMotionAndSideGiveTheMirrorImage) {
  const FloorMotion motion = rectangular_pulse(-6, 0.4);
  const Specimen right = chained(0.2, 1e9, Model::slide_rock);
  Specimen left = right;
  left.effects = {dynamics::use(
      {.slack_m = slack, .stiffness_npm = stiffness, .strength_n = 1e9, .height_m = 1.81, .side = -1}, left.block)};
  const Response a = respond(right, {&motion}), b = respond(left, {&motion, -1});
  EXPECT_EQ(a.peak_slip_m, b.peak_slip_m);
  EXPECT_EQ(a.residual_slip_m, -b.residual_slip_m);
  EXPECT_EQ(a.peak_acceleration_mps2, b.peak_acceleration_mps2);
}

// n chains at an angle beta are one along the shaking: of stiffness n k cos^2(beta), slack / cos(beta) and n cos(beta) times the
// strength.
TEST(Chain, SeveralThatCrossAreOneOfTheirSum) {
  const FloorMotion motion = rectangular_pulse(-6, 0.4);
  const double number = 2, beta = 15 * pi / 180;
  for (const double strength : {1e9, 900.0}) {
    Specimen one = chained(0.2, strength, Model::slide_rock), crossed = one;
    crossed.effects = {dynamics::use({.slack_m = slack * std::cos(beta),
                                      .stiffness_npm = stiffness / (number * std::cos(beta) * std::cos(beta)),
                                      .strength_n = strength / (number * std::cos(beta)),
                                      .height_m = 1.81,
                                      .number = number,
                                      .plan_angle_rad = beta},
                                     one.block)};
    for (const auto& [name, solve] : both) {
      const Response a = solve(one, {&motion}, {}, nullptr), b = solve(crossed, {&motion}, {}, nullptr);
      EXPECT_EQ(a.connection_failed, strength < 1e6) << name;
      EXPECT_EQ(b.connection_failed, a.connection_failed) << name;
      EXPECT_NEAR(a.peak_slip_m, b.peak_slip_m, 1e-8) << name;
      EXPECT_NEAR(a.peak_rotation_rad, b.peak_rotation_rad, 1e-8) << name;
    }
  }
}

// x = (v/D) e^(-z W t) sin(D t), D = W sqrt(1 - z^2): the mass on ice turns round at tan(D t) = D/(z W), and is let go where the
// chain would push, W^2 x + 2 z W x' = 0: D t = pi - 2 asin(z).
TEST(Chain, DampsAsADashpotThatOnlyPulls) {
  const double a = 1.5, t1 = 0.1, v = a * t1, W = std::sqrt(stiffness / mass), z = 0.2, D = W * std::sqrt(1 - z * z);
  const FloorMotion motion = rectangular_pulse(-a, t1);
  const auto displacement = [&](double t) { return v / D * std::exp(-z * W * t) * std::sin(D * t); };
  const auto velocity = [&](double t) {
    return v * std::exp(-z * W * t) * (std::cos(D * t) - z * W / D * std::sin(D * t));
  };
  for (const auto& [name, solve] : both) {
    Specimen specimen = chained(0, 1e9);
    specimen.effects = {dynamics::use({.slack_m = slack,
                                       .stiffness_npm = stiffness,
                                       .strength_n = 1e9,
                                       .height_m = 1.81,
                                       .damping_nspm = 2 * z * W * mass},
                                      specimen.block)};
    Settings settings;
    settings.free_vibration_s = 0.25;
    settings.tolerance = 1e-12;
    History history;
    history.step_s = 0.001;
    const Response r = solve(specimen, {&motion}, settings, &history);
    EXPECT_NEAR(r.peak_slip_m, slack + displacement(std::atan(D / (z * W)) / D), 1e-9) << name;
    EXPECT_NEAR(history.points.at(330).slip_velocity_mps, velocity((pi - 2 * std::asin(z)) / D), 1e-8) << name;
  }
}

// The centre of mass stands a part of the half width off the middle, as an effect that changes the block puts it.
const dynamics::Effect off_the_middle{.name = "off_the_middle", .specimen = [](Specimen& s, const auto& p) {
                                        s.block.right_m *= 1 - p[0];
                                        s.block.left_m *= 1 + p[0];
                                      }};

// A chain is a spring: on a still floor, up to the next impact, the rocking block exchanges the energy of its rotation,
// of its weight and of the chain, none of it lost. About the right corner, the chain's point, at a width 2 b from it and
// a height z, moves to the right by z sin(theta) + 2 b (1 - cos(theta)) and up by 2 b sin(theta) - z (1 - cos(theta)).
TEST(Chain, TakesNoEnergyFromABlockWhoseMassIsOffTheMiddle) {
  const double b = 0.36, z = 1.81, h = 0.5 * z, k = 4000 / mass, t1 = 0.25;
  const FloorMotion motion = rectangular_pulse(-8, t1);
  for (const double elevation : {-0.5, 0.0, 0.5})
    for (const double eccentricity : {-0.4, 0.0, 0.4})
      for (const auto& [name, solve] : both) {
        Specimen specimen{Block::rectangular(2 * b, z, mass), {1, 1}, {}, Model::rock};
        const dynamics::Chain chain{
            .slack_m = slack, .stiffness_npm = k * mass, .strength_n = 1e9, .height_m = z, .elevation_rad = elevation};
        specimen.effects = {{&off_the_middle, {eccentricity}}, dynamics::use(chain, specimen.block)};
        History history;
        history.step_s = 0.01;
        const Response r = solve(specimen, {&motion}, {.tolerance = 1e-12}, &history);
        ASSERT_EQ(r.outcome, Outcome::moved) << name;
        const double c = b * (1 - eccentricity), inertia = specimen.block.gyration2_m2 + h * h + c * c;
        double least = 1e300, most = -1e300, pulled = 0;
        for (const HistoryPoint& point : history.points) {
          if (point.time_s <= t1) continue;
          if (!(point.rotation_rad > 1e-3)) break;
          const double theta = point.rotation_rad, sine = std::sin(theta), lost = 1 - std::cos(theta);
          const double along = z * sine + 2 * b * lost, up = 2 * b * sine - z * lost;
          const double stretch = std::fmax(along * std::cos(elevation) - up * std::sin(elevation) - slack, 0);
          const double energy = 0.5 * inertia * point.rotation_rate_radps * point.rotation_rate_radps +
                                standard_gravity_mps2 * (c * sine - h * lost) + 0.5 * k * stretch * stretch;
          least = std::fmin(least, energy);
          most = std::fmax(most, energy);
          pulled = std::fmax(pulled, stretch);
        }
        EXPECT_GT(pulled, 0.02) << name << ' ' << eccentricity << ' ' << elevation;
        EXPECT_LT(most - least, 1e-8 * most) << name << ' ' << eccentricity << ' ' << elevation;
      }
}

// Stretched, a chain at the angle gamma takes P sin(gamma) of the weight, and with it mu of that from friction: a block that runs into it at v
// is stopped by u'' = -mu g - W^2 x, W^2 = (k/m) cos(gamma) (cos(gamma) - mu sin(gamma)), x beyond the slack.
TEST(Chain, AtAnAngleToTheFloorChangesFriction) {
  const double a = 3, t1 = 0.1, mu = 0.1, brake = mu * standard_gravity_mps2;
  const FloorMotion motion = rectangular_pulse(-a, t1);
  for (const double gamma : {-0.9, -0.3, 0.4, 1.0})
    for (const auto& [name, solve] : both) {
      Specimen specimen = chained(mu, 1e9);
      specimen.effects = {dynamics::use({.slack_m = slack * std::cos(gamma),
                                         .stiffness_npm = stiffness,
                                         .strength_n = 1e9,
                                         .height_m = 1.81,
                                         .elevation_rad = gamma},
                                        specimen.block)};
      const double pushed = (a - brake) * t1, at = 0.5 * pushed * t1, v2 = pushed * pushed - 2 * brake * (slack - at);
      ASSERT_GT(v2, 0);
      ASSERT_LT(at, slack);
      const double W2 = stiffness / mass * std::cos(gamma) * (std::cos(gamma) - mu * std::sin(gamma));
      const double peak = slack + std::sqrt(brake * brake / W2 + v2) / std::sqrt(W2) - brake / W2;
      const Response r = solve(specimen, {&motion}, {.tolerance = 1e-12}, nullptr);
      EXPECT_NEAR(r.peak_slip_m, peak, 1e-9) << name << ' ' << gamma;
    }
}

// A block that stands stretched by P, at the height z of its face, tips away from the wall where |a| h > b g + (z cos(gamma) - 2 b sin(gamma)) P,
// and slips towards it where |a| + P cos(gamma) > mu (g - P sin(gamma)).
TEST(Chain, AtAnAngleToTheFloorChangesWhatTipsAndWhatSlips) {
  const double b = 0.36, z = 1.81, h = 0.5 * z, x = 0.004, g = standard_gravity_mps2;
  for (const double gamma : {-0.6, 0.6})
    for (const double part : {0.999, 1.001})
      for (const auto& [name, solve] : both) {
        const double pull = stiffness / mass * x * std::cos(gamma);
        const auto stretched = [&](double mu, Model model) {
          Specimen specimen = chained(mu, 1e9, model);
          specimen.start.slip_m = x;
          specimen.effects = {dynamics::use(
              {.stiffness_npm = stiffness, .strength_n = 1e9, .height_m = z, .elevation_rad = gamma}, specimen.block)};
          return specimen;
        };
        const double tips = (b * g + (z * std::cos(gamma) - 2 * b * std::sin(gamma)) * pull) / h;
        const FloorMotion away = rectangular_pulse(-part * tips, 0.02);
        const Response tipped = solve(stretched(20, Model::slide_rock), {&away}, {.free_vibration_s = 0}, nullptr);
        EXPECT_EQ(tipped.peak_rotation_rad > 0, part > 1) << name << ' ' << gamma;
        const double mu = 0.9, slips = mu * (g - pull * std::sin(gamma)) - pull * std::cos(gamma);
        const FloorMotion back = rectangular_pulse(part * slips, 0.02);
        const Response slid = solve(stretched(mu, Model::slide), {&back}, {.free_vibration_s = 0}, nullptr);
        EXPECT_EQ(slid.slid_path_m > 0, part > 1) << name << ' ' << gamma;
      }
}

// Random chains at an angle to the floor, with damping, that break or not, of blocks that slide, rock and are thrown up: in packs to the bit, and by
// both integrators.
TEST(Chain, AtAnAngleToTheFloorGoesInPacksAndByTheReference) {
  test::CaseFamily family;
  family.seed = 173;
  family.one_model = 0;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  family.excess_low = 1.2;
  std::vector<test::RandomCase> cases;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (std::uint64_t i = 0; i < 60; ++i) {
    test::KeyedRandom random(5, i);
    cases.push_back(test::random_case(family, i));
    Specimen specimen = cases.back().specimen;
    const Block& block = specimen.block;
    const double per_mass = block.mass_kg;
    specimen.effects = {dynamics::use({.slack_m = random.chance(0.3) ? 0 : random.uniform(0, 0.03),
                                       .stiffness_npm = per_mass * random.log_uniform(50, 2000),
                                       .strength_n = per_mass * (random.chance(0.5) ? 1e3 : random.log_uniform(0.5, 5)),
                                       .height_m = block.full_height_m() * random.uniform(0.4, 1),
                                       .side = random.chance(0.5) ? 1 : -1,
                                       .elevation_rad = random.uniform(-1.2, 1.2),
                                       .damping_nspm = random.chance(0.5) ? 0 : per_mass * random.uniform(0, 5)},
                                      block)};
    if (i % 3 == 0) specimen.model = Model::slide;
    specimens.push_back(specimen);
    shakings.push_back(cases.back().shaking);
  }
  std::vector<Response> together(specimens.size());
  respond_batch(specimens, shakings, {}, together);
  int failed = 0;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Response alone = respond(specimens[i], shakings[i]);
    EXPECT_EQ(together[i].outcome, alone.outcome) << i;
    EXPECT_EQ(together[i].peak_slip_m, alone.peak_slip_m) << i;
    EXPECT_EQ(together[i].peak_rotation_rad, alone.peak_rotation_rad) << i;
    EXPECT_EQ(together[i].peak_acceleration_mps2, alone.peak_acceleration_mps2) << i;
    failed += alone.connection_failed;
    const Response fast = respond(specimens[i], shakings[i], {.tolerance = 1e-12}),
                   reference = respond_reference(specimens[i], shakings[i], {.tolerance = 1e-12});
    EXPECT_EQ(fast.outcome, reference.outcome) << i;
    if (fast.peak_rotation_rad > specimens[i].block.alpha_rad()) continue;  // it hangs over, where errors grow
    EXPECT_NEAR(fast.peak_slip_m, reference.peak_slip_m, 1e-7) << i;
    EXPECT_NEAR(fast.peak_rotation_rad, reference.peak_rotation_rad, 1e-7) << i;
  }
  EXPECT_GT(failed, 5);
}

// The report: 0.43 g free and 3.22 g chained, 0.47 g and 1.57 g. Under pulses that slide the block well beyond its
// slack, peak equipment acceleration rises several times over.
TEST(Chain, RaisesPeakEquipmentAccelerationSeveralTimesOver) {
  const FloorMotion sine = test::one_sine();
  double least = 100;
  for (const double period : {0.5, 0.7, 1.0})
    for (const double peak_g : {0.8, 1.0, 1.2}) {
      Specimen specimen = chained(0.25, 1e9, Model::slide_rock);
      const Shaking shaking{&sine, -peak_g * standard_gravity_mps2, period};
      const double held = respond(specimen, shaking).peak_acceleration_mps2;
      specimen.effects.clear();
      least = std::min(least, held / respond(specimen, shaking).peak_acceleration_mps2);
    }
  EXPECT_GT(least, 3);
}

}  // namespace
}  // namespace freestand
