// What noise makes of products with the changes of a history, against sums over its samples and their correlations.
#include "measurement/fit/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measurement/made_tests.hpp"
#include "support/keyed_random.hpp"

namespace freestand::measurement {
namespace {

// M^T C^-1 of what each sample enters: of its own row and those behind it.
Eigen::MatrixXd weights_of_samples(const Judge& judge, const Eigen::MatrixXd& M, const Sensor& sensor,
                                   Eigen::Index from, Eigen::Index count) {
  Eigen::MatrixXd weights(M.cols(), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    Eigen::VectorXd impulse = Eigen::VectorXd::Zero(M.rows());
    impulse[from + j] = 1;
    sensor.whiten(impulse.data() + from, static_cast<std::size_t>(count), judge.test(0).dt_s);
    weights.col(j) = judge.against(0, M, impulse);
  }
  return weights;
}

Eigen::MatrixXd covariance(const Sensor& sensor, Eigen::Index count, double dt_s) {
  Eigen::MatrixXd all(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      all(i, j) = sensor.coloured * sensor.coloured *
                  std::exp(-static_cast<double>(std::abs(i - j)) * dt_s / sensor.correlation_s);
  return all;
}

TEST(Judge, SlowNoiseAddsToProductsWhatItAddsToSamples) {
  Dataset data = test::with_noise(test::made_dataset(test::cabinet(), 0), 301, 0.3);
  data.noise.floor_acceleration_mps2 = 0.02;  // so that replays enter C
  Bench bench(data, 4);
  bench.estimate_sensors();
  const Judge judge(bench, test::free_friction(), {0.2}, run_here);
  const auto samples = static_cast<Eigen::Index>(judge.samples()[0]);
  test::KeyedRandom random(3, 1);
  const Eigen::MatrixXd M = Eigen::MatrixXd::NullaryExpr(samples, 3, [&] { return random.normal(); });
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 3);
  Eigen::Index from = 0;
  for (const Channel channel : {Channel::slip, Channel::rotation}) {
    const auto count = static_cast<Eigen::Index>(history(judge.test(0), channel).size());
    const Sensor& sensor = bench.sensor(channel);
    ASSERT_FALSE(sensor.slow_powers.empty());
    const Eigen::MatrixXd weights = weights_of_samples(judge, M, sensor, from, count);
    const double dt_s = judge.test(0).dt_s;
    expected += weights *
                (covariance(sensor.with_slow_power(more_slow_power), count, dt_s) - covariance(sensor, count, dt_s)) *
                weights.transpose();
    from += count;
  }
  ASSERT_EQ(from, samples);
  EXPECT_LT((judge.products(0, M).slow - expected).norm(), 1e-9 * expected.norm());
}

}  // namespace
}  // namespace freestand::measurement
