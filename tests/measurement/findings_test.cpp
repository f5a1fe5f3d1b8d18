// What compare says in plain sentences, of sets whose answer is known.
#include "measurement/tell/findings.hpp"

#include <gmock/gmock.h>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/tell/compare.hpp"

namespace freestand::measurement {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// Twice as high as wide: it rocks where mu > 0.5.
Specimen tall(double mu, Model model = Model::slide_rock) {
  Specimen s;
  s.block = Block::rectangular(0.5, 1.0, 100);
  s.friction = {mu, mu};
  s.model = model;
  return s;
}

ModelSpec fixed(double mu, Model kind = Model::slide_rock) {
  ModelSpec model;
  model.mu_k.value = mu;
  model.model = kind;
  return model;
}

std::vector<std::string> said(const Dataset& data, const ModelSpec& model, const Quality& quality = {}) {
  const Bench bench(data, 4);
  std::vector<TestComparison> tests;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const Prediction p = predict(model, bench.test(i), {});
    tests.push_back(compare_test(bench, i, model, {}, bench.spread(model, i, {}, p)));
  }
  return compare(bench, model, {}, std::move(tests), quality).findings;
}

// Each test slides with a friction of its own: told beside what one friction leaves, and no effect is asked for.
TEST(Findings, FrictionThatDiffersFromTestToTestIsNoEffect) {
  Dataset data = test::made_dataset(tall(0.2));
  const double factors[] = {1.05, 0.93, 1.1, 0.98};
  data.tests.resize(4);
  for (std::size_t i = 0; i < 4; ++i)
    data.tests[i] = test::made_test(data.tests[i].id, tall(0.2 * factors[i]),
                                    test::swings(5 + static_cast<double>(i), 0.5, 0.005), i + 1, 0.005);
  const Bench bench(data, 4);
  const ModelSpec model = fixed(0.2);
  std::vector<TestComparison> tests;
  for (std::size_t i = 0; i < 4; ++i) {
    const Prediction p = predict(model, bench.test(i), {});
    tests.push_back(compare_test(bench, i, model, {}, bench.spread(model, i, {}, p)));
    EXPECT_GT(tests[i].explained, 2) << i;
    give_own_friction(bench, model, {}, 0.07, 3, tests[i]);
    EXPECT_NEAR(*tests[i].own_friction, factors[i], 0.005) << i;
    EXPECT_NEAR(tests[i].explained, 1, 0.1) << i;
  }
  const auto all = compare(bench, model, {}, std::move(tests), {}).findings;
  EXPECT_THAT(all, Contains(HasSubstr("with a friction of its own in each test, 0.93 to 1.1 times that of all")));
  EXPECT_THAT(all, Not(Contains(HasSubstr("diagnose asks what is missing"))));
}

// A test of which only its peaks are known, computed with that specimen.
Test of_peaks(const Specimen& specimen, double peak_mps2, double period_s) {
  Test test;
  test.id = "p";
  test.motion = test::swings(peak_mps2, period_s);
  test.specimen = {2 * specimen.block.left_m, 2 * specimen.block.height_m, 100.0};
  const Response r = respond(specimen, test.shaking());
  test.peaks.peak_slip_m = r.peak_slip_m;
  test.peaks.peak_rotation_rad = r.peak_rotation_rad;
  return test;
}

TEST(Findings, AModelThatMovesAsTheSpecimenDoes) {
  for (const double mu : {0.2, 0.9})
    for (const auto& sentence : said(test::made_dataset(tall(mu)), fixed(mu)))
      EXPECT_THAT(sentence, Not(testing::ContainsRegex("model (stands|slides|rocks|does)"))) << mu;
}

TEST(Findings, AModelThatSlidesWhereTheSpecimenRocks) {
  const auto sentences = said(test::made_dataset(tall(0.9)), fixed(0.2));
  EXPECT_THAT(sentences,
              Contains("the model does not rotate in 3 of 3 tests in which the specimen rocks (t1, t3, "
                       "t5): mu (0.200) is not above width/height (0.500), where a block slides rather than rocks"));
  EXPECT_THAT(sentences, Contains(HasSubstr("the model slides in 5 of 5 tests in which the specimen does not")));
}

