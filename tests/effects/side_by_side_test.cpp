// Two blocks that slide side by side: closed forms of blows and of blocks that press, the wall that a heavy and rough neighbour is, mirror
// images, roles exchanged, and a time-stepper that knows impulses only.
#include "dynamics/side_by_side.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "effects/effect_fixture.hpp"
#include "support/floor_motions.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test::side_by_side_test {
namespace {

Specimen block_beside(Friction friction, double mass_kg, const Neighbour& neighbour) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 1.2, mass_kg);
  specimen.friction = friction;
  specimen.model = Model::slide;
  specimen.neighbour = neighbour;
  return specimen;
}

// The other one of the two.
Specimen exchanged(const Specimen& one) {
  const Neighbour& n = *one.neighbour;
  return block_beside(n.friction, n.mass_kg, {n.gap_m, -n.side, one.block.mass_kg, one.friction, n.restitution});
}

Shaking shaking_of(const FloorMotion& motion, double scale = 1) { return {.motion = &motion, .scale = scale}; }

Response answer(const Specimen& specimen, const Shaking& shaking) {
  return respond(specimen, shaking, {.tolerance = 1e-11, .slip_by_side = true});
}

// The floor jerks back under a block on ice, which comes to its neighbour with v^2 = 2 A S; S is what is left of the gap.
TEST(SideBySide, ABlowAndTheSlipsAfterIt) {
  const double A = 4, T = 0.4, mu = 0.2, mu_other = 0.5, gap = 0.3, e = 0.6, m = 100, m_other = 300;
  const FloorMotion motion = staircase({T, 3}, {-A, 0});
  const Specimen specimen = block_beside({mu, mu}, m, {gap, 1, m_other, {mu_other, mu_other}, e});
  const double pull = A - mu * g, v0 = pull * T, u0 = 0.5 * pull * T * T;
  ASSERT_LT(A, mu_other * g);  // it stays where it is until it is struck
  ASSERT_LT(u0, gap);
  const double v = std::sqrt(v0 * v0 - 2 * mu * g * (gap - u0));
  const double after = v * (m - e * m_other) / (m + m_other), other = v * (1 + e) * m / (m + m_other);
  const Response r = answer(specimen, shaking_of(motion)), o = answer(exchanged(specimen), shaking_of(motion));
  EXPECT_EQ(r.outcome, Outcome::moved);
  EXPECT_EQ(r.wall_hits, 1);
  EXPECT_NEAR(r.wall_speed_mps, v, 1e-10);
  EXPECT_NEAR(r.peak_slip_m, gap, 1e-10);
  EXPECT_NEAR(r.residual_slip_m, gap - after * after / (2 * mu * g), 1e-10);  // thrown back
  EXPECT_NEAR(o.residual_slip_m, other * other / (2 * mu_other * g), 1e-10);
  EXPECT_NEAR(o.wall_speed_mps, v, 1e-10);
  EXPECT_NEAR(r.peak_acceleration_mps2, mu * g, 1e-12);
}

// What stands on ice leans on what stands on rubber: it holds up to the mean of their friction, and then both go as one.
TEST(SideBySide, BlocksThatPressGoAsOne) {
  const double m = 100, m_other = 300, mu_s = 0.5, mu_k = 0.45, ice_s = 0.2, ice_k = 0.1, T = 0.5;
  const Specimen specimen = block_beside({mu_s, mu_k}, m, {0, 1, m_other, {ice_s, ice_k}, 0.5});
  const double joint_s = (m * mu_s + m_other * ice_s) / (m + m_other),
               joint_k = (m * mu_k + m_other * ice_k) / (m + m_other);
  const FloorMotion below = rectangular_pulse(0.999 * joint_s * g, T), above = rectangular_pulse(1.2 * joint_s * g, T);
  EXPECT_EQ(answer(specimen, shaking_of(below)).outcome, Outcome::at_rest);
  const Response r = answer(specimen, shaking_of(above)), o = answer(exchanged(specimen), shaking_of(above));
  const double pull = 1.2 * joint_s * g - joint_k * g, v = pull * T;
  const double slip = 0.5 * v * T + v * v / (2 * joint_k * g);
  EXPECT_NEAR(r.residual_slip_m, -slip, 1e-10);
  EXPECT_NEAR(o.residual_slip_m, -slip, 1e-10);
  EXPECT_EQ(r.wall_hits, 0);
  EXPECT_NEAR(r.peak_acceleration_mps2, joint_k * g, 1e-12);
  // The other way the block on ice goes by itself, and the rough one stays.
  const Response away = answer(specimen, shaking_of(above, -1)),
                 ice = answer(exchanged(specimen), shaking_of(above, -1));
  const double pull_ice = 1.2 * joint_s * g - ice_k * g;
  EXPECT_EQ(away.outcome, Outcome::at_rest);
  EXPECT_NEAR(ice.residual_slip_m, 0.5 * pull_ice * T * T * (1 + pull_ice / (ice_k * g)), 1e-9);
}

