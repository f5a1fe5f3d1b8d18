// The noise of sensors, from series made with noise that is known.
#include "measurement/noise/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "base/units.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/data/resolution.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/noise/quiet.hpp"
#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

constexpr double dt_s = 0.005;

// White and coloured noise by the difference equation, about a constant, with a slope.
QuietStretch noise(std::uint64_t key, std::size_t test, std::size_t count, double white, double coloured,
                   double correlation_s, double slope_per_s = 0) {
  test::KeyedRandom random(1, key);
  QuietStretch stretch{test, dt_s, {}};
  const double r = correlation_s > 0 ? std::exp(-dt_s / correlation_s) : 0, constant = random.uniform(-50, 50);
  double c = coloured * random.normal();
  for (std::size_t i = 0; i < count; ++i) {
    stretch.samples.push_back(constant + slope_per_s * dt_s * static_cast<double>(i) + c + white * random.normal());
    c = r * c + std::sqrt(1 - r * r) * coloured * random.normal();
  }
  return stretch;
}

std::vector<QuietStretch> set_of(std::uint64_t key, double white, double coloured = 0, double correlation_s = 0,
                                 double slope_per_s = 0) {
  std::vector<QuietStretch> all;
  for (std::size_t test = 0; test < 7; ++test)
    for (std::size_t part = 0; part < 3; ++part)
      all.push_back(noise(1000 * key + 10 * test + part, test, 150 + 100 * part, white, coloured, correlation_s,
                          test % 2 ? slope_per_s : -slope_per_s));
  return all;
}

TEST(Sensor, AsStatedStaysAsStatedInNineteenSetsOfTwenty) {
  int changed = 0;
  const int sets = test::repeats_asked(30);
  for (std::uint64_t key = 1; key <= static_cast<std::uint64_t>(sets); ++key) {
    const Sensor found = sensor_of(set_of(key, 1));
    changed += found.white != 1 || found.coloured != 0;
    EXPECT_NEAR(found.size(), 1, 0.1);
  }
  EXPECT_LE(changed, test::likely_counts(sets, 0.0975).most);  // two questions of 5 % each
}

TEST(Sensor, FindsTheSizeThatWasStatedWrongly) {
  for (const double size : {0.5, 2.0}) {
    const Sensor found = sensor_of(set_of(7, size));
    EXPECT_NEAR(found.size() / size, 1, 4 * found.size_error);
    EXPECT_LT(found.size_error, 0.02);
  }
}

TEST(Sensor, FindsColour) {
  for (const double correlation_s : {0.05, 0.3}) {
    const Sensor found = sensor_of(set_of(11, 0.3, 1, correlation_s));
    EXPECT_NEAR(found.white, 0.3, 0.03) << correlation_s;
    // The variance is the less known the fewer correlation times there are: 5000 samples hold 500 and 80 of them.
    EXPECT_NEAR(found.coloured, 1, correlation_s < 0.1 ? 0.15 : 0.4) << correlation_s;
    EXPECT_NEAR(std::log(found.correlation_s / correlation_s), 0, 0.7) << correlation_s;
  }
}

TEST(Sensor, FindsDrift) {
  EXPECT_EQ(sensor_of(set_of(13, 1)).drift_per_s, 0);
  EXPECT_NEAR(sensor_of(set_of(13, 1, 0, 0, 0.5)).drift_per_s, 0.5, 0.1);
}

// Whitened by its own sensor, noise is independent and of size 1; white noise of the stated size is left as it is.
TEST(Sensor, WhitensItsOwnNoise) {
  QuietStretch stretch = noise(3, 0, 20000, 0.4, 1.5, 0.1);
  const double mean = std::accumulate(stretch.samples.begin(), stretch.samples.end(), 0.0) / 20000;
  for (double& y : stretch.samples) y -= mean;
  Sensor{.white = 0.4, .coloured = 1.5, .correlation_s = 0.1}.whiten(stretch.samples.data(), 20000, dt_s);
  double square = 0, lag = 0;
  for (std::size_t i = 0; i < 20000; ++i) square += stretch.samples[i] * stretch.samples[i] / 20000;
  for (std::size_t i = 1; i < 20000; ++i) lag += stretch.samples[i] * stretch.samples[i - 1] / 20000;
  EXPECT_NEAR(square, 1, 0.04);  // four standard errors, sqrt(2/20000) each
  EXPECT_NEAR(lag, 0, 0.03);
  std::vector<double> same = {3, -2, 5};
  Sensor{}.whiten(same.data(), 3, dt_s);
  EXPECT_EQ(same, (std::vector<double>{3, -2, 5}));
}

