// Sets of peaks: what a peak of zero is worth, to the score and to the fit.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/effects.hpp"
#include "measurement/examined.hpp"
#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/model_fit.hpp"
#include "measurement/fit/posterior.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/tell/findings.hpp"
#include "measurement/verdict/diagnose.hpp"
#include "support/keyed_random.hpp"

namespace freestand::measurement {
namespace {

constexpr double mu = 0.2;

Specimen sliding() { return test::sliding_cabinet(mu); }

// Peak slips of a block with that friction: three in which it slides, and two whose floor stays below mu g.
Dataset made_peaks() {
  Dataset data;
  for (const double peak : {6.0, 4.0, 3.0, 1.9, 1.5}) {
    measurement::Test test;
    test.id = std::string("t").append(std::to_string(data.tests.size() + 1));
    test.motion = test::swings(peak, 0.6);
    test.specimen = {0.8, 0.6, 100.0};
    test.peaks.peak_slip_m = respond(sliding(), test.shaking()).peak_slip_m;
    data.tests.push_back(std::move(test));
  }
  return data;
}

TestError error_at(const Bench& bench, std::size_t i, double friction) {
  ModelSpec model = test::free_friction();
  model.model = Model::slide;
  return test_error(bench, i, model, Values{friction});
}

// One peak and one number: nobody knows by what peaks scatter, and the number may be any. It was told to four digits.
TEST(Peaks, OneTestThatTellsLeavesANumberOpen) {
  Dataset data = made_peaks();
  data.tests.erase(data.tests.begin(), data.tests.begin() + 2);  // one slides, two stand
  const Bench bench(data, 0);
  ModelFit fit{.model = test::free_friction(), .x = {mu}, .score = 1e-9, .intervals = {{mu, mu}}};
  fit.model.model = Model::slide;
  widen_by_score(bench, {&fit}, run_here);
  EXPECT_EQ(fit.intervals[0].lower, fit.model.free[0].lower);
  EXPECT_EQ(fit.intervals[0].upper, fit.model.free[0].upper);
}

// Nothing moved: friction may be anything above what holds the block, and nothing below. It was told that the tests leave it open, and sweeps took the
// middle of the range.
TEST(Peaks, WhereAllStoodStillFrictionIsBoundFromBelow) {
  Dataset data = made_peaks();
  data.tests.erase(data.tests.begin(), data.tests.begin() + 3);  // 1.9 and 1.5 m/s2
  const Bench bench(data, 0);
  ModelFit fit{.model = test::free_friction(), .x = {0.4}, .score = 0, .intervals = {{0.4, 0.4}}};
  fit.model.model = Model::slide;
  const Posterior open = posterior(bench, fit, run_here);
  ASSERT_GT(open.draws.size(), 100U);
  const auto [least, most] = std::ranges::minmax(open.draws);
  EXPECT_NEAR(least[0], 1.9 / 9.80665, 0.002);
  EXPECT_NEAR(most[0], fit.model.free[0].upper, 0.01 * fit.model.free[0].upper);
  take_intervals(open, fit);
  EXPECT_TRUE(open_ends(fit, 0).above);
  EXPECT_FALSE(open_ends(fit, 0).below);
}

TEST(Peaks, NoErrorIsInNoiseUnitsWhereNoNoiseIsStated) {
  Dataset data = made_peaks();
  for (const bool fell : {true, false}) {
    data.tests[0].peaks.overturned = fell;
    EXPECT_TRUE(std::isnan(error_at(Bench(data, 0), 0, mu).noise_units)) << fell;
  }
  data.noise.slip_m = 1e-4;
  data.tests[0].peaks.overturned = true;  // the model only slides
  EXPECT_EQ(error_at(Bench(data, 0), 0, mu).noise_units, failed_error);
}

// A test that stands twice under two names is told of; tests that stood still are alike and are not.
TEST(Peaks, ACopyOfATestIsTold) {
  Dataset data = made_peaks();
  data.tests.push_back(data.tests[4]);
  data.tests.back().id = "still again";
  EXPECT_TRUE(doubts(Bench(data, 0)).sentences.empty());
  data.tests.push_back(data.tests[1]);
  data.tests.back().id = "copy";
  const auto told = doubts(Bench(data, 0)).sentences;
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("the peaks of copy are those of an earlier test"), std::string::npos) << told[0];
}

TEST(Peaks, StandingStillIsAHitAndSlidingAMiss) {
  const Dataset data = made_peaks();
  ASSERT_EQ(*data.tests[4].peaks.peak_slip_m, 0);
  const Bench bench(data, 0);
  EXPECT_DOUBLE_EQ(least_motion(bench, Channel::slip), 1e-3 * *data.tests[0].peaks.peak_slip_m);
  EXPECT_EQ(error_at(bench, 4, mu).score, 0);
  EXPECT_EQ(error_at(bench, 4, mu).relative, 0);
  EXPECT_EQ(error_at(bench, 4, 0.05).score, 9);  // the limit: 3^2
  EXPECT_EQ(error_at(bench, 4, 0.05).relative, 1);
  EXPECT_EQ(error_at(bench, 0, 1).score, 9);  // and the other way round
}

// A model that is right, a sensor that strays by 3 mm, and six slips of a few millimetres beside six large ones: another test lies beside the
// model by what the large ones show, and not by what noise makes of the small ones.
TEST(Peaks, NoiseIsNoDiscrepancy) {
  constexpr double noise_m = 0.003;
  for (std::uint64_t set = 0; set < 4; ++set) {
    test::KeyedRandom random(5, set);
    Dataset data;
    data.noise.slip_m = noise_m;
    for (const double peak : {2.2, 2.25, 2.3, 2.35, 2.4, 2.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
      measurement::Test test;
      test.id = std::string("t").append(std::to_string(data.tests.size() + 1));
      test.motion = test::swings(peak, 0.6);
      test.specimen = {0.8, 0.6, 100.0};
      test.peaks.peak_slip_m = std::abs(respond(sliding(), test.shaking()).peak_slip_m + noise_m * random.normal());
      data.tests.push_back(std::move(test));
    }
    const Bench bench(data, 0);
    ModelSpec model = test::free_friction();
    model.model = Model::slide;
    ModelFit fit{.model = model, .x = {mu}};
    const Posterior open = posterior(bench, fit, run_here);
    EXPECT_LT(open.slip_scatter_ln, 0.06) << set;
    EXPECT_NEAR(open.slip_bias_ln, 0, 0.06) << set;
  }
}

// The model without the effect misses these peaks by 7 % on the average, all by more than they are off with it.
TEST(Peaks, AnEffectThatMakesLittleIsFound) {
  Dataset data;
  Specimen truth = sliding();
  truth.friction.mu_s = 1.5 * mu;
  for (int i = 0; i < 14; ++i) {
    measurement::Test test;
    test.id = "t" + std::to_string(i + 1);
    test.motion = test::swings(3.2 + 0.35 * i, 0.3 + 0.05 * (i % 5));
    test.specimen = {0.8, 0.6, 100.0};
    test.peaks.peak_slip_m = respond(truth, test.shaking()).peak_slip_m;
    data.tests.push_back(std::move(test));
  }
  const Bench bench(data, 0);
  ModelSpec model = test::free_friction();
  model.model = Model::slide;
  const Diagnosis d =
      diagnose(bench, model, {effects::find("static_friction"), effects::find("viscous_drag")}, {}, run_here);
  EXPECT_LT(d.base.fit.score, 0.14 * 0.14);
  EXPECT_EQ(d.verdict, Verdict::missing) << testing::PrintToString(d.sentences);
  EXPECT_EQ(d.effects, std::vector<std::string>{"static_friction"});
}

// A test in which the specimen fell does not say what motion is: its peak may hold the fall.
TEST(Peaks, AFallDoesNotSayWhatMotionIs) {
  Dataset data = made_peaks();
  const double least = least_motion(Bench(data, 0), Channel::slip);
  data.tests[4].peaks.overturned = true;
  data.tests[4].peaks.peak_slip_m = 100;
  EXPECT_EQ(least_motion(Bench(data, 0), Channel::slip), least);
}

// What counts as motion is of the calibration tests: another test held out changes no score.
TEST(Peaks, ATestHeldOutDoesNotSayWhatMotionIs) {
  Dataset data = made_peaks();
  const double least = least_motion(Bench(data, 0), Channel::slip);
  data.tests.push_back(data.tests[0]);
  data.tests.back().role = Role::holdout;
  *data.tests.back().peaks.peak_slip_m *= 100;
  EXPECT_EQ(least_motion(Bench(data, 0), Channel::slip), least);
}

TEST(Peaks, BelowTheNoiseTheSizeOfAPeakSaysNothing) {
  Dataset data = made_peaks();
  data.noise.slip_m = 2e-3;
  data.tests[4].peaks.peak_slip_m = 1e-3;
  const Bench bench(data, 0);
  EXPECT_EQ(error_at(bench, 4, mu).score, 0);
  EXPECT_EQ(error_at(bench, 4, mu).noise_units, 0.5);
}

// A peak of little more than the noise that is off by one noise counts as one of any size that is off by the tenth that peaks scatter by.
TEST(Peaks, BesideTheNoiseSmallOnesWeighByIt) {
  for (const double stated : {0.0, 1.0}) {
    Dataset data = made_peaks();
    const double small = *data.tests[2].peaks.peak_slip_m, large = *data.tests[0].peaks.peak_slip_m, noise = small / 2;
    data.noise.slip_m = stated * noise;
    data.tests[2].peaks.peak_slip_m = small + noise;
    data.tests[0].peaks.peak_slip_m = large * 1.1;
    const Bench bench(data, 0);
    const double off = std::sqrt(error_at(bench, 2, mu).score), share = std::sqrt(error_at(bench, 0, mu).score);
    if (stated == 0) {
      EXPECT_NEAR(off, std::log(1.5), 1e-9);
      EXPECT_NEAR(share, std::log(1.1), 1e-9);
    } else {
      EXPECT_NEAR(off, 0.1, 0.005);
      EXPECT_LT(share, std::log(1.1));
      EXPECT_GT(share, 0.1 * std::log(1.1));
    }
  }
}

// A block that falls: its peak slip may hold the fall, or not, and only that it falls is compared.
TEST(Peaks, OfATestThatFellOnlyThatCounts) {
  Dataset data;
  ModelSpec model = test::free_friction();
  model.model = Model::slide_rock;
  for (const bool fell : {true, false}) {
    measurement::Test test;
    test.id = fell ? "fell" : "stood";
    test.motion = test::swings(9, 0.9);
    test.specimen = {0.3, 1.8, 100.0};
    test.peaks.peak_slip_m = 0.004;
    test.peaks.peak_rotation_rad = fell ? 1.57 : 0.02;
    test.peaks.overturned = fell;
    data.tests.push_back(std::move(test));
  }
  data.tests.push_back(data.tests[1]);
  data.tests.back().peaks.overturned = {};
  const Bench bench(data, 0);
  const auto error = [&](std::size_t i, double mu) { return test_error(bench, i, model, Values{mu}); };
  ASSERT_EQ(predict(model, bench.test(0), Values{0.9}).response.outcome, Outcome::overturned);
  ASSERT_NE(predict(model, bench.test(0), Values{0.1}).response.outcome, Outcome::overturned);
  EXPECT_EQ(error(0, 0.9).score, 0) << "both fall, whatever the peaks";
  EXPECT_EQ(error(0, 0.1).score, 9) << "the model stands";
  EXPECT_DOUBLE_EQ(error(1, 0.9).score, 9) << "only the model falls";
  EXPECT_LT(error(2, 0.9).score, 9) << "nobody says whether it fell: its peaks are all there is";
  EXPECT_GT(error(2, 0.9).score, 0);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(ln_ratios(bench, i, predict(model, bench.test(i), Values{0.9})).size(),
              ln_ratios(bench, i, predict(model, bench.test(i), Values{0.1})).size());
    EXPECT_FALSE(peaks_compare(bench.test(i), predict(model, bench.test(i), Values{0.9}).response));
  }
}

// Slips that remain to the wrong side are no hits, where the set says sides.
TEST(Peaks, ASlipThatRemainsHasASide) {
  Dataset data = made_peaks();
  for (std::size_t i = 0; i < 3; ++i) {
    data.tests[i].peaks.peak_slip_m.reset();
    data.tests[i].peaks.residual_slip_m = respond(sliding(), data.tests[i].shaking()).residual_slip_m;
  }
  const double remains = *data.tests[0].peaks.residual_slip_m;
  ASSERT_GT(std::abs(remains), 0.01);
  const auto score = [&](double first, double second) {
    data.tests[0].peaks.residual_slip_m = first;
    data.tests[1].peaks.residual_slip_m = second;
    return error_at(Bench(data, 0), 0, mu).score;
  };
  const double other = -std::abs(*data.tests[1].peaks.residual_slip_m);
  EXPECT_NEAR(score(remains, other), 0, 1e-12);
  EXPECT_EQ(score(-remains, other), 9);
  data.tests[2].peaks.residual_slip_m = std::abs(*data.tests[2].peaks.residual_slip_m);
  EXPECT_NEAR(score(std::abs(remains), -other), 0, 1e-12) << "sizes alone";
}

// Peaks with the slips that remain, all of the wrong sign: effects were named that turn sides. A floor that tilts is no such fault.
TEST(Peaks, SidesThatAreTurnedRoundAreNoEffect) {
  const auto verdict_on = [](const Specimen& of, double sign) {
    Dataset data;
    test::KeyedRandom random(56, 0);
    for (int i = 0; i < 8; ++i) {
      measurement::Test& test = data.tests.emplace_back();
      test.id = std::string("s").append(std::to_string(i));
      test.motion = test::swings((i % 2 ? -1 : 1) * (3 + 0.5 * i), 0.4 + 0.1 * (i % 5));
      test.specimen = {0.8, 0.6, 100.0};
      const Response r = respond(of, test.shaking());
      test.peaks.peak_slip_m = r.peak_slip_m * std::exp(0.05 * random.normal());
      test.peaks.residual_slip_m = sign * r.residual_slip_m * std::exp(0.05 * random.normal());
    }
    ModelSpec model = test::free_friction();
    model.model = Model::slide;
    const Diagnosis d = diagnose(Bench(data, 0), model, {effects::find("floor_tilt")}, {}, run_here);
    return std::pair(d.verdict, fmt::format("{}", fmt::join(d.quality.findings, "; ")));
  };
  const auto [plain, nothing] = verdict_on(sliding(), 1);
  EXPECT_EQ(plain, Verdict::none);
  const auto [turned, told] = verdict_on(sliding(), -1);
  EXPECT_EQ(turned, Verdict::bad_data);
  EXPECT_NE(told.find("residual_slip_m looks turned round: with the other sign 7 of 7 tests end on the model's side"),
            std::string::npos)
      << told;
  Specimen tilted = sliding();
  tilted.effects = {{.effect = effects::find("floor_tilt"), .parameters = {0.05}}};
  const auto [tilt, found] = verdict_on(tilted, 1);
  EXPECT_EQ(tilt, Verdict::missing) << found;
}

// Tests in which nothing moved bound the friction that the others leave open.
TEST(Peaks, AFitHeedsTheTestsThatStoodStill) {
  Dataset data = made_peaks();
  for (const std::size_t i : {0U, 1U, 2U}) data.tests[i].peaks.peak_slip_m = 0;
  data.tests[3].peaks.peak_slip_m = data.tests[4].peaks.peak_slip_m = 0;
  const Bench bench(data, 0);
  const auto tests = tests_of(data, Role::calibration);
  ModelSpec model = test::free_friction();
  model.model = Model::slide;
  EXPECT_GT(mean_score(bench, tests, model, Values{0.1}), 5);
  EXPECT_EQ(mean_score(bench, tests, model, Values{0.7}), 0);
}

}  // namespace
}  // namespace freestand::measurement