// A neighbour that hardly anything moves is a wall, which effect wall_impact is. What the block feels where it comes to stand with it,
// its neighbour's friction, is nothing that a wall does.
TEST(SideBySide, AHeavyAndRoughNeighbourIsAWall) {
  CaseFamily family;
  family.seed = 41;
  family.vertical = 0;
  family.duration_low_s = 4;
  family.duration_high_s = 6;
  int hits = 0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    RandomCase c = random_case(family, number);
    c.specimen.model = Model::slide;
    c.specimen.impact = {};
    const double e = 0.15 * static_cast<double>(number % 6), gap = 0.001 * static_cast<double>(1 + number % 5);
    const int side = number % 2 ? 1 : -1;
    Specimen walled = c.specimen, beside = c.specimen;
    walled.effects = {effect("wall_impact", {side * gap, e})};
    beside.neighbour = Neighbour{gap, side, 1e15 * c.specimen.block.mass_kg, {50, 50}, e};
    const Response wall = answer(walled, c.shaking), r = answer(beside, c.shaking);
    hits += wall.wall_hits > 0;
    EXPECT_NEAR(r.peak_slip_m, wall.peak_slip_m, 1e-7) << number << ' ' << c.text();
    EXPECT_NEAR(r.residual_slip_m, wall.residual_slip_m, 1e-6) << number << ' ' << c.text();
    EXPECT_NEAR(r.wall_speed_mps, wall.wall_speed_mps, 1e-6) << number << ' ' << c.text();
  }
  EXPECT_GT(hits, 15);
}

struct RandomPair {
  RandomCase floor;
  Specimen specimen;
};

RandomPair random_pair(std::uint64_t number) {
  CaseFamily family;
  family.seed = 7;
  family.vertical = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 5;
  family.mu_high = 0.6;
  RandomPair pair{random_case(family, number), {}};
  KeyedRandom random(8, number);
  const auto friction = [&](double mu) { return Friction{mu * (random.chance(0.5) ? 1 : random.uniform(1, 1.6)), mu}; };
  const double mu = pair.floor.specimen.friction.mu_k;
  Neighbour n;
  n.gap_m = random.chance(0.25) ? 0 : random.log_uniform(0.002, 0.1);
  n.side = random.chance(0.5) ? 1 : -1;
  n.mass_kg = random.log_uniform(20, 500);
  n.friction = friction(random.chance(0.2) ? mu : mu * random.log_uniform(0.3, 3));
  n.restitution = random.chance(0.2) ? 0 : random.uniform(0, 1);
  pair.specimen = block_beside(friction(mu), 100, n);
  return pair;
}

// Velocities after each small step by impulses alone: of the floor, of friction within its bounds, and of contact, as large as it takes.
class Stepper {
 public:
  Stepper(const Specimen& specimen, const Shaking& shaking)
      : one_{specimen.block.mass_kg, specimen.friction},
        two_{specimen.neighbour->mass_kg, specimen.neighbour->friction},
        gap_(specimen.neighbour->gap_m),
        e_(specimen.neighbour->restitution),
        side_(specimen.neighbour->side),
        shaking_(shaking) {}

