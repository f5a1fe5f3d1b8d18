// Chance where only peaks are known, against sets that are made many times.
#include "measurement/verdict/chance_of_peaks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/effects.hpp"
#include "measurement/fit/posterior.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/verdict/diagnose.hpp"
#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

const std::vector<const char*> others = {"rate_weakening", "viscous_drag", "floor_tilt", "centering_spring",
                                         "static_friction"};

// Peak slips of twelve tests, whose logarithms scatter, and friction from test to test.
Dataset peaks_of(const Specimen& of_all, double scatter, std::uint64_t key, double of_friction = 0) {
  test::KeyedRandom random(51, key), frictions(53, key);
  Dataset data;
  for (int i = 0; i < 12; ++i) {
    Specimen specimen = of_all;
    if (of_friction > 0) specimen.friction.mu_s = specimen.friction.mu_k *= std::exp(of_friction * frictions.normal());
    measurement::Test test;
    test.id = std::string("p").append(std::to_string(i));
    test.motion = of_friction > 0 ? test::swings(2.5 + 0.25 * i, 0.4 + 0.1 * (i % 5))
                                  : test::swings(3 + 0.5 * i, 0.4 + 0.1 * (i % 5));
    test.specimen = {0.8, 0.6, 100.0};
    test.peaks.peak_slip_m = respond(specimen, test.shaking()).peak_slip_m * std::exp(scatter * random.normal());
    data.tests.push_back(std::move(test));
  }
  return data;
}

// The friction of least score, by Gauss and Newton on so few numbers: a simplex is enough.
ModelFit fitted_to_peaks(const Bench& bench, ModelSpec model, const Values& start) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const Fitted found = simplex(
      model.free, [&](std::span<const double> x) { return mean_score(bench, tests, model, x); }, start, 0.1, 80);
  return {.model = std::move(model), .x = found.x, .score = found.score};
}

ModelFit with_other(const char* effect, const Bench& bench, const ModelFit& base) {
  ModelFit fit{.model = with_effect(test::free_friction(), *effects::find(effect), bench.reach()), .x = base.x};
  for (std::size_t i = 1; i < fit.model.free.size(); ++i) fit.x.push_back(from_unit(fit.model.free[i], 0.5));
  return fit;
}

Chance gain(const Dataset& data) {
  const Bench bench(data, 0);
  const ModelFit base = fitted_to_peaks(bench, test::free_friction(), {0.2});
  std::vector<ModelFit> fits;
  for (const char* effect : others) fits.push_back(with_other(effect, bench, base));
  std::vector<const ModelFit*> tried;
  for (const ModelFit& fit : fits) tried.push_back(&fit);
  return chance_of_gain_of_peaks(bench, base, tried, run_here);
}

// Of true bases one in twenty is said to lack something, counted over 100 sets: binomially 1 to 12 but for one run in 150.
TEST(ChanceOfPeaks, HasItsSize) {
  const int sets = test::dear_repeats(50);
  int rejected = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key)
    rejected += !gain(peaks_of(test::cabinet(), 0.25, key)).chance();
  EXPECT_GE(rejected, test::likely_counts(sets, 0.05).least);
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
}

// Friction that differs from test to test: where slips just begin they hang on it far more than where they are long. (As if all tests
// scattered alike, 11, 11 and 15 of 50 sets were said to lack an effect where friction scattered by 5, 10 and 15 %.)
TEST(ChanceOfPeaks, HasItsSizeWhereFrictionScatters) {
  if (!test::long_tests()) GTEST_SKIP() << "half a minute: FREESTAND_LONG_TESTS";
  const int sets = test::dear_repeats(50);
  int rejected = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key)
    rejected += !gain(peaks_of(test::cabinet(), 0.02, key, 0.1)).chance();
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
}

// Where the tests show it, it is told, of the model that the verdict speaks of; where all else scatters, it is not.
TEST(ChanceOfPeaks, FrictionThatScattersIsTold) {
  const auto told = [](const Dataset& data) {
    const Diagnosis d = diagnose(Bench(data, 0), test::free_friction(), {effects::find("viscous_drag")}, {}, run_here);
    return std::any_of(d.quality.findings.begin(), d.quality.findings.end(), [](const std::string& finding) {
      return finding.find("peaks scatter as if friction differed by") == 0;
    });
  };
  int times = 0;
  for (std::uint64_t key = 0; key < 4; ++key) times += told(peaks_of(test::cabinet(), 0.02, key, 0.15));
  EXPECT_GE(times, 1);  // twelve tests show a scatter of 15 % to 5 % in about a quarter of sets
  EXPECT_FALSE(told(peaks_of(test::cabinet(), 0.25, 5)));
}

