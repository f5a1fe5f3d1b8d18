// From fitted candidates to a verdict, on candidates whose errors are given.
#include "measurement/decide.hpp"

#include <gtest/gtest.h>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement {
namespace {

constexpr double samples = 1000;

Dataset cabinet_tests() {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  return test::made_dataset(cabinet);
}

// error: of every test left out [noise units]; explained: sqrt(G/samples).
Candidate candidate(const Bench& bench, std::vector<std::string> effects, double error, double explained) {
  Candidate c{.effects = std::move(effects), .fit = {.model = test::free_friction(), .x = {0.2}}};
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  for (std::size_t i = 0; i < tests; ++i)
    c.fit.left_out.push_back({.score = 2 * std::log(error), .noise_units = error});
  c.fit.calibration = c.fit.left_out;
  c.fit.left_out_refitted = true;
  c.explained = explained;
  c.misfits.assign(tests, samples / static_cast<double>(tests) * explained * explained);
  c.misfit = c.misfit_of_fit = samples * explained * explained;
  return c;
}

// strays: of every test of the base.
Diagnosis decided(const Bench& bench, double error, double explained, double strays = 0) {
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  Diagnosis d;
  d.samples.assign(tests, samples / static_cast<double>(tests));
  d.strays.assign(tests, strays);
  d.base = candidate(bench, {}, 5.5, 2.9);
  d.candidates = {candidate(bench, {"reduced_base"}, error, explained)};
  decide(bench, d);
  return d;
}

TEST(Decide, AnEffectThatLowersTheErrorIsMissing) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  EXPECT_EQ(decided(bench, 1.05, 1.0).verdict, Verdict::missing);
}

// The covariance of replays may excuse a model that misses tests left out by more than the base does.
TEST(Decide, AnEffectThatRaisesTheErrorIsNotMissing) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  const Diagnosis d = decided(bench, 9.4, 1.1);
  EXPECT_EQ(d.verdict, Verdict::unknown);
  EXPECT_TRUE(d.effects.empty());
}

// A chaotic rocking that went another way than measured proves nothing where replays of the floor's noise do so as well.
TEST(Decide, AnEffectThatGainsLessThanReplaysOfTheBaseStrayIsNotMissing) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  const Diagnosis d = decided(bench, 1.05, 1.0, samples * 2.9 * 2.9);
  EXPECT_EQ(d.verdict, Verdict::none);
  EXPECT_TRUE(d.effects.empty());
}

}  // namespace
}  // namespace freestand::measurement
