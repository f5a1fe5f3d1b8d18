// Friction recovered from the motion alone.
#include "measurement/recover.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement {
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

TEST(Recover, ConstantFrictionIsConstant) {
  const Dataset data = test::made_dataset(cabinet(0.15));
  const Recovered r = recover(Bench(data, 0), 0.15, false);
  ASSERT_GT(r.samples, 100U);
  EXPECT_NEAR(r.mean_mu, 0.15, 0.003);
  const RecoveredTable& direction = over(r, "direction");
  for (std::size_t b = 0; b < direction.mu.size(); ++b) EXPECT_NEAR(direction.mu[b], 0.15, 0.005);
}

// mu (1 + d sigma): the two directions are parted by 2 mu d.
TEST(Recover, DirectionalFrictionShowsOverTheDirection) {
  const auto* law = effects::find("directional_friction");
  const Dataset data = test::made_dataset(cabinet(0.15, {{law, {0.3}}}));
  const RecoveredTable t = over(recover(Bench(data, 0), 0.15, false), "direction");
  ASSERT_EQ(t.mu.size(), 2U);
  EXPECT_NEAR(t.mu[1] - t.mu[0], 2 * 0.15 * 0.3, 0.01);
}

}  // namespace
}  // namespace freestand::measurement