TEST(Findings, AModelThatRocksWhereTheSpecimenSlides) {
  const auto sentences = said(test::made_dataset(tall(0.2)), fixed(0.9));
  EXPECT_THAT(sentences, Contains(HasSubstr("the model does not slide in")));
  EXPECT_THAT(sentences, Contains(HasSubstr("where a block rocks rather than slides")));
  EXPECT_THAT(sentences, Contains(HasSubstr("the model rocks in")));
}

TEST(Findings, OfPeaksAlone) {
  Dataset data;
  data.tests = {of_peaks(tall(0.9), 8, 0.6)};
  ASSERT_GT(*data.tests[0].peaks.peak_slip_m, 0);  // of the midpoint of the base, to and fro
  EXPECT_THAT(
      said(data, fixed(0.2, Model::slide)),
      testing::IsSupersetOf({"the model does not rotate in 1 of 1 tests in which the specimen rocks (p): \"model: "
                             "slide\" knows no rotation, slide_rock and rock do",
                             "the model slides in 1 of 1 tests in which the specimen does not (p): mu (0.200) is "
                             "not above width/height (0.500), where a block slides rather than rocks"}));
  data.tests = {of_peaks(tall(0.2), 8, 0.6)};
  EXPECT_THAT(said(data, fixed(1.5, Model::slide)),
              Contains("the model stands still in 1 of 1 tests in which the specimen moves (p): the floor must exceed "
                       "1.50 g to move it"));
}

TEST(Findings, OverturningOfTestsWithPeaks) {
  Dataset data;
  data.tests = {of_peaks(tall(0.9), 8, 0.6), of_peaks(tall(0.9), 8, 0.6)};
  for (auto& made : data.tests) made.peaks.overturned = false;
  const auto overturns = HasSubstr("overturn");
  EXPECT_THAT(said(data, fixed(0.9)), Not(Contains(overturns)));
  data.tests[1].motion = test::swings(30, 1.5);
  EXPECT_THAT(said(data, fixed(0.9)),
              Contains(HasSubstr("the model overturns in 1 of 2 tests in which the specimen stays on its base (p)")));
  data.tests[0].peaks.overturned = data.tests[1].peaks.overturned = true;
  EXPECT_THAT(said(data, fixed(0.9)),
              Contains(HasSubstr("the model stays on its base in 1 of 2 tests in which the specimen overturns (p)")));
}

TEST(Findings, AModelThatOnlySlidesAgainstOverturning) {
  Dataset data;
  data.tests = {of_peaks(tall(0.9), 8, 0.6), of_peaks(tall(0.9), 8, 0.6)};
  for (auto& made : data.tests) made.peaks = {};
  data.tests[0].peaks.overturned = true;
  data.tests[1].peaks.overturned = false;
  EXPECT_THAT(said(data, fixed(0.2, Model::slide)), Contains(HasSubstr("does not rotate in 1 of 1 tests")));
  EXPECT_THAT(said(data, fixed(0.2, Model::slide)), Not(Contains(HasSubstr("from one side only"))));
  data.tests[0].peaks.overturned = false;
  EXPECT_THAT(said(data, fixed(0.2, Model::slide)),
              Contains("all 2 calibration tests stood: they bound the model from one side only, and one that never "
                       "overturns misses none of them; add tests that overturned"));
}

