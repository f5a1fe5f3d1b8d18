// What is left out, or held out, reaches nothing of a fit.
#include "measurement/fit/left_out.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/verdict/diagnose.hpp"

namespace freestand::measurement {
namespace {

Specimen block(double mu, std::vector<EffectUse> effects = {}) {
  Specimen s;
  s.block = Block::rectangular(0.8, 0.6, 100);
  s.friction = {mu, mu};
  s.effects = std::move(effects);
  return s;
}

constexpr std::size_t furthest = 3;  // the test for calibration in which the block slips furthest
constexpr Effort little = {.screened_per_number = 8,
                           .starts = 1,
                           .budget = 20,
                           .polish = 20,
                           .fold_budget = 20};  // what it finds matters little here

Dataset with_other_slips(Dataset data, std::size_t test, double factor) {
  for (double& slip : data.tests[test].slip_m) slip *= factor;
  return data;
}

// The base, and the base with a wall, each with tests left out.
std::vector<ModelFit> left_out_fits(const Dataset& data) {
  const Bench bench(data, 0);
  const ModelSpec base = test::free_friction();
  auto fits = fit_models(bench, {{.model = base}}, little, run_here);
  search_left_out(bench, base, {&fits[0]}, little, run_here);
  FitTask wall{.model = with_effect(base, *effects::find("wall_impact"), bench.reach())};
  for (const Values& x : fits[0].fold_x) wall.known.push_back({x});
  fits.push_back(fit_models(bench, {wall}, little, run_here).front());
  search_left_out(bench, base, {&fits[1]}, little, run_here);
  return fits;
}

TEST(LeftOut, AFitDoesNotDependOnWhatWasMeasuredInTheTestLeftOut) {
  const Dataset data = test::made_dataset(block(0.2));
  const auto fits = left_out_fits(data), others = left_out_fits(with_other_slips(data, furthest, 1.005));
  for (std::size_t m = 0; m < fits.size(); ++m) {
    EXPECT_EQ(fits[m].fold_x[furthest], others[m].fold_x[furthest]) << m;
    EXPECT_NE(fits[m].fold_x[1], others[m].fold_x[1]) << m;
  }
}

// At the noise as well, where little is gained by it.
TEST(LeftOut, AFitIsTheBestOfTheTestsThatItSees) {
  const Dataset data = test::made_dataset(block(0.237));
  const Bench bench(data, 0);
  const ModelSpec base = test::free_friction();
  auto fits = fit_models(bench, {{.model = base}}, {}, run_here);
  polish(bench, {&fits[0]}, {}, 0.05, run_here);
  search_left_out(bench, base, {&fits[0]}, {}, run_here);
  const auto tests = tests_of(data, Role::calibration);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    auto seen = tests;
    seen.erase(seen.begin() + static_cast<long>(k));
    EXPECT_NE(fits[0].fold_x[k], fits[0].x) << k;
    EXPECT_LT(mean_score(bench, seen, base, fits[0].fold_x[k]), mean_score(bench, seen, base, fits[0].x)) << k;
  }
  for (const TestError& e : fits[0].left_out) EXPECT_NEAR(e.noise_units, 1, 0.1);
}

TEST(HeldOut, ReachesNoRangeAndNoLandmark) {
  const Dataset data = test::made_dataset(block(0.2));
  const Dataset other = with_other_slips(data, 4, -9);
  ASSERT_EQ(data.tests[4].role, Role::holdout);
  const Reach reach = Bench(data, 0).reach(), with_other = Bench(other, 0).reach();
  EXPECT_EQ(reach.least_m, with_other.least_m);
  EXPECT_EQ(reach.greatest_m, with_other.greatest_m);
}

bool not_tried(const Diagnosis& d, const std::string& effect) {
  return std::any_of(d.sentences.begin(), d.sentences.end(), [&](const std::string& sentence) {
    return sentence.find("not tried") == 0 && sentence.find(effect) != std::string::npos;
  });
}

// Four tests, four numbers: histories tell enough of them, and the tether is found. Of four peaks it is told, and not tried.
TEST(AsManyNumbersAsTests, AreTriedOnHistories) {
  const auto *tilt = effects::find("floor_tilt"), *tether = effects::find("slack_tether");
  Dataset data = test::made_dataset(block(0.2, {{tether, {-0.02, 3.0, 2.0}}}));
  const Diagnosis d = diagnose(Bench(data, 2), test::free_friction(), {tilt, tether}, {}, run_here);
  EXPECT_EQ(d.effects, std::vector<std::string>{"slack_tether"});
  EXPECT_FALSE(not_tried(d, "slack_tether"));
  for (measurement::Test& test : data.tests) {
    const auto [least, most] = std::minmax_element(test.slip_m.begin(), test.slip_m.end());
    test.peaks.peak_slip_m = std::max(-*least, *most);
    test.slip_m.clear();
    test.rotation_rad.clear();
  }
  const Diagnosis of_peaks = diagnose(Bench(data, 2), test::free_friction(), {tilt, tether}, {}, run_here);
  EXPECT_TRUE(not_tried(of_peaks, "slack_tether"));
  for (const Candidate& c : of_peaks.candidates) EXPECT_LT(c.fit.x.size(), 4U) << c.effects.back();
}

// Four tests, two effects: pairs whose numbers are as many as the tests are told, and not tried.
TEST(Pairs, WithAsManyNumbersAsTestsAreNotTried) {
  const auto* tilt = effects::find("floor_tilt");
  const Dataset data = test::made_dataset(block(0.2, {{effects::find("viscous_drag"), {2.0}}, {tilt, {0.03}}}));
  const Bench bench(data, 2);
  DiagnosisOptions options;
  options.effort = little;
  const Diagnosis d =
      diagnose(bench, test::free_friction(), {tilt, effects::find("rate_weakening")}, options, run_here);
  for (const Candidate& c : d.candidates) EXPECT_LT(c.fit.x.size(), 4U) << c.effects.back();
  const bool told = std::any_of(d.sentences.begin(), d.sentences.end(), [](const std::string& sentence) {
    return sentence.find("not tried") == 0 && sentence.find("floor_tilt with rate_weakening") != std::string::npos;
  });
  EXPECT_TRUE(told);
}

// Friction in waves, which no three of these effects explain: the best pair is not enough, no third effect makes it better, and the search
// ends all the same. Each combination is a candidate once.
TEST(Pairs, SearchEndsWhereNoThirdEffectMakesTheBestPairBetter) {
  dynamics::Effect waves;
  waves.name = waves.law = "waves";
  waves.friction = [](const dynamics::At& at, const dynamics::Parameters&) { return 1.0 + 0.4 * sin(50.0 * at.u); };
  Dataset data = test::made_dataset(block(0.2, {{&waves, {}}}));
  for (measurement::Test& test : data.tests) test.role = Role::calibration;
  const Bench bench(data, 2);
  DiagnosisOptions options;
  options.effort = little;
  const Diagnosis d =
      diagnose(bench, test::free_friction(),
               {effects::find("floor_tilt"), effects::find("viscous_drag"), effects::find("centering_spring")}, options,
               run_here);
  EXPECT_EQ(d.verdict, Verdict::unknown);
  std::set<std::vector<std::string>> combinations;
  std::size_t most = 0;
  for (const Candidate& c : d.candidates) {
    std::vector<std::string> effects = c.effects;
    std::sort(effects.begin(), effects.end());
    EXPECT_TRUE(combinations.insert(effects).second) << effects.front() << " with " << effects.back();
    most = std::max(most, effects.size());
  }
  EXPECT_EQ(most, 3U);
}

}  // namespace
}  // namespace freestand::measurement
