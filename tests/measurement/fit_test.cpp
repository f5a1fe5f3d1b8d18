// Fits: minimisers on known functions, folds, scores in closed form, numbers that are found again.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measurement/fit/model_fit.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/noise/third_differences.hpp"
#include "measurement/search.hpp"
#include "support/keyed_random.hpp"

namespace freestand::measurement {
namespace {

Specimen cabinet(double mu) {
  Specimen s;
  s.block = Block::rectangular(0.8, 0.6, 100);
  s.friction = {mu, mu};
  return s;
}

TEST(Simplex, FindsTheLeastOfABananaWithinItsBounds) {
  const std::vector<Free> free = {{.name = "x", .unit = "1", .lower = -2, .upper = 2, .low = -2, .high = 2},
                                  {.name = "y", .unit = "1", .lower = -2, .upper = 3, .low = -2, .high = 3}};
  const Objective banana = [](std::span<const double> x) {
    return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
  };
  const Fitted found = simplex(free, banana, {-1.2, 1}, 0.1, 1200);
  EXPECT_NEAR(found.x[0], 1, 0.05);
  EXPECT_LE(found.evaluations, 1201);
  const Objective slope = [](std::span<const double> x) { return x[0] + x[1]; };
  const Fitted corner = simplex(free, slope, {0, 0}, 0.1, 400);
  EXPECT_NEAR(corner.x[0] + corner.x[1], -4, 0.02);
  EXPECT_GE(corner.x[0], -2);
}

TEST(Sobol, StartsLieWithinTheRangeAndFillIt) {
  const auto free = test::free_friction().free;
  const auto points = sobol_starts(free, 64);
  double least = 9, most = 0;
  for (const Values& x : points) {
    ASSERT_GE(x[0], 0.03);
    ASSERT_LE(x[0], 1.2);
    least = std::min(least, x[0]), most = std::max(most, x[0]);
  }
  EXPECT_LT(least, 0.035);
  EXPECT_GT(most, 1.0);
}

TEST(Folds, EveryTestOnceAlone) {
  EXPECT_EQ(fold_of(4), (std::vector<std::size_t>{0, 1, 2, 3}));
  const auto many = fold_of(25);
  EXPECT_EQ(*std::max_element(many.begin(), many.end()), 9U);
}

// Peaks that scatter by some percent leave friction some percent of room: the fits with one left out must differ.
TEST(LeaveOut, PeaksThatScatterGiveAnIntervalWithWidth) {
  Dataset data = test::made_dataset(cabinet(0.2));
  const double scatter[] = {1.06, 0.95, 1.03, 0.96, 1.0};
  for (std::size_t i = 0; i < data.tests.size(); ++i) {
    measurement::Test& t = data.tests[i];
    t.peaks.peak_slip_m = scatter[i] * respond(cabinet(0.2), t.shaking()).peak_slip_m;
    t.slip_m.clear(), t.rotation_rad.clear(), t.block_acceleration_mps2.clear();
  }
  const Bench bench(data, 0);
  auto fits = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
  leave_out(bench, {&fits[0]}, Effort{}, run_here);
  ASSERT_EQ(fits[0].intervals.size(), 1U);
  EXPECT_NEAR(fits[0].x[0], 0.2, 0.02);
  EXPECT_LT(fits[0].intervals[0].lower, 0.995 * fits[0].x[0]);
  EXPECT_GT(fits[0].intervals[0].upper, 1.005 * fits[0].x[0]);
}

// A history that is off by three times the noise everywhere, on one of two channels that are otherwise exact.
TEST(Score, IsTheRootMeanSquareInNoiseUnits) {
  Dataset data = test::made_dataset(cabinet(0.2));
  const Bench bench(data, 0);
  const ModelSpec model = test::free_friction();
  const Values x = {0.2};
  Prediction p = predict(model, data.tests[0], x);
  data.tests[0].slip_m = p.slip_m;
  data.tests[0].rotation_rad = p.rotation_rad;
  for (double& s : data.tests[0].slip_m) s += 3 * test::slip_noise_m;
  const TestError error = test_error(bench, 0, p);
  EXPECT_NEAR(error.noise_units, std::sqrt(9.0 / 2), 1e-9);
  EXPECT_NEAR(error.score, std::log(9.0 / 2), 1e-9);
}

TEST(Bench, NoiseOfASignalIsReadOffItsQuietParts) {
  const Dataset data = test::made_dataset(cabinet(0.2));
  EXPECT_NEAR(sensor_noise(data.tests[0].rotation_rad) / test::rotation_noise_rad, 1, 0.15);
}

// A floor of 8 Hz that is read at 50 Hz and quiet for some tenths of a second: the noise of its sensor, and not its motion.
TEST(SensorNoise, OfASlowSensorIsHeardWhereTheFloorIsQuiet) {
  test::KeyedRandom random(17, 1);
  for (const double step : {0.02, 0.01}) {
    std::vector<double> read;
    for (double t = 0; t < 8; t += step)
      read.push_back((t > 0.7 && t < 7.2 ? 3 * std::sin(2 * std::numbers::pi * 8 * t) : 0) + 0.007 * random.normal());
    EXPECT_GT(slow_noise(read, step), 0.006) << step;
    EXPECT_LT(slow_noise(read, step), 0.007 * 2) << step;
    EXPECT_GT(sensor_noise(read), 0.05) << step;
  }
}

TEST(ModelFit, FindsFrictionAgainWithAnErrorOfTheNoise) {
  const Dataset data = test::made_dataset(cabinet(0.237));
  const Bench bench(data, 4);
  auto fits = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
  polish(bench, {&fits[0]}, Effort{}, 0.05, run_here);
  leave_out(bench, {&fits[0]}, Effort{}, run_here);
  EXPECT_NEAR(fits[0].x[0], 0.237, 5e-4);
  ASSERT_EQ(fits[0].intervals.size(), 1U);
  EXPECT_LE(fits[0].intervals[0].lower, 0.2375);
  EXPECT_GE(fits[0].intervals[0].upper, 0.2365);
  for (const TestError& e : fits[0].left_out) EXPECT_NEAR(e.noise_units, 1, 0.1);
}

TEST(ModelFit, DoesNotDependOnTheOrderOfItsJobs) {
  const Dataset data = test::made_dataset(cabinet(0.3));
  const Bench bench(data, 0);
  const Jobs backwards = [](const std::string&, std::size_t n, const Job& job) {
    std::vector<Values> answers(n);
    for (std::size_t i = n; i-- > 0;) answers[i] = job(i);
    return answers;
  };
  const auto one = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, run_here);
  const auto other = fit_models(bench, {{.model = test::free_friction()}}, Effort{}, backwards);
  EXPECT_EQ(one[0].x, other[0].x);
  EXPECT_EQ(one[0].score, other[0].score);
}

}  // namespace
}  // namespace freestand::measurement