  void run(double step_s, double end_s) {
    for (long i = 0; static_cast<double>(i) * step_s < end_s; ++i) {
      const double t = static_cast<double>(i) * step_s;
      const double a =
          t + 0.5 * step_s < shaking_.duration_s() ? side_ * horizontal_acceleration(shaking_, t + 0.5 * step_s) : 0.0;
      const double approach = one_.w - two_.w;
      const auto at = [&](double impulse) {
        return std::pair{one_.after(-a * step_s - impulse / one_.mass, step_s),
                         two_.after(-a * step_s + impulse / two_.mass, step_s)};
      };
      double impulse = 0;
      const auto [w1, w2] = at(0);
      if (gap_ + (w2 - w1) * step_s <= 0) {                                     // they would meet
        const double parts = approach > 10 * g * step_s ? e_ * approach : 0.0;  // a slower one is no blow but pressing
        double low = 0, high = 10 * (one_.mass + two_.mass) * (std::abs(one_.w) + std::abs(two_.w) + 100 * g * step_s);
        for (int k = 0; k < 100; ++k) {
          impulse = 0.5 * (low + high);
          const auto [x, y] = at(impulse);
          (y - x < parts ? low : high) = impulse;
        }
        impulse = high;
      }
      const auto [x, y] = at(impulse);
      gap_ += 0.5 * step_s * (two_.w + y - one_.w - x);
      one_.go(x, step_s);
      two_.go(y, step_s);
    }
  }
  double residual() const { return side_ * one_.u; }
  double peak() const { return one_.peak; }

 private:
  struct Body {
    double mass;
    Friction friction;
    double w = 0, u = 0, peak = 0;

    double after(double change, double step_s) const {
      const double free = w + change, kinetic = friction.mu_k * g * step_s;
      if (w == 0 && std::abs(free) <= friction.mu_s * g * step_s) return 0;
      if (std::abs(free) <= kinetic) return 0;
      return free - std::copysign(kinetic, free);
    }
    void go(double next, double step_s) {
      u += 0.5 * (w + next) * step_s;
      w = next;
      peak = std::max(peak, std::abs(u));
    }
  };
  Body one_, two_;
  double gap_, e_;
  int side_;
  const Shaking& shaking_;
};

// The stepper's own error is that between two of its steps; where a slip that stops or a blow that just comes about parts them, neither
// is right or wrong.
TEST(SideBySide, AgreesWithTheTimeStepper) {
  const char* wanted = std::getenv("FREESTAND_PAIR_CASES");
  const std::uint64_t cases = wanted ? std::strtoull(wanted, nullptr, 10) : 16;
  std::uint64_t compared = 0, hit = 0;
  for (std::uint64_t number = 0; number < cases; ++number) {
    const RandomPair pair = random_pair(number);
    const Response r = answer(pair.specimen, pair.floor.shaking);
    ASSERT_TRUE(r.outcome == Outcome::moved || r.outcome == Outcome::at_rest) << number;
    Stepper coarse(pair.specimen, pair.floor.shaking), fine = coarse;
    const double end = r.end_time_s + 0.1;
    coarse.run(8e-5, end);
    fine.run(2e-5, end);
    const double own = std::max(std::abs(coarse.residual() - fine.residual()), std::abs(coarse.peak() - fine.peak()));
    if (own > 0.02 * (r.slid_path_m + 0.01)) continue;
    ++compared;
    hit += r.wall_hits > 0;
    const double allowed = own + 1e-3 * r.slid_path_m + 1e-5;
    EXPECT_NEAR(fine.peak(), r.peak_slip_m, allowed) << number << ' ' << pair.floor.text();
    EXPECT_NEAR(fine.residual(), r.residual_slip_m, allowed) << number << ' ' << pair.floor.text();
  }
  EXPECT_GT(compared, cases * 9 / 10);
  EXPECT_GT(hit, cases / 4);
}