// Five calibration tests that end too far to one side are what chance does once in 16: with a sixth, whatever its role,
// once in 32.
TEST(Findings, ABiasOfDirectionIsMoreThanChance) {
  Dataset data = test::made_dataset(tall(0.2));
  data.tests.push_back(test::made_test("t6", tall(0.2), test::swings(6, 0.7), 6));
  data.tests.back().role = Role::holdout;
  const auto drift = [](auto& made, double end) {
    const auto n = static_cast<double>(made.slip_m.size());
    for (std::size_t k = 0; k < made.slip_m.size(); ++k) made.slip_m[k] += end * static_cast<double>(k) / n;
  };
  for (std::size_t i = 0; i < 5; ++i) drift(data.tests[i], 0.02);
  EXPECT_THAT(said(data, fixed(0.2)), Not(Contains(HasSubstr("bias of direction"))));
  drift(data.tests[5], 0.02);
  EXPECT_THAT(
      said(data, fixed(0.2)),
      Contains(HasSubstr("in 6 of 6 tests whose end is missed the block ends further to the right than the model "
                         "(by chance: p = 0.031")));
  drift(data.tests[5], -0.04);
  EXPECT_THAT(said(data, fixed(0.2)), Not(Contains(HasSubstr("bias of direction"))));
}

TEST(Findings, NothingIsLeftOnlyWhereSomethingWasThere) {
  const std::string praise = "nothing is left to explain";
  Dataset data = test::made_dataset(tall(0.2));
  EXPECT_THAT(said(data, fixed(0.2)), Contains(HasSubstr(praise)));
  data.noise.slip_m = data.noise.rotation_rad = 0.5;
  EXPECT_THAT(said(data, fixed(0.2)), Not(Contains(HasSubstr(praise))));
  EXPECT_THAT(said(data, fixed(0.2)), Contains(HasSubstr("nothing was measured above the noise")));
  data = test::made_dataset(tall(0.2));
  for (std::size_t i = 1; i < data.tests.size(); ++i) data.tests[i].role = Role::holdout;
  ModelSpec model = fixed(0.2);
  model.free.resize(4, {.name = "number", .unit = "1", .lower = 0, .upper = 1});
  const auto sentences = said(data, model);
  EXPECT_THAT(sentences, Contains(HasSubstr("as 4 numbers fitted to 1 tests may bring about with any model")));
  EXPECT_THAT(sentences, Contains(testing::AllOf(HasSubstr("held-out"), HasSubstr(praise))));
}

// Half a noise unit that goes on from sample to sample raises the error by an eighth, which the size of the noise hides.
TEST(Findings, NoPraiseBesideAnErrorThatGoesOn) {
  Dataset data = test::made_dataset(tall(0.2));
  for (auto& made : data.tests)
    for (std::size_t k = 0; k < made.slip_m.size(); ++k)
      made.slip_m[k] += 0.7 * test::slip_noise_m * std::sin(0.02 * static_cast<double>(k));
  const auto sentences = said(data, fixed(0.2));
  EXPECT_THAT(sentences, Not(Contains(HasSubstr("nothing is left to explain"))));
  EXPECT_THAT(sentences, Contains(HasSubstr("little is left to explain, but in 4 of 8 residuals the error goes on from "
                                            "sample to sample as noise does not: diagnose asks")));
}

TEST(Findings, ErrorsAreToldInUnitsOfTheirChannels) {
  Dataset data = test::made_dataset(tall(0.2));
  for (auto& made : data.tests) {
    for (double& s : made.slip_m) s += 0.012;
    for (double& s : made.rotation_rad) s += 0.0045;
  }
  EXPECT_THAT(said(data, fixed(0.2)), Contains(testing::AllOf(HasSubstr("calibration tests are missed by"),
                                                              HasSubstr("slip by 12.0 mm, rotation by 4.52 mrad"),
                                                              HasSubstr(": diagnose asks what is missing"))));
}