TEST(ChanceOfPeaks, SeesAnEffectBesideFrictionThatScatters) {
  EXPECT_FALSE(gain(peaks_of(test::cabinet("static_friction", {2.0}), 0.02, 3, 0.05)).chance());
}

TEST(ChanceOfPeaks, SeesAnEffectThatOutweighsTheScatter) {
  const Chance chance = gain(peaks_of(test::cabinet("viscous_drag", {2.0}), 0.05, 1));
  EXPECT_LT(chance.p, 0.01);
  EXPECT_GT(chance.observed, chance.usual);
}

// Peaks are read to a thousandth: what a drag changes in the fifth digit is no effect that is missing, however well it fits. (p was 0.001.)
TEST(ChanceOfPeaks, NothingIsMissingBelowWhatPeaksAreReadTo) {
  Specimen dragged = test::cabinet();
  dragged.effects = {{.effect = effects::find("viscous_drag"), .parameters = {1e-3}}};
  EXPECT_EQ(gain(peaks_of(dragged, 0, 1)).p, 1);
  dragged.effects[0].parameters = {0.5};
  EXPECT_LT(gain(peaks_of(dragged, 0, 1)).p, 0.01);
}

// Data from one of two: the other is not held to lead, and the one is.
TEST(ChanceOfPeaks, SaysWhichOfTwoMadeTheData) {
  const Dataset data = peaks_of(test::cabinet("viscous_drag", {2.0}), 0.03, 2);
  const Bench bench(data, 0);
  const ModelFit base = fitted_to_peaks(bench, test::free_friction(), {0.2});
  const auto refitted = [&](const char* effect) {
    const ModelFit with = with_other(effect, bench, base);
    return fitted_to_peaks(bench, with.model, with.x);
  };
  const ModelFit drag = refitted("viscous_drag"), tilt = refitted("floor_tilt");
  EXPECT_LT(chance_of_lead_of_peaks(bench, drag, tilt, run_here).p, 0.02);
  EXPECT_GT(chance_of_lead_of_peaks(bench, tilt, drag, run_here).p, 0.3);
}

// Tests whose floors do not move the block, and a rotation of 0 beside each slip, say nothing of how far slips stray: p and intervals are what
// they are without them.
TEST(ChanceOfPeaks, WhatIsStillSaysNothingOfScatter) {
  const Dataset plain = peaks_of(test::cabinet(), 0.25, 4);
  Dataset with_still = plain, with_rotations = plain;
  for (int i = 0; i < 24; ++i) {
    measurement::Test& still = with_still.tests.emplace_back(plain.tests[0]);
    still.id = std::string("s").append(std::to_string(i));
    still.motion = test::swings(1, 0.4 + 0.02 * i);
    still.peaks.peak_slip_m = 0;
  }
  for (measurement::Test& test : with_rotations.tests) test.peaks.peak_rotation_rad = 0;
  const Chance expected = gain(plain);
  const auto opened = [](const Dataset& data) {
    const Bench bench(data, 0);
    return posterior(bench, fitted_to_peaks(bench, test::free_friction(), {0.2}), run_here);
  };
  const Posterior open = opened(plain);
  for (const Dataset* data : {&with_still, &with_rotations}) {
    const Chance found = gain(*data);
    EXPECT_NEAR(found.observed, expected.observed, 0.01);
    EXPECT_NEAR(found.p, expected.p, 0.02);
    const Posterior other = opened(*data);
    EXPECT_DOUBLE_EQ(other.freedom, open.freedom);
    EXPECT_NEAR((other.interval(0, 0.9).upper - other.interval(0, 0.9).lower) /
                    (open.interval(0, 0.9).upper - open.interval(0, 0.9).lower),
                1, 0.15);
  }
}

// Peaks and residuals that stray each by itself: p is spread evenly all the same. (As if one test's strayed together, 9 of 10 were beyond 0.9.)
TEST(ChanceOfPeaks, HasItsSizeWherePeaksOfATestStrayApart) {
  const int sets = test::dear_repeats(20);
  int high = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    Dataset data = peaks_of(test::cabinet(), 0.15, key);
    test::KeyedRandom random(52, key);
    for (measurement::Test& test : data.tests)
      test.peaks.residual_slip_m =
          std::abs(respond(test::cabinet(), test.shaking()).residual_slip_m) * std::exp(0.15 * random.normal());
    high += gain(data).p > 0.9;
  }
  EXPECT_LE(high, test::likely_counts(sets, 0.1).most);
}

