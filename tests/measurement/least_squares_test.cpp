// The end of a fit: out of bent valleys, and by the covariance of the floor's noise.
#include "measurement/fit/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/tell/findings.hpp"

namespace freestand::measurement::least_squares_test {
namespace {

Specimen cabinet(double mu) {
  Specimen s;
  s.block = Block::rectangular(0.8, 0.6, 100);
  s.friction = {mu, mu};
  return s;
}

double normal(std::uint64_t seed, std::uint64_t i) {
  const auto [a, b] = random::bits(seed, i, 7);
  return std::sqrt(-2 * std::log(random::unit_interval(a))) * std::cos(2 * M_PI * random::unit_interval(b));
}

// What was measured of the floor differs from what it did.
void disturb_floor(Dataset& data, double noise_mps2, std::uint64_t seed) {
  data.noise.floor_acceleration_mps2 = noise_mps2;
  for (std::size_t t = 0; t < data.tests.size(); ++t) {
    FloorMotion& motion = data.tests[t].motion;
    std::vector<double> a;
    for (std::size_t i = 0; i <= motion.segments(); ++i)
      a.push_back(horizontal_acceleration({&motion, 1, 1, 1}, 0.005 * static_cast<double>(i)) +
                  noise_mps2 * normal(100 * seed + t, i));
    motion = piecewise_linear("disturbed", 0.005, a, {});
  }
}

// C^-1/2 r by its definition: G of the replays' covariance is what the judge's misfit says by Woodbury's identity.
TEST(Judge, WhitenedResidualsHaveTheMisfitAsTheirSquare) {
  Dataset data = test::made_dataset(cabinet(0.2));
  disturb_floor(data, 0.03, 1);
  const Bench bench(data, 8);
  const ModelFit fit{.model = test::free_friction(), .x = {0.21}};
  const Judge judge(bench, fit.model, fit.x, run_here), plain(bench);
  const auto misfit = judge.misfit_of_fit(fit), sensors_only = plain.misfit_of_fit(fit);
  for (std::size_t i = 0; i < misfit.size(); ++i) {
    const auto r = judge.whitened(i, predict(fit.model, judge.test(i), fit.x));
    EXPECT_NEAR(std::inner_product(r.begin(), r.end(), r.begin(), 0.0) / misfit[i], 1, 1e-9);
    EXPECT_LT(misfit[i], 0.9 * sensors_only[i]);
  }
}

// Of two replays, one by the covariance that the other alone makes: |r|^2 - (r.s)^2/(1 + |s|^2).
TEST(Judge, StraysAreWhatAReplayMissesTheOthersBy) {
  Dataset data = test::made_dataset(cabinet(0.2));
  disturb_floor(data, 0.03, 1);
  const Bench bench(data, 2);
  const ModelSpec model = test::free_friction();
  const Values x = {0.21};
  const Judge judge(bench, model, x, run_here);
  const auto tests = tests_of(data, Role::calibration);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const auto& test = data.tests[tests[i]];
    const Prediction nominal = predict(model, test, x);
    double product[2][2] = {};
    for (int c = 0; c < channel_count; ++c) {
      const auto channel = static_cast<Channel>(c);
      if (history(test, channel).empty()) continue;
      Values r[2];
      for (std::size_t k = 0; k < 2; ++k) r[k] = predict(model, test, x, &bench.replays(tests[i])[k]).channel(channel);
      for (std::size_t n = 0; n < r[0].size(); ++n)
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l)
            product[k][l] += (r[k][n] - nominal.channel(channel)[n]) * (r[l][n] - nominal.channel(channel)[n]) /
                             std::pow(bench.noise(channel), 2);
    }
    const auto misfit = [&](int k, int other) {
      return product[k][k] - product[k][other] * product[k][other] / (1 + product[other][other]);
    };
    EXPECT_NEAR(judge.strays()[i] / std::max(misfit(0, 1), misfit(1, 0)), 1, 1e-9);
  }
}

TEST(Judge, LeavesOutWhatTheFloorsNoiseHasFannedOut) {
  Dataset data = test::made_dataset(cabinet(0.2));
  disturb_floor(data, 0.03, 1);
  const Bench bench(data, 8);
  const ModelFit fit{.model = test::free_friction(), .x = {0.21}};
  const Judge judge(bench, fit.model, fit.x, run_here), strict(bench, fit.model, fit.x, run_here, 0.5);
  for (std::size_t i = 0; i < judge.samples().size(); ++i) {
    EXPECT_EQ(judge.samples()[i], 2 * 801);
    EXPECT_LT(strict.samples()[i], judge.samples()[i]);
    EXPECT_GT(strict.samples()[i], 801);  // the rotation is known as well as ever
    EXPECT_EQ(strict.whitened(i, predict(fit.model, strict.test(i), fit.x)).size(),
              static_cast<std::size_t>(strict.samples()[i]));
  }
}

