// Friction recovered from the motion alone.
#include "measurement/tell/recover.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement::recover_test {
namespace {

Specimen cabinet(double mu, std::vector<EffectUse> effects = {}) {
  Specimen s;
  s.block = Block::rectangular(0.9, 0.5, 100);
  s.friction = {mu, mu};
  s.model = Model::slide;
  s.effects = std::move(effects);
  return s;
}

const RecoveredTable& over(const Recovered& r, const std::string& variable) {
  for (const RecoveredTable& t : r.tables)
    if (t.variable == variable) return t;
  throw std::runtime_error("no table over " + variable);
}

Recovered recovered(const Dataset& data) {
  ModelSpec base;
  base.mu_k.value = 0.15;
  return recover(Bench(data, 0), 0.15, base, {});
}

TEST(Recover, ConstantFrictionIsConstant) {
  const Recovered r = recovered(test::made_dataset(cabinet(0.15)));
  ASSERT_GT(r.samples, 100U);
  EXPECT_NEAR(r.mean_mu, 0.15, 0.003);
  const RecoveredTable& direction = over(r, "direction");
  for (std::size_t b = 0; b < direction.mu.size(); ++b) EXPECT_NEAR(direction.mu[b], 0.15, 0.005);
}

// Over sets whose friction is constant: bands of 95 % hold it in about so many bins and are no wider than that takes, and what its
// bins explain is what chance does.
TEST(Recover, BandsAndSharesAreThoseOfTheNoise) {
  double bins = 0, held = 0, square = 0, explained = 0, by_chance = 0;
  for (std::uint64_t set = 0; set < 12; ++set) {
    const Recovered r = recovered(test::with_noise(test::made_dataset(cabinet(0.15), 0), set));
    for (const char* variable : {"speed_mps", "path_m", "time_s"}) {
      const RecoveredTable& t = over(r, variable);
      explained += t.share_explained, by_chance += t.share_by_chance;
      for (std::size_t b = 0; b < t.mu.size(); ++b, ++bins) {
        held += t.mu_lower[b] <= 0.15 && 0.15 <= t.mu_upper[b];
        square += std::pow(2 * 1.96 * (t.mu[b] - 0.15) / (t.mu_upper[b] - t.mu_lower[b]), 2);
      }
    }
  }
  EXPECT_GT(held / bins, 0.91);
  EXPECT_NEAR(square / bins, 1, 0.3);
  EXPECT_NEAR(explained, by_chance, 0.3 * by_chance);
}

// mu (1 + d sigma): the two directions are parted by 2 mu d.
TEST(Recover, DirectionalFrictionShowsOverTheDirection) {
  const auto* law = effects::find("directional_friction");
  const Dataset data = test::made_dataset(cabinet(0.15, {{law, {0.3}}}));
  const RecoveredTable t = over(recovered(data), "direction");
  ASSERT_EQ(t.mu.size(), 2U);
  EXPECT_NEAR(t.mu[1] - t.mu[0], 2 * 0.15 * 0.3, 0.01);
}

// A spring pulls back, there and on the way: as friction it cancels, as a force it is -(2 pi f)^2 u.
TEST(Recover, ASpringShowsOverThePositionAsAForce) {
  const auto* spring = effects::find("centering_spring");
  const double f = 0.6, stiffness = std::pow(2 * pi * f, 2);
  const Dataset data = test::made_dataset(cabinet(0.15, {{spring, {f}}}));
  const Bench bench(data, 0);
  ModelSpec base;
  base.mu_k.value = 0.15;
  const RecoveredTable t =
      over(recover(bench, 0.15, with_effect(base, *spring, bench.reach()), Values{f}), "position_m");
  EXPECT_GT(t.share_of_force_explained, 2 * t.share_explained);
  EXPECT_TRUE(t.law_follows);
  for (std::size_t b = 0; b < t.centre.size(); ++b) {
    EXPECT_NEAR(t.law_force_mps2[b], -stiffness * t.centre[b], 0.01 * stiffness * std::abs(t.centre[b]) + 1e-3) << b;
    EXPECT_GT(t.law_force_mps2[b], t.force_lower_mps2[b]) << b;
    EXPECT_LT(t.law_force_mps2[b], t.force_upper_mps2[b]) << b;
  }
}

// The same slips, sampled at that rate.
Dataset sampled(const Specimen& specimen, double dt_s) {
  Dataset data = test::made_dataset(specimen);
  std::uint64_t seed = 0;
  for (Test& t : data.tests) {
    const Test fine = test::made_test(t.id, specimen, t.motion, ++seed, dt_s);
    t.dt_s = dt_s, t.slip_m = fine.slip_m, t.rotation_rad = fine.rotation_rad;
  }
  return data;
}

// The bands are of 95 %; twice as far apart as two of them allow, none of twelve bins may be.
TEST(Recover, DoesNotHangOnTheRateOfTheSamples) {
  const auto* law = effects::find("rate_weakening");
  const Specimen specimen = cabinet(0.2, {{law, {0.5, 0.2}}});
  const Recovered usual = recovered(sampled(specimen, 0.005));
  for (const double dt : {0.01, 0.001}) {
    SCOPED_TRACE(dt);
    const Recovered other = recovered(sampled(specimen, dt));
    EXPECT_NEAR(other.mean_mu, usual.mean_mu, 0.002);
    for (const char* variable : {"speed_mps", "path_m", "direction"}) {
      SCOPED_TRACE(variable);
      const RecoveredTable &a = over(usual, variable), &b = over(other, variable);
      ASSERT_EQ(a.mu.size(), b.mu.size());
      for (std::size_t k = 0; k < a.mu.size(); ++k) {
        EXPECT_NEAR(a.centre[k], b.centre[k], 0.1 * std::abs(a.edge.back() - a.edge.front())) << k;
        EXPECT_NEAR(a.mu[k], b.mu[k], std::hypot(a.mu_upper[k] - a.mu_lower[k], b.mu_upper[k] - b.mu_lower[k])) << k;
      }
    }
  }
}

// One test of 100 Hz on a rough floor, one of 1000 Hz on a smooth one: each counts for as long as it slips.
TEST(Recover, ATestOfManySamplesWeighsNoMoreThanOneOfFew) {
  const auto both = [](double dt_rough, double dt_smooth) {
    Dataset data = sampled(cabinet(0.2), dt_rough);
    data.tests.resize(2);
    data.tests[1] = sampled(cabinet(0.1), dt_smooth).tests[1];
    return recovered(data).mean_mu;
  };
  const double alike = both(0.005, 0.005);
  EXPECT_GT(alike, 0.12);
  EXPECT_LT(alike, 0.18);
  EXPECT_NEAR(both(0.01, 0.001), alike, 0.004);
  EXPECT_NEAR(both(0.001, 0.01), alike, 0.004);
}

}  // namespace
}  // namespace freestand::measurement::recover_test
