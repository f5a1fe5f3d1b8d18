// Which effects tests can see, and from where.
#include "measurement/fit/starts.hpp"

#include <gtest/gtest.h>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement {
namespace {

Specimen block(double width, double height, double mu) {
  Specimen s;
  s.block = Block::rectangular(width, height, 100);
  s.friction = {mu, mu};
  return s;
}

ModelFit at(const Bench& bench, double mu) {
  ModelFit fit{.model = test::free_friction(), .x = {mu}};
  fit.score = mean_score(bench, tests_of(bench.data(), Role::calibration), fit.model, fit.x);
  return fit;
}

bool sees(const Bench& bench, const ModelFit& fit, const std::vector<Values>& from, const char* effect) {
  return changes_predictions(bench, fit, from, *effects::find(effect));
}

TEST(Visible, ABlockThatOnlySlidesTellsNothingOfItsImpacts) {
  const Dataset data = test::made_dataset(block(0.8, 0.6, 0.2));
  const Bench bench(data, 0);
  const ModelFit fit = at(bench, 0.2);
  EXPECT_FALSE(sees(bench, fit, {fit.x}, "impact_loss"));
  EXPECT_FALSE(sees(bench, fit, {fit.x}, "pressure_friction"));
  EXPECT_FALSE(sees(bench, fit, {fit.x}, "vertical_shaking"));
  EXPECT_TRUE(sees(bench, fit, {fit.x}, "static_friction"));
  EXPECT_TRUE(sees(bench, fit, {fit.x}, "rate_weakening"));
}

// A slender block that rocks, taken for one that slides: there no impact is left to be seen, but where nothing slips.
TEST(Visible, FromTheEndsOfTheBasesRangesAsWell) {
  const Dataset data = test::made_dataset(block(0.4, 1.6, 0.9));
  const Bench bench(data, 0);
  const ModelFit astray = at(bench, 0.1);
  EXPECT_FALSE(sees(bench, astray, {astray.x}, "impact_loss"));
  EXPECT_TRUE(sees(bench, astray, vantage_points(astray), "impact_loss"));
}

TEST(Starts, JoinTheEffectsNumbersToEveryVantagePoint) {
  const Dataset data = test::made_dataset(block(0.8, 0.6, 0.2));
  const Bench bench(data, 0);
  const ModelFit fit = at(bench, 0.2);
  EXPECT_EQ(vantage_points(fit), (std::vector<Values>{{0.2}, {1.2}, {0.03}}));
  const ModelSpec model = with_effect(fit.model, *effects::find("rate_weakening"), bench.reach());
  const auto starts = starts_from(vantage_points(fit), model, 5);
  ASSERT_EQ(starts.size(), 15U);
  for (const Values& x : starts) EXPECT_EQ(x.size(), 3U);
  EXPECT_EQ(starts[5][0], 1.2);
  EXPECT_EQ(start_at_nothing(fit, *effects::find("rate_weakening"))[0], 0.2);
}

}  // namespace
}  // namespace freestand::measurement