// Three numbers of a tether that make up for each other, from a point of their valley.
TEST(LeastSquares, FollowsABentValleyToItsEnd) {
  Specimen truth = cabinet(0.15);
  const auto* tether = effects::find("slack_tether");
  truth.effects = {{.effect = tether, .parameters = {-0.004, 2.4, 0.2}}};
  const Dataset data = test::made_dataset(truth);
  const Bench bench(data, 0);
  const ModelSpec model = with_effect(test::free_friction(), *tether, bench.reach());
  const Judge judge(bench);
  const Fitted found = least_squares(judge, all_of(judge), model, {0.149, -0.0055, 2.65, 0.3}, 6);
  EXPECT_LT(found.score, 0.03);
  EXPECT_NEAR(found.x[0], 0.15, 5e-4);
  EXPECT_NEAR(found.x[1], -0.004, 3e-4);
  EXPECT_NEAR(found.x[2], 2.4, 0.02);
  EXPECT_LT(found.evaluations, 250);
}

TEST(LeastSquares, NeverEndsHigherThanItBeganAndStaysWithinBounds) {
  const Dataset data = test::made_dataset(cabinet(0.2));
  const Bench bench(data, 0);
  ModelSpec model = test::free_friction();
  model.free[0].lower = 0.22;
  const Judge judge(bench);
  for (const double mu : {0.22, 0.3, 1.1}) {
    const Fitted found = least_squares(judge, all_of(judge), model, {mu}, 4);
    EXPECT_LE(found.score, least_squares_score(judge, all_of(judge), model, Values{mu}));
    EXPECT_GE(found.x[0], 0.22);
  }
}

// The floor's noise moves slips by several times the sensors' noise, and friction that is fitted to the sensors' noise
// alone goes after it.
TEST(Settle, FrictionIsFoundCloserWhereTheFloorsNoiseIsWeighed) {
  double plain = 0, settled = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Dataset data = test::made_dataset(cabinet(0.2));
    disturb_floor(data, 0.03, seed);
    const Bench bench(data, 16);
    auto fits = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
    polish(bench, {&fits[0]}, Effort{}, 0.05, run_here);
    plain += std::pow(fits[0].x[0] - 0.2, 2);
    settle(bench, fits[0], Effort{}, run_here);
    settled += std::pow(fits[0].x[0] - 0.2, 2);
  }
  EXPECT_LT(settled, 0.5 * plain) << std::sqrt(plain / 6) << " " << std::sqrt(settled / 6);
}

// Candidates are judged by the misfit in which the floor's noise is allowed for, and chance_of_misfit() holds that against data
// that were fitted by it: a fit by the plain score misses by more, and its friction is further off, with a test left out too.
TEST(WeighFloorNoise, FitsAreThoseOfTheMisfitThatTheyAreJudgedBy) {
  double plain = 0, weighed = 0, plain_folds = 0, weighed_folds = 0, gain = 0;
  const auto off = [](const ModelFit& fit) { return std::pow(fit.x[0] - 0.2, 2); };
  const auto off_in_folds = [](const ModelFit& fit) {
    double sum = 0;
    for (const Values& x : fit.fold_x) sum += std::pow(x[0] - 0.2, 2);
    return sum;
  };
  const auto total_of = [](const std::vector<double>& of_tests) {
    return std::accumulate(of_tests.begin(), of_tests.end(), 0.0);
  };
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Dataset data = test::made_dataset(cabinet(0.2));
    disturb_floor(data, 0.03, seed);
    const Bench bench(data, 16);
    auto fits = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
    polish(bench, {&fits[0]}, Effort{}, 0.05, run_here);
    leave_out(bench, {&fits[0]}, Effort{}, run_here);
    const Judge judge(bench, fits[0].model, fits[0].x, run_here);
    plain += off(fits[0]);
    plain_folds += off_in_folds(fits[0]);
    const double before = total_of(judge.misfit_of_fit(fits[0]));
    weigh_floor_noise(bench, judge, {&fits[0]}, run_here);
    weighed += off(fits[0]);
    weighed_folds += off_in_folds(fits[0]);
    const double after = total_of(judge.misfit_of_fit(fits[0]));
    EXPECT_LE(after, before);
    gain += before - after;
    EXPECT_EQ(fits[0].score, mean_score(bench, tests_of(data, Role::calibration), fits[0].model, fits[0].x));
  }
  EXPECT_LT(weighed, 0.5 * plain) << std::sqrt(plain / 6) << " " << std::sqrt(weighed / 6);
  EXPECT_LT(weighed_folds, 0.5 * plain_folds);
  EXPECT_GT(gain, 6 * 3.84);  // what one number gains by chance in one set of twenty, in each
}