// Of random weights w and series e: (T w) e = w (T^T e), and the variance of w c is that of the coloured noise c by its correlation.
TEST(Sensor, TransposesSayTheSameOfSums) {
  const Sensor sensor{.white = 0.4, .coloured = 1.5, .correlation_s = 0.1};
  constexpr std::size_t n = 60;
  test::KeyedRandom random(2, 1);
  std::vector<double> series, weights;
  for (std::size_t i = 0; i < n; ++i) series.push_back(random.normal()), weights.push_back(random.normal());
  std::vector<double> whitened = series, back = weights, parts = weights;
  sensor.whiten(whitened.data(), n, dt_s);
  sensor.whiten_transposed(back.data(), n, dt_s);
  EXPECT_NEAR(std::inner_product(whitened.begin(), whitened.end(), weights.begin(), 0.0),
              std::inner_product(series.begin(), series.end(), back.begin(), 0.0), 1e-12);
  sensor.colour_transposed(parts.data(), n, dt_s);
  double variance = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      variance += 1.5 * 1.5 * weights[i] * weights[j] *
                  std::exp(-std::abs(static_cast<double>(i) - static_cast<double>(j)) * dt_s / 0.1);
  EXPECT_NEAR(std::inner_product(parts.begin(), parts.end(), parts.begin(), 0.0), variance, 1e-11 * variance);
}

// The true power of slow noise lies anywhere among the values that are called equally likely.
TEST(Sensor, SlowNoiseMayBeWhatItIs) {
  const int sets = test::repeats_asked(20);
  int below = 0, above = 0, outside = 0;
  for (std::uint64_t key = 1; key <= static_cast<std::uint64_t>(sets); ++key) {
    const Sensor found = sensor_of(set_of(500 + key, 0.3, 1, 0.3));
    const double truth = 0.3 / (found.coloured * found.coloured * found.correlation_s);
    const auto& may_be = found.slow_powers;
    ASSERT_EQ(may_be.size(), 50);
    below += truth<may_be[12], above += truth> may_be[37];
    outside += truth < may_be[2] || truth > may_be[47];
  }
  for (const auto& [count, share] : {std::pair(below, 0.25), std::pair(above, 0.25), std::pair(outside, 0.1)}) {
    EXPECT_LE(count, test::likely_counts(sets, share).most) << share;
    EXPECT_GE(count, test::likely_counts(sets, share).least) << share;
  }
}

TEST(Sensor, IsReadOffWhereTheBlockStands) {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  Dataset data = test::made_dataset(cabinet);
  const auto stretches = quiet_stretches(data, Channel::slip);
  ASSERT_FALSE(stretches.empty());
  double seconds = 0, most = 0;
  for (const QuietStretch& s : stretches) {
    seconds += s.dt_s * static_cast<double>(s.samples.size());
    const auto [low, high] = std::minmax_element(s.samples.begin(), s.samples.end());
    most = std::max(most, *high - *low);
  }
  EXPECT_GT(seconds, 4);  // of 16
  EXPECT_LT(most, 10);    // noise units: no motion among them
  EXPECT_NEAR(sensor_of(stretches).size(), 1, 0.06);
  data.noise.slip_m *= 2;
  EXPECT_NEAR(sensor_of(quiet_stretches(data, Channel::slip)).size(), 0.5, 0.03);
}

// While the floor rests within its noise a block's accelerometer shows the noise of both.
TEST(Sensor, OfTheBlocksAccelerationIsReadOffOverThatOfTheFloor) {
  constexpr double stated = 0.05, of_floor = 0.03;
  for (const double times : {1.0, 4.0, 0.5}) {
    Dataset data = test::made_dataset(test::cabinet());
    data.noise.block_acceleration_mps2 = stated, data.noise.floor_acceleration_mps2 = of_floor;
    for (std::size_t t = 0; t < data.tests.size(); ++t) {
      measurement::Test& test = data.tests[t];
      std::vector<double> floor(801);
      for (std::size_t i = 0; i < floor.size(); ++i) {
        const double a = floor_acceleration_mps2(test, i);
        test.block_acceleration_mps2.push_back(std::clamp(a, -1.96, 1.96) +
                                               times * stated * random::standard_normal(8, i, t));
        floor[i] = a + of_floor * random::standard_normal(9, i, t);
      }
      test.motion = piecewise_linear("noisy", dt_s, floor, {});
    }
    Bench bench(data, 0);
    bench.estimate_sensors();
    // Below what is stated the floor's noise and its own are scaled alike.
    const double both = std::hypot(times * stated, of_floor) / std::hypot(stated, of_floor);
    EXPECT_NEAR(bench.sensor(Channel::block_acceleration).size() / (times < 1 ? both : times), 1, 0.06) << times;
  }
}

