// What the tests leave open of the numbers: intervals against the truth, over sets that are made many times.
#include "measurement/fit/posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

Specimen weakening_cabinet() { return test::cabinet("rate_weakening", {0.3, 0.1}); }

ModelSpec weakening(const Bench& bench) {
  return with_effect(test::free_friction(), *effects::find("rate_weakening"), bench.reach());
}

// FREESTAND_REPEATS for more. Intervals of 90 % hold the truth as often as a chance of 0.9 comes out.
const int noisy_sets = test::dear_repeats(12);
const test::Counts held_often = test::likely_counts(noisy_sets, 0.9);

TEST(Posterior, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const Dataset truth = test::made_dataset(weakening_cabinet(), 0);
  const Values numbers = {0.2, 0.3, 0.1};
  int holds[3] = {}, told_off = 0;
  double rank = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(noisy_sets); ++key) {
    const Dataset data = test::with_noise(truth, key);
    const Bench bench(data, 0);
    const Posterior p = posterior(bench, test::fitted(bench, weakening(bench), numbers), run_here);
    ASSERT_EQ(p.draws.size(), 500u);
    told_off += !p.stated_otherwise.empty();
    EXPECT_GT(p.counted, 0.3);
    for (std::size_t k = 0; k < 3; ++k) {
      const Interval interval = p.interval(k, 0.9);
      holds[k] += interval.lower <= numbers[k] && numbers[k] <= interval.upper;
    }
    const auto below =
        std::count_if(p.of_mean.begin(), p.of_mean.end(), [&](const Values& x) { return x[0] < numbers[0]; });
    rank += static_cast<double>(below) / 500 / noisy_sets;
  }
  for (const int number : holds) {
    EXPECT_GE(number, held_often.least);
    EXPECT_LE(number, held_often.most);
  }
  EXPECT_LE(told_off, test::likely_counts(noisy_sets, 0.05).most);  // all is as stated
  EXPECT_NEAR(rank, 0.5, 3 / std::sqrt(12.0 * noisy_sets));  // three standard deviations of the mean of uniform ranks
}

// The floor read too large by that factor, and the responses stamped so late, to the next reading.
Dataset read_otherwise(Dataset data, double gain, double late_s) {
  for (measurement::Test& t : data.tests) {
    t.scale *= gain;
    const std::vector<double> before = t.slip_m;
    const long late = std::lround(late_s / t.dt_s), last = static_cast<long>(before.size()) - 1;
    for (long k = 0; k <= last; ++k)
      t.slip_m[static_cast<std::size_t>(k)] = before[static_cast<std::size_t>(std::clamp(k - late, 0L, last))];
  }
  return data;
}

// A laboratory that states its floor's gain to 1 % and its clocks to 10 ms may be off by as much: intervals hold the truth all the same.
TEST(Posterior, IntervalsHoldTheTruthWhereWhatIsStatedIsOffWithinItsTolerances) {
  if (!test::long_tests()) GTEST_SKIP() << "a minute: FREESTAND_LONG_TESTS";
  const Dataset truth = test::made_dataset(weakening_cabinet(), 0);
  const Values numbers = {0.2, 0.3, 0.1};
  int holds[3] = {};
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(noisy_sets); ++key) {
    test::KeyedRandom random(41, key);
    const Dataset data =
        test::with_noise(read_otherwise(truth, 1 + 0.01 * random.normal(), 0.01 * random.normal()), key);
    const Bench bench(data, 0);
    const Posterior p = posterior(bench, test::fitted(bench, weakening(bench), numbers), run_here);
    EXPECT_GT(p.counted, 0.3) << key;
    for (std::size_t k = 0; k < 3; ++k) {
      const Interval interval = p.interval(k, 0.9);
      holds[k] += interval.lower <= numbers[k] && numbers[k] <= interval.upper;
    }
  }
  for (const int number : holds) EXPECT_GE(number, held_often.least);
}

// The slip of one test read 6 % too large: friction is no less known for that than tests disagree.
TEST(Posterior, OneSensorThatReadsTooMuchLeavesFrictionKnown) {
  Dataset data = test::with_noise(test::made_dataset(test::cabinet(), 0), 3);
  for (double& slip : data.tests[2].slip_m) slip *= 1.06;
  const Bench bench(data, 0);
  const Posterior p = posterior(bench, test::fitted(bench, test::free_friction(), {0.2}), run_here);
  const Interval interval = p.interval(0, 0.95);
  EXPECT_TRUE(p.tests_disagree || p.leaves_too_much);
  EXPECT_LT(interval.lower, 0.2);
  EXPECT_GT(interval.upper, 0.2);
  EXPECT_LT(interval.upper - interval.lower, 0.02) << p.dispersion << " " << p.friction_scatter;
}