// Where slip was not measured, nothing is said of it.
TEST(Findings, OfRotationAlone) {
  Dataset data = test::made_dataset(tall(0.9));
  for (auto& made : data.tests) made.slip_m.clear();
  EXPECT_THAT(said(data, fixed(0.9)), Contains(HasSubstr("nothing is left to explain")));
  for (const auto& sentence : said(data, fixed(0.2))) EXPECT_THAT(sentence, Not(HasSubstr("the slip")));
  EXPECT_THAT(said(data, fixed(0.2)), Contains(testing::ContainsRegex("missed by .*; rotation by [0-9.]+ mrad")));
  EXPECT_THAT(said(data, fixed(0.2)), Contains(HasSubstr("the model does not rotate in 3 of 3 tests")));
  data.noise.slip_m = 0;
  for (const double mu : {0.2, 0.3, 0.6})
    for (const auto& sentence : said(data, fixed(mu)))
      EXPECT_THAT(sentence, Not(testing::AnyOf(HasSubstr("the slip"), HasSubstr("nan")))) << mu;
}

// Long rocking near the edge: a little more noise on the floor, and it takes another way.
TEST(Findings, WhatTheFloorsNoiseDrownsCannotBeJudged) {
  Dataset data;
  data.noise = {.slip_m = test::slip_noise_m, .rotation_rad = test::rotation_noise_rad, .floor_acceleration_mps2 = 1};
  data.tests = {test::made_test("t1", tall(0.9), test::swings(8, 0.8), 1)};
  auto sentences = said(data, fixed(0.9));
  EXPECT_THAT(sentences, Contains(HasSubstr("so that they cannot be judged")));
  EXPECT_THAT(sentences, Not(Contains(HasSubstr("nothing is left"))));
  data.tests[0] = test::made_test("t1", tall(0.2), test::swings(8, 0.8), 1);
  EXPECT_THAT(said(data, fixed(0.9)), Not(Contains(HasSubstr("the model rocks"))));
  data.tests.push_back(test::made_test("t2", tall(0.9), test::swings(0.1, 0.8), 2));
  sentences = said(data, fixed(0.9));
  EXPECT_THAT(sentences, Contains(HasSubstr("without those in which that noise fans out, by ")));
}

TEST(Findings, TheWorstTestIsMeasuredByAChannelThatMoves) {
  Dataset data = test::made_dataset(tall(0.9));
  for (auto& made : data.tests) made.slip_m.assign(made.slip_m.size(), 1e-4);
  EXPECT_THAT(said(data, fixed(0.2)),
              Contains(HasSubstr("the worst test is t4 with 359 noise units, where nothing was")));
  data.tests = {data.tests[0], data.tests[2], data.tests[4]};  // those that rock
  EXPECT_THAT(said(data, fixed(0.2)),
              Contains(testing::MatchesRegex("the worst test is t[0-9] with [0-9]+ noise units: "
                                             "its rotation is missed by [0-9.]+ mrad, [0-9]+ % of the .*")));
  // A channel whose noise nobody states is missed by no noise units.
  for (auto& made : data.tests) made.block_acceleration_mps2.assign(made.slip_m.size(), 0.5);
  EXPECT_THAT(said(data, fixed(0.2)), testing::Not(Contains(HasSubstr("nan"))));
}

TEST(Findings, CappedErrorsAreAtLeastThat) {
  Dataset data = test::made_dataset(tall(0.2));
  for (double& s : data.tests[0].slip_m) s *= 1e6;
  const auto sentences = said(data, fixed(0.2));
  EXPECT_THAT(sentences, Contains(HasSubstr("calibration tests are missed by at least 5000 noise units")));
  EXPECT_THAT(sentences, Contains(HasSubstr("the worst test is t1 with at least 1e+04 noise units")));
}

TEST(Findings, OneSentenceInPlainWordsSaysWhereItFails) {
  for (const double mu : {0.1, 0.3}) {
    int said_where = 0;
    for (const auto& sentence : said(test::made_dataset(tall(0.2)), fixed(mu))) {
      if (sentence.find("wrong mostly ") == 0) {
        ++said_where;
        EXPECT_THAT(sentence,
                    testing::ContainsRegex("there the error of the slip changes by [0-9.]+ mm in 0.1 s, [0-9.]+ "
                                           "mm on the average \\([0-9.]+ and [0-9.]+ noise units\\)"));
      }
      EXPECT_THAT(sentence, Not(testing::ContainsRegex("[a-z]+_(mps|m|s|g)[^a-z]"))) << mu;
    }
    EXPECT_EQ(said_where, 1) << mu;
  }
}