// A floor of 5 m/s2 in its first swing, so that 0.7 of what moved the block beyond doubt (mu g = 1.96) is above what it takes; then a push
// of 2.6 m/s2 to one side each second, which moves it by some tenths of a millimetre, too slowly to be seen.
TEST(Sensor, TakesNoSmallSlipsForNoise) {
  FloorMotion floor = test::swings(5, 0.3);
  std::vector<double> a;
  for (int i = 0; i <= std::lround(4 / dt_s); ++i) {
    const double t = dt_s * i - 0.5, push = std::fmod(t, 0.6);
    a.push_back(t > 0 && t < 0.6       ? 5 * std::sin(2 * pi * t / 0.3)
                : t > 1 && push < 0.06 ? 2.6 * std::sin(pi * push / 0.06)
                                       : 0);
  }
  floor = piecewise_linear("pushes", dt_s, a, {});
  Dataset data = test::made_dataset(test::cabinet());
  for (std::size_t t = 0; t < data.tests.size(); ++t)
    data.tests[t] = test::made_test(data.tests[t].id, test::cabinet(), floor, 40 + t);
  const Sensor found = sensor_of(quiet_stretches(data, Channel::slip));
  EXPECT_GT(found.quiet_s, 4);
  EXPECT_NEAR(found.size(), 1, 0.1);
}

// A floor that begins with a jump has moved the block before a smoothed window shows it: what came before the jump says
// nothing of what holds the block.
TEST(Sensor, IsReadOffBesideAFloorThatJumps) {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  Dataset data = test::made_dataset(cabinet);
  std::vector<double> jump(800, 0.0);
  for (int i = 100; i < 160; ++i) jump[static_cast<std::size_t>(i)] = 5;
  data.tests[0] = test::made_test("jump", cabinet, piecewise_linear("jump", 0.005, jump, {}), 9);
  double seconds = 0;
  for (const QuietStretch& s : quiet_stretches(data, Channel::slip))
    if (s.test != 0) seconds += s.dt_s * static_cast<double>(s.samples.size());
  EXPECT_GT(seconds, 3);  // of the three other tests
}

// A sensor that is read in steps says one and the same where nothing moves, and strays by step/sqrt(12) where something does.
TEST(Resolution, IsNoNoiseNearZero) {
  constexpr double step = 1e-3;
  Dataset data = test::made_dataset(test::cabinet(), 0.05);
  for (measurement::Test& t : data.tests)
    for (double& s : t.slip_m) s = step * std::round(s / step);
  EXPECT_NEAR(resolution(data.tests[0].slip_m), step, 1e-9 * step);
  data.noise.slip_m = step / std::sqrt(12.0);
  EXPECT_LT(sensor_of(quiet_stretches(data, Channel::slip)).size(), 0.7) << "what quiet stretches alone say";
  Bench bench(data, 0);
  bench.estimate_sensors();
  EXPECT_NEAR(bench.sensor(Channel::slip).size(), 1, 0.1);
  for (const std::string& said : doubts(bench).sentences) ADD_FAILURE() << said;
  for (const measurement::Test& t : data.tests) EXPECT_FALSE(cut_off(t.slip_m, data.noise.slip_m)) << t.id;
  data.noise.slip_m /= 5;
  Bench stated_small(data, 0);
  stated_small.estimate_sensors();
  EXPECT_NEAR(stated_small.sensor(Channel::slip).size(), 5, 0.5);
}

TEST(Resolution, IsNoneOfRampsPulsesAndNoise) {
  const Dataset data = test::made_dataset(test::cabinet());
  EXPECT_EQ(resolution(data.tests[0].slip_m), 0);
  std::vector<double> ramp, pulses, printed;
  for (int i = 0; i < 2000; ++i) {
    ramp.push_back(0.25 * std::clamp(i % 200 - 50, 0, 100));
    pulses.push_back(i / 20 % 2 ? 5 : 0);
    printed.push_back(std::round(1e6 * data.tests[0].slip_m[static_cast<std::size_t>(i) % 800]) / 1e6);
  }
  EXPECT_EQ(resolution(ramp), 0);
  EXPECT_EQ(resolution(pulses), 0);
  EXPECT_LT(rounding(printed), 1e-6);
  EXPECT_EQ(resolution({}), 0);
}

}  // namespace
}  // namespace freestand::measurement