TEST(WeighFloorNoise, AFitThatIsFarFromTheNoiseStaysWhereItIs) {
  Specimen truth = cabinet(0.2);
  truth.friction.mu_s = 0.4;
  const Dataset data = test::made_dataset(truth);
  const Bench bench(data, 8);
  auto fits = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
  leave_out(bench, {&fits[0]}, Effort{}, run_here);
  const ModelFit before = fits[0];
  weigh_floor_noise(bench, Judge(bench, before.model, before.x, run_here), {&fits[0]}, run_here);
  EXPECT_EQ(fits[0].x, before.x);
  EXPECT_EQ(fits[0].fold_x, before.fold_x);
  EXPECT_EQ(fits[0].score, before.score);
}

// A block that only rocks says of friction no more than that it is enough.
TEST(Settle, ANumberThatNoTestDeterminesHasAWideInterval) {
  Specimen slender;
  slender.block = Block::rectangular(0.4, 1.6, 100);
  slender.friction = {0.7, 0.7};
  Dataset data = test::made_dataset(slender);
  for (std::size_t i = 0; i < data.tests.size(); ++i)
    data.tests[i] = test::made_test(std::string("t").append(std::to_string(i)), slender,
                                    test::swings(2.6 + 0.1 * static_cast<double>(i), 0.5), i);
  const Bench bench(data, 8);
  ModelFit fit{.model = test::free_friction(), .x = {0.6}};
  settle(bench, fit, Effort{}, run_here);
  ASSERT_EQ(fit.intervals.size(), 1U);
  EXPECT_LT(fit.intervals[0].lower, 0.6);
  EXPECT_GT(fit.intervals[0].lower, 0.2);  // there it slides
  EXPECT_DOUBLE_EQ(fit.intervals[0].upper, 1.2);
  const auto open = undetermined(fit);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_NE(open[0].find("from below only"), std::string::npos) << open[0];
}

// The same where the model is far from the measurements: no slip depends on the mass.
TEST(Settle, NorDoesAWrongModelKnowWhatNoTestShows) {
  Specimen truth = cabinet(0.2);
  truth.friction.mu_s = 0.4;
  const Dataset data = test::made_dataset(truth);
  const Bench bench(data, 8);
  ModelFit fit{.model = test::free_friction(), .x = {0.21, 150}};
  fit.model.mass = Number{.free = 1};
  fit.model.free.push_back({.name = "block.mass_kg", .lower = 10, .upper = 1000, .low = 10, .high = 1000});
  settle(bench, fit, Effort{}, run_here);
  ASSERT_EQ(fit.intervals.size(), 2U);
  EXPECT_DOUBLE_EQ(fit.intervals[1].lower, 10);
  EXPECT_DOUBLE_EQ(fit.intervals[1].upper, 1000);
  EXPECT_GT(fit.intervals[0].lower, 0.05);
  EXPECT_LT(fit.intervals[0].upper, 0.8);
  const auto open = undetermined(fit);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_NE(open[0].find("block.mass_kg"), std::string::npos);
}

// Where every refit with tests left out stays where it began, the jackknife has no width. 0.05: as for one test's error.
TEST(Settle, AnIntervalIsNoPointWhateverTheRefitsDid) {
  const Dataset data = test::made_dataset(cabinet(0.2));
  const Bench bench(data, 0);
  ModelFit fit{.model = test::free_friction(), .x = {0.2}};
  fit.intervals = {{0.2, 0.2}};
  widen_by_score(bench, {&fit}, run_here);
  const auto tests = tests_of(data, Role::calibration);
  const auto rise = [&](double mu) {
    const double at[] = {mu}, here[] = {0.2};
    return 4 * (mean_score(bench, tests, fit.model, at) - mean_score(bench, tests, fit.model, here));
  };
  ASSERT_EQ(tests.size(), 4U);
  for (const double end : {fit.intervals[0].lower, fit.intervals[0].upper}) {
    EXPECT_GT(std::abs(end - 0.2), 1e-6);
    EXPECT_LE(rise(end), 0.05);
    EXPECT_GT(rise(0.2 + 2 * (end - 0.2)), 0.05);
  }
}

// A model that misses more than the floor's noise explains is fitted by what it misses.
TEST(Settle, AWrongModelDoesNotHideBehindTheFloorsNoise) {
  Specimen truth = cabinet(0.2);
  truth.friction.mu_s = 0.4;
  const Dataset data = test::made_dataset(truth);
  const Bench bench(data, 8);
  auto fits = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
  const double before = fits[0].score;
  settle(bench, fits[0], Effort{}, run_here);
  EXPECT_GT(before, 1);
  EXPECT_LE(fits[0].score, before);
  EXPECT_TRUE(fits[0].left_out_refitted);
  EXPECT_EQ(fits[0].intervals.size(), 1U);
}

}  // namespace
}  // namespace freestand::measurement::least_squares_test