// A floor that was read seldom: what it did between its readings is as large as the error, and no effect is asked for.
TEST(Findings, WhatTheFloorDidBetweenItsReadingsAsksForNoEffect) {
  const Dataset data = test::with_noise(test::made_dataset(test::cabinet(), 0), 1);
  const Bench bench(data, 2);
  const ModelSpec model = fixed(0.205);
  for (const double seldom : {0.0, 1.0}) {
    std::vector<TestComparison> tests;
    for (std::size_t i = 0; i < bench.size(); ++i) {
      const Prediction p = predict(model, bench.test(i), {});
      const double error = compare_test(bench, i, model, {}, bench.spread(model, i, {}, p)).error.noise_units;
      EXPECT_GT(error, 3);
      Spread unread(channel_count);
      for (int c = 0; c < channel_count; ++c)
        unread[static_cast<std::size_t>(c)].assign(history(bench.test(i), static_cast<Channel>(c)).size(),
                                                   std::pow(seldom * error * bench.noise(static_cast<Channel>(c)), 2));
      tests.push_back(compare_test(bench, i, model, {}, bench.spread(model, i, {}, p), unread));
      EXPECT_NEAR(tests.back().unread, seldom * error, 1e-9 * error);
    }
    const std::vector<std::string> found = compare(bench, model, {}, std::move(tests), {}).findings;
    const char *asks = "diagnose asks what is missing",
               *between = "what the floor did between its readings may be all that is left";
    EXPECT_THAT(found, Contains(HasSubstr(seldom == 0 ? asks : between)));
    EXPECT_THAT(found, Not(Contains(HasSubstr(seldom == 0 ? between : asks))));
  }
}

// The largest of many readings is larger than the slip: a model that is right is not told to resist too much.
TEST(Findings, PeaksOfATrueModelAreNeitherHighNorLow) {
  const Dataset clean = test::made_dataset(test::cabinet(), 0);
  double sum = 0, square = 0;
  constexpr int sets = 20;
  for (std::uint64_t key = 0; key < sets; ++key) {
    const Dataset data = test::with_noise(clean, key);
    const Bench bench(data, 2);
    std::vector<TestComparison> tests;
    for (std::size_t i = 0; i < bench.size(); ++i) {
      const ModelSpec model = fixed(0.2);
      tests.push_back(compare_test(bench, i, model, {}, bench.spread(model, i, {}, predict(model, bench.test(i), {}))));
    }
    const PeakRatio ratio = peak_ratio(bench, tests);
    ASSERT_EQ(ratio.count, 5U);
    const double z = ratio.bias_ln / (ratio.noise_ln / std::sqrt(5.0));
    sum += z / sets, square += z * z / sets;
    EXPECT_THAT(said(data, fixed(0.2)), Not(Contains(HasSubstr("peak slip")))) << key;
  }
  EXPECT_LT(std::abs(sum), 2.5 / std::sqrt(double(sets)));
  EXPECT_NEAR(square, 1, 0.8);
}