// At the truth, its friction known.
Chance misfit_of(const Bench& bench, double mu) {
  ModelFit fit{.model = test::free_friction(), .x = {mu}};
  fit.calibration = test_errors(bench, tests_of(bench.data(), Role::calibration), fit.model, fit.x);
  return chance_of_misfit_of_peaks(bench, fit);
}

// Floors alike, and as strong as what friction scatters about: half the tests stand still, half slide, and no model tells which. The mean of the
// others would foretell each by less than the truth does.
TEST(ChanceOfPeaks, RefutesNoTruthWhereTestsStandOrSlideByChance) {
  const int sets = test::dear_repeats(40);
  int rejected = 0, still = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    test::KeyedRandom frictions(54, key);
    Dataset data = peaks_of(test::cabinet(), 0.1, key);
    for (measurement::Test& test : data.tests) {
      Specimen specimen = test::cabinet();
      specimen.friction.mu_s = specimen.friction.mu_k *= std::exp(0.1 * frictions.normal());
      test.motion = test::swings(2, 0.5);
      test.peaks.peak_slip_m = respond(specimen, test.shaking()).peak_slip_m;
      still += *test.peaks.peak_slip_m == 0;
    }
    rejected += !misfit_of(Bench(data, 0), 0.2).chance();
  }
  EXPECT_GT(still, 3 * sets);
  EXPECT_LT(still, 9 * sets);
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
}

// Twelve tests of one motion, and friction stated twice as large as it is: what repeats itself refutes it.
TEST(ChanceOfPeaks, RefutesAModelThatTellsLessThanAnotherTestDoes) {
  Dataset data = peaks_of(test::cabinet(), 0.05, 3);
  test::KeyedRandom random(55, 1);
  for (measurement::Test& test : data.tests) {
    test.motion = test::swings(5, 0.5);
    test.peaks.peak_slip_m = respond(test::cabinet(), test.shaking()).peak_slip_m * std::exp(0.05 * random.normal());
  }
  const Bench bench(data, 0);
  EXPECT_FALSE(misfit_of(bench, 0.4).chance());
  EXPECT_GT(misfit_of(bench, 0.2).p, 0.3);
  data.tests.resize(4);
  EXPECT_TRUE(misfit_of(Bench(data, 0), 0.4).chance()) << "2^-4";
}

// Friction stated ten times too large holds the model in every test, and no effect of those tried mends that: it was said that none is needed.
TEST(ChanceOfPeaks, AModelThatMissesEveryTestIsNotEnough) {
  const Dataset data = peaks_of(test::cabinet(), 0.1, 6);
  ModelSpec holds = test::free_friction();
  holds.model = Model::slide;
  holds.free.clear();
  holds.mu_k = {.value = 2};
  const Diagnosis d = diagnose(Bench(data, 0), holds, {effects::find("friction_wear")}, {}, run_here);
  EXPECT_EQ(d.verdict, Verdict::unknown);
  EXPECT_EQ(d.reason, Reason::none_helps);
  ASSERT_FALSE(d.sentences.empty());
  EXPECT_NE(d.sentences[0].find("misses the peaks of tests left out by 2.97 (ln), where one test misses another by"),
            std::string::npos)
      << d.sentences[0];
}

// The intervals and the band of another peak hold as often as they say: of 40 sets 90 % are 29 to 40 but for one run in a thousand.
TEST(PosteriorOfPeaks, HoldsTheTruthAndAnotherPeak) {
  const int sets = test::dear_repeats(20);
  int held = 0, held_another = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    Dataset data = peaks_of(test::cabinet(), 0.3, key);
    const double another = *data.tests.back().peaks.peak_slip_m;
    data.tests.back().role = Role::holdout;
    const Bench bench(data, 0);
    const ModelFit fit = fitted_to_peaks(bench, test::free_friction(), {0.2});
    const Posterior open = posterior(bench, fit, run_here);
    const Interval mu = open.interval(0, 0.9);
    held += mu.lower <= 0.2 && 0.2 <= mu.upper;
    const double model = predict(fit.model, data.tests.back(), fit.x).response.peak_slip_m;
    const double off = std::log(another / model) - open.slip_bias_ln;
    held_another += std::abs(off) <= 1.80 * open.slip_scatter_ln;  // Student's t of 11 tests less one number, 90 %
  }
  EXPECT_GE(held, test::likely_counts(sets, 0.9).least);
  EXPECT_GE(held_another, test::likely_counts(sets, 0.9).least);
}

}  // namespace
}  // namespace freestand::measurement
