// Errors second by second, and fits that find in by them.
#include "measurement/fit/strides.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effects.hpp"
#include "measurement/fit/starts.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement {
namespace {

// With exact histories but for a slip that is D too far from 2.5 s on: of the 2 x 5 seconds (the last of one sample) one
// is wrong, for half its time, and ln(1 + D^2/2)/10 is all that it costs. By the plain score it is ln of a mean square.
TEST(Strides, ASlipTooFarCostsTheSecondInWhichItHappens) {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  Dataset data = test::made_dataset(cabinet);
  const ModelSpec model = test::free_friction();
  const Values x = {0.2};
  const double wrong = 40;
  for (measurement::Test& test : data.tests) {
    const Prediction exact = predict(model, test, x);
    test.slip_m = exact.slip_m;
    test.rotation_rad = exact.rotation_rad;
    for (std::size_t i = 500; i < test.slip_m.size(); ++i) test.slip_m[i] += wrong * test::slip_noise_m;
  }
  const Bench bench(data, 0);
  EXPECT_NEAR(mean_stride_scores(bench, {0, 1, 2}, model, {x}).front(), std::log(1 + wrong * wrong / 2) / 10, 1e-9);
  EXPECT_NEAR(mean_score(bench, {0, 1, 2}, model, x), std::log(wrong * wrong * 301 / 801 / 2), 1e-9);
}

// A wall behind which the block seldom comes, and friction that falls with speed: from a start far off, the plain score
// ends in another valley; by strides it ends at the noise.
TEST(Strides, LeadToTheNoiseFromWhereThePlainScoreSticks) {
  const auto &weakening = *effects::find("rate_weakening"), &wall = *effects::find("wall_impact");
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.3, 0.3};
  cabinet.effects = {{&weakening, {0.5, 0.055}}, {&wall, {-0.04, 0.4}}};
  const Dataset data = test::made_dataset(cabinet);
  const Bench bench(data, 0);
  ModelSpec model = with_effect(with_effect(test::free_friction(), weakening, bench.reach()), wall, bench.reach());
  std::vector<FitTask> tasks = {{.model = model, .screened = false}};
  tasks[0].starts = {{0.19, 0.2, 0.35, -0.056, 0.64}};
  Effort effort;
  effort.starts = 1;
  const auto plain = fit_models(bench, tasks, effort, run_here);
  const auto strides = fit_by_strides(bench, tasks, 1, effort, run_here);
  EXPECT_GT(plain[0].score, 1);
  ASSERT_EQ(strides.size(), 1U);
  EXPECT_LT(strides[0].fit.score, 0.1);
  EXPECT_NEAR(strides[0].fit.x[3], -0.04, 2e-3);
}

}  // namespace
}  // namespace freestand::measurement