TEST(SideBySide, MirrorImagesRolesExchangedAndRoomBetweenThem) {
  for (std::uint64_t number = 0; number < 200; ++number) {
    const RandomPair pair = random_pair(number);
    Specimen mirrored = pair.specimen;
    mirrored.neighbour->side = -mirrored.neighbour->side;
    Shaking turned = pair.floor.shaking;
    turned.scale = -turned.scale;
    const Response r = answer(pair.specimen, pair.floor.shaking), m = answer(mirrored, turned);
    EXPECT_EQ(r.residual_slip_m, -m.residual_slip_m) << number;
    EXPECT_EQ(r.peak_slip_right_m, m.peak_slip_left_m) << number;
    EXPECT_EQ(r.wall_hits, m.wall_hits) << number;
    const Response o = answer(exchanged(pair.specimen), pair.floor.shaking);
    EXPECT_EQ(o.wall_hits, r.wall_hits) << number;
    EXPECT_NEAR(o.wall_speed_mps, r.wall_speed_mps, 1e-9) << number;
    const Neighbour& n = *pair.specimen.neighbour;
    EXPECT_GT(n.gap_m + n.side * (o.residual_slip_m - r.residual_slip_m), -1e-9) << number;
  }
}

// No tolerance enters but through rows of blows that are cut, and a pulse is as good as the record of it.
TEST(SideBySide, DoesNotHangOnTheTolerance) {
  for (std::uint64_t number = 0; number < 100; ++number) {
    const RandomPair pair = random_pair(number);
    const Response fine = respond(pair.specimen, pair.floor.shaking, {.tolerance = 1e-12});
    const Response r = respond(pair.specimen, pair.floor.shaking, {.tolerance = 1e-9});
    EXPECT_NEAR(r.residual_slip_m, fine.residual_slip_m, 1e-7) << number;
    EXPECT_NEAR(r.peak_slip_m, fine.peak_slip_m, 1e-7) << number;
  }
}

TEST(SideBySide, BatchesAreSingleSamplesToTheBitAndTheReferenceDeclines) {
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  std::vector<RandomPair> pairs;
  for (std::uint64_t number = 0; number < 20; ++number) pairs.push_back(random_pair(number));
  for (const RandomPair& pair : pairs) specimens.push_back(pair.specimen), shakings.push_back(pair.floor.shaking);
  std::vector<Response> responses(pairs.size());
  respond_batch(specimens, shakings, {}, responses);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(responses[i].residual_slip_m, respond(specimens[i], shakings[i]).residual_slip_m) << i;
    EXPECT_EQ(respond_reference(specimens[i], shakings[i]).outcome, Outcome::not_finite) << i;
  }
}

TEST(SideBySide, WhatCannotBeComputedIsNotFinite) {
  const FloorMotion motion = rectangular_pulse(4, 0.5);
  const Neighbour sound{0.1, 1, 100, {0.3, 0.2}, 0.5};
  const auto outcome = [&](const Specimen& specimen) { return respond(specimen, shaking_of(motion)).outcome; };
  ASSERT_EQ(outcome(block_beside({0.3, 0.2}, 100, sound)), Outcome::moved);
  for (const auto& spoil : std::vector<void (*)(Neighbour&)>{
           [](Neighbour& n) { n.gap_m = -0.01; }, [](Neighbour& n) { n.gap_m = std::nan(""); },
           [](Neighbour& n) { n.mass_kg = 0; }, [](Neighbour& n) { n.friction.mu_k = 0.4; },
           [](Neighbour& n) { n.restitution = 1.01; }, [](Neighbour& n) { n.side = 0; }}) {
    Neighbour spoilt = sound;
    spoil(spoilt);
    EXPECT_EQ(outcome(block_beside({0.3, 0.2}, 100, spoilt)), Outcome::not_finite);
  }
  Specimen rocks = block_beside({0.3, 0.2}, 100, sound);
  rocks.model = Model::slide_rock;
  EXPECT_EQ(outcome(rocks), Outcome::not_finite);
  Specimen pulled = block_beside({0.3, 0.2}, 100, sound);
  pulled.effects = {effect("viscous_drag", {0.5})};
  EXPECT_EQ(outcome(pulled), Outcome::not_finite);
}

}  // namespace
}  // namespace freestand::test::side_by_side_test