// Seven peaks whose logarithms lie 0.1 beside 1/0.83, to and fro: the mean of seven with scatter 0.4.
TEST(Findings, ABiasOfPeaksIsAsSureAsItsInterval) {
  Dataset data;
  const double mean = std::log(0.83), scatter[] = {-0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6};  // sd 0.432
  for (const double ln : scatter) {
    data.tests.push_back(of_peaks(tall(0.2), 6 + ln, 0.6));
    data.tests.back().peaks.peak_rotation_rad = {};
    *data.tests.back().peaks.peak_slip_m *= std::exp(-mean - ln);
  }
  // t(6, 0.975) = 2.447: 0.83 exp(+-2.447 * 0.432/sqrt(7))
  EXPECT_THAT(
      said(data, fixed(0.2)),
      Contains(HasSubstr("predicted peak slips are 0.83 times the measured ones (geometric mean of 7 tests; 95 % "
                         "between 0.56 and 1.24): right in the mean, as far as these tests show, but they "
                         "scatter by a factor of 1.54 from test to test")));
  for (auto& made : data.tests) *made.peaks.peak_slip_m *= 2;
  EXPECT_THAT(
      said(data, fixed(0.2)),
      Contains(HasSubstr(
          "underpredicts the peak slip: predicted ones are 0.42 times the measured ones (geometric mean "
          "of 7 tests; 95 % between 0.28 and 0.62) and scatter by a factor of 1.54; its resistance is too high")));
  // An eighth in which the specimen moved under too weak a floor for the model has no ratio, which is said.
  data.tests.push_back(of_peaks(tall(0.2), 6, 0.6));
  data.tests.back().peaks.peak_rotation_rad = {};
  data.tests.back().scale = 0.1;
  EXPECT_THAT(said(data, fixed(0.2)),
              Contains(HasSubstr("(geometric mean of 7 tests without 1 in which the model stands still; 95 % ")));
}

// Intervals of 95 % of a range of [0, 1]: flat draws die out nowhere; those of a normal density, cut where it is down to a twentieth, do.
TEST(Findings, ANumberIsOpenWhereItsDrawsDoNotDieOut) {
  ModelFit fit;
  fit.x = {0.5};
  fit.model.free = {{.name = "n", .lower = 0, .upper = 1, .low = 0, .high = 1}};
  const auto ends = [&](double lower, double upper) {
    fit.intervals = {{lower, upper}};
    const OpenEnds open = open_ends(fit, 0);
    return std::pair(open.below, open.above);
  };
  EXPECT_EQ(ends(0.025, 0.975), std::pair(true, true));                  // flat
  EXPECT_EQ(ends(0.6 + 0.01, 1 - 0.01), std::pair(false, true));         // flat from 0.6 on
  EXPECT_EQ(ends(0.01, 0.39), std::pair(true, false));                   // flat up to 0.4
  EXPECT_EQ(ends(0, 0.3), std::pair(true, false));                       // held at the bound
  EXPECT_EQ(ends(0.9 - 0.0787, 0.9 + 0.0683), std::pair(false, false));  // mean 0.9, standard deviation 0.04, cut at 1
  fit.intervals = {{0.61, 0.99}};
  EXPECT_THAT(undetermined(fit), testing::ElementsAre(HasSubstr("the tests bound n from below only, at 0.61")));
}

// Draws of a number that the tests leave open end at its bounds, and are swept.
TEST(Findings, FittedNumbersOfEffectsHaveBounds) {
  for (const dynamics::Effect& effect : effects::all()) {
    const ModelSpec model = with_effect(fixed(0.2), effect, {});
    for (const Free& free : model.free) {
      EXPECT_TRUE(std::isfinite(free.lower) && std::isfinite(free.upper)) << free.name;
      EXPECT_LT(free.lower, free.low + 1e-12) << free.name;
      EXPECT_GT(free.upper, free.high - 1e-12) << free.name;
    }
  }
}

// Draws of the scatter of placements are even in it beforehand: an interval of nearly all that is allowed bounds it from nowhere, though
// its lower end is far from the range's in logarithms.
TEST(Findings, TheScatterOfPlacementsIsBoundByWhatDrawsBeginWith) {
  ModelFit fit{.model = test::free_friction(), .x = {0.2, 0.01}};
  fit.model.free.push_back({.name = "placement_scatter", .lower = 0.001, .upper = 0.5, .low = 0.001, .high = 0.5});
  fit.model.placement_scatter = Number{.free = 1};
  fit.intervals = {{0.19, 0.21}, {0.0077, 0.490}};
  EXPECT_TRUE(open_ends(fit, 1).below);
  EXPECT_TRUE(open_ends(fit, 1).above);
  fit.intervals[1] = {0.1, 0.490};
  EXPECT_FALSE(open_ends(fit, 1).below);
}

}  // namespace
}  // namespace freestand::measurement
