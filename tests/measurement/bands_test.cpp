// Predictions of many draws: their mean, and how far it is from a test.
#include "measurement/fit/bands.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measurement/made_tests.hpp"

namespace freestand::measurement {
namespace {

// Half of the draws have one friction and half another. A test that was measured at the mean of the two histories is met by the mean of the
// predictions, whatever the sensor's noise, and by neither history.
TEST(Bands, TheMeanIsOfTheHistoriesOfTheDraws) {
  Dataset data = test::made_dataset(test::cabinet(), 0);
  const ModelSpec model = test::free_friction();
  const Values slippery = {0.18}, rough = {0.22};
  for (measurement::Test& t : data.tests) {
    const Prediction on_slippery = predict(model, t, slippery), on_rough = predict(model, t, rough);
    for (std::size_t k = 0; k < t.slip_m.size(); ++k) t.slip_m[k] = (on_slippery.slip_m[k] + on_rough.slip_m[k]) / 2;
  }
  const Bench bench(data, 0);
  const std::vector<Bands> bands = predicted_bands(bench, model, {.draws = {slippery, rough}, .of_mean = {}}, run_here);
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const measurement::Test& t = bench.test(i);
    const Band& slip = bands[i][static_cast<std::size_t>(Channel::slip)];
    ASSERT_EQ(slip.mean.size(), t.slip_m.size());
    for (std::size_t k = 0; k < t.slip_m.size(); ++k) {
      EXPECT_NEAR(slip.mean[k], t.slip_m[k], 1e-14);
      EXPECT_TRUE(slip.holds(k, slip.mean[k]));
    }
    EXPECT_LT(error_of_mean(bench, i, bands[i]).noise_units, 1e-9);
    EXPECT_GT(test_error(bench, i, model, slippery).noise_units, 1);
    EXPECT_GT(test_error(bench, i, model, rough).noise_units, 1);
  }
}

// Readings of a sensor whose noise is not stated have no band that they could lie in, or not.
TEST(Bands, ShareIsOfChannelsWhoseNoiseIsStated) {
  Dataset data = test::made_dataset(test::cabinet());
  for (measurement::Test& t : data.tests) t.block_acceleration_mps2.assign(t.slip_m.size(), 1e3);
  const Bench bench(data, 0);
  ASSERT_EQ(bench.noise(Channel::block_acceleration), 0);
  const auto bands =
      predicted_bands(bench, test::free_friction(), {.draws = {{0.2}, {0.2001}}, .of_mean = {}}, run_here);
  for (std::size_t i = 0; i < bench.size(); ++i) EXPECT_GT(share_within(bench, bench.test(i), bands[i]), 0.8);
}

TEST(Bands, WithoutDrawsThereIsNoMean) {
  const Dataset data = test::made_dataset(test::cabinet());
  const Bench bench(data, 0);
  const std::vector<Bands> bands = predicted_bands(bench, test::free_friction(), {}, run_here);
  EXPECT_TRUE(std::isnan(error_of_mean(bench, 0, bands[0]).noise_units));
}

}  // namespace
}  // namespace freestand::measurement