// Friction that scatters by 5 %: the mean's interval holds the truth, and the draws hold the friction of a test to come.
TEST(Posterior, FrictionOfAnotherTestScattersAsThatOfTheTestsDoes) {
  constexpr double scatter = 0.05;
  int holds = 0, holds_another = 0;
  double found = 0, widths = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(noisy_sets); ++key) {
    test::KeyedRandom random(31, key);
    std::vector<double> factors;
    for (int i = 0; i < 5; ++i) factors.push_back(std::exp(scatter * random.normal()));
    const Dataset data = test::with_noise(test::made_dataset(test::cabinet(), 0, factors), key);
    const Bench bench(data, 0);
    const Posterior p = posterior(bench, test::fitted(bench, test::free_friction(), {0.2}), run_here);
    const Interval mean = p.interval(0, 0.9);
    holds += mean.lower <= 0.2 && 0.2 <= mean.upper;
    const double another = 0.2 * factors[4];
    const auto below = std::count_if(p.draws.begin(), p.draws.end(), [&](const Values& x) { return x[0] < another; });
    holds_another += below >= 25 && below <= 475;
    found += p.friction_scatter / noisy_sets;
    std::vector<double> drawn;
    for (const Values& x : p.draws) drawn.push_back(std::log(x[0]));
    std::sort(drawn.begin(), drawn.end());
    widths += 0.5 * (drawn[475] - drawn[25]) / p.friction_scatter / noisy_sets;
  }
  // Of four tests Student's t of three degrees, 2.35 where a normal deviate is 1.64, and beside it that of their mean, half as wide.
  EXPECT_NEAR(widths, 2.353 * std::sqrt(1.25), 0.25);
  EXPECT_GE(holds, held_often.least);
  EXPECT_GE(holds_another, held_often.least);
  EXPECT_NEAR(found, scatter, 0.015);
}

// Of two tests the scatter has one degree of freedom, and Student's t ends nowhere: what the number cannot be is not drawn.
TEST(Posterior, FrictionIsDrawnWithinItsRange) {
  Dataset data = test::with_noise(test::made_dataset(test::cabinet(), 0, {0.9, 1.1, 1, 1, 1}), 3);
  data.tests.resize(2);
  const Bench bench(data, 0);
  const ModelSpec model = test::free_friction();
  const Posterior p = posterior(bench, test::fitted(bench, model, {0.2}), run_here);
  ASSERT_GT(p.friction_scatter, 0.05);
  for (const Values& x : p.draws) {
    EXPECT_GE(x[0], model.free[0].lower);
    EXPECT_LE(x[0], model.free[0].upper);
  }
  EXPECT_TRUE(draws_friction(model, p));
  ModelSpec given = model;
  given.free.clear();
  EXPECT_FALSE(draws_friction(given, p));
}

// The fit knows one friction of all tests, and so lies many of its standard errors from the numbers that are likely where each has its own: draws
// begin where these are. (From the fit they never met them: none counted, and the ranges were all that was left.)
TEST(Posterior, NumbersBesideFrictionThatScattersAreKnown) {
  constexpr int sets = 2;
  int holds = 0;
  for (std::uint64_t key = 0; key < sets; ++key) {
    test::KeyedRandom random(37, key);
    std::vector<double> factors;
    for (int i = 0; i < 5; ++i) factors.push_back(std::exp(0.05 * random.normal()));
    const Dataset data = test::with_noise(test::made_dataset(weakening_cabinet(), 0, factors), key);
    const Bench bench(data, 0);
    const Posterior p = posterior(bench, test::fitted(bench, weakening(bench), {0.2, 0.3, 0.1}), run_here);
    const Interval drop = p.interval(1, 0.95);
    EXPECT_GT(p.counted, 0.3) << key;
    EXPECT_LT(drop.upper - drop.lower, 0.15) << key;
    holds += drop.lower <= 0.3 && 0.3 <= drop.upper;
  }
  EXPECT_GE(holds, 1);  // a chance of 0.998
}

// A model that lacks an effect is not sure of its friction: tests pull it to and fro.
TEST(Posterior, AModelThatMissesIsLessSure) {
  const Dataset data = test::made_dataset(weakening_cabinet());
  const Bench bench(data, 0);
  const Posterior right = posterior(bench, test::fitted(bench, weakening(bench), {0.2, 0.3, 0.1}), run_here);
  const Posterior wrong = posterior(bench, test::fitted(bench, test::free_friction(), {0.17}), run_here);
  const Interval of_right = right.interval(0, 0.9), of_wrong = wrong.interval(0, 0.9);
  EXPECT_GT(of_wrong.upper - of_wrong.lower, 3 * (of_right.upper - of_right.lower));
}

// Nor does it have a width, a gain or a clock stand for what it lacks: its draws are those of a laboratory that states all exactly. (They ran
// away, as far as a gain of three standard deviations let them, and bands held a quarter of the readings.)
TEST(Posterior, OfAModelThatMissesAllIsAsStated) {
  Dataset data = test::made_dataset(test::cabinet("static_friction", {1.4}));
  const auto draws = [&] {
    const Bench bench(data, 0);
    const Posterior p = posterior(bench, test::fitted(bench, test::free_friction(), {0.2}), run_here);
    EXPECT_TRUE(p.leaves_too_much);
    return p.draws;
  };
  const std::vector<Values> within_tolerances = draws();
  data.tolerance = {.width = 0, .centre_height = 0, .floor_gain = 0, .clock_s = 0};
  EXPECT_EQ(within_tolerances, draws());
}

// What a floor's gain makes of a fit is told of the laboratory; numbers that are given wrongly are told as such, whatever is off besides.
TEST(Posterior, WrongNumbersAreNotLaidOnTheLaboratory) {
  const Dataset data = test::with_noise(read_otherwise(test::made_dataset(test::cabinet(), 0), 1.02, 0), 5);
  const Bench bench(data, 0);
  const ModelFit fit = test::fitted(bench, test::free_friction(), {0.2});
  const Posterior of_fit = posterior(bench, fit, run_here);
  EXPECT_EQ(of_fit.stated_otherwise.rfind("the floor's accelerometer reads ", 0), 0u) << of_fit.stated_otherwise;
  EXPECT_TRUE(of_fit.better.empty());
  EXPECT_FALSE(of_fit.leaves_too_much);
  ModelFit given = fit;
  given.x = {0.17};
  EXPECT_FALSE(posterior(bench, given, run_here).better.empty());
}

// A hundred draws at 0.5, 1.5 ... 99.5: an interval of 90 % that must hold what lies beyond 5 % of them leaves out 10 % of the
// others.
TEST(Posterior, AnIntervalHoldsWhatItMust) {
  Posterior p;
  for (int i = 0; i < 100; ++i) p.of_mean.push_back({i + 0.5});
  for (const auto& [held, lower, upper] :
       {std::tuple{50.0, 5, 95}, std::tuple{7.0, 5, 95}, std::tuple{3.0, 3, 93}, std::tuple{-20.0, -20, 90},
        std::tuple{98.0, 8, 98}, std::tuple{300.0, 10, 300}}) {
    const Interval interval = p.interval(0, 0.9, held);
    EXPECT_NEAR(interval.lower, lower, 1e-9) << held;
    EXPECT_NEAR(interval.upper, upper, 1e-9) << held;
  }
}

// Friction of 0.2 that may not be below 0.21: the fit ends there, and all draws lie above it.
TEST(Posterior, AFittedNumberLiesWithinItsIntervalAtTheBoundOfItsRangeToo) {
  const Dataset data = test::made_dataset(test::cabinet());
  const Bench bench(data, 0);
  for (const double bound : {0.05, 0.21, 0.19}) {
    ModelSpec model = test::free_friction();
    Free& mu = model.free[0];
    (bound < 0.2 && bound > 0.1 ? mu.upper = mu.high : mu.lower = mu.low) = bound;
    ModelFit fit = test::fitted(bench, model, {bound});
    fit.evaluations = 1;
    const Posterior open = open_numbers(bench, fit, run_here);
    EXPECT_NEAR(fit.x[0], bound == 0.05 ? 0.2 : bound, 2e-3);
    ASSERT_EQ(fit.intervals.size(), 1u);
    for (const Interval& interval : {fit.intervals[0], interval_of(open, fit, 0, 0.9)}) {
      EXPECT_LE(interval.lower, fit.x[0]);
      EXPECT_GE(interval.upper, fit.x[0]);
      EXPECT_LT(interval.lower, interval.upper);
    }
  }
}

// A drag a quarter of the least that is met in practice: draws lie where the tests say, not where the catalogue's range begins.
TEST(Posterior, ANumberBeyondWhatIsMetInPractice) {
  constexpr double rate = 0.05;
  const dynamics::Effect& drag = *effects::find("viscous_drag");
  ASSERT_GT(drag.parameters[0].low, 2 * rate);
  const Dataset truth = test::made_dataset(test::cabinet("viscous_drag", {rate}), 0);
  int holds = 0;
  const int sets = test::dear_repeats(8);
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    const Dataset data = test::with_noise(truth, 300 + key);
    const Bench bench(data, 0);
    const ModelFit fit = test::fitted(bench, with_effect(test::free_friction(), drag, bench.reach()), {0.2, rate});
    const Interval interval = posterior(bench, fit, run_here).interval(1, 0.9);
    holds += interval.lower <= rate && rate <= interval.upper;
    EXPECT_LT(interval.upper, 0.15);
    EXPECT_LT(interval.lower, fit.x[1]);
  }
  EXPECT_GE(holds, test::likely_counts(sets, 0.9).least);
}

TEST(Posterior, OfAModelWithoutFreeNumbersNothingIsOpen) {
  const Dataset data = test::made_dataset(test::cabinet());
  const Bench bench(data, 0);
  ModelFit fit{.model = test::free_friction()};
  fit.model.mu_k = {.value = 0.2};
  fit.model.free.clear();
  EXPECT_TRUE(posterior(bench, fit, run_here).draws.empty());
}

}  // namespace
}  // namespace freestand::measurement
