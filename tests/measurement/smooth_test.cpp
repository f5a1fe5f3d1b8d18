// Quadratics fitted to samples: exact on quadratics, and as noisy as the weights say.
#include "measurement/data/smooth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace freestand::measurement {
namespace {

TEST(Smooth, IsExactOnAQuadraticUpToBothEnds) {
  std::vector<double> samples;
  for (int i = 0; i < 60; ++i) samples.push_back(1 + 2 * (0.01 * i) - 3 * (0.01 * i) * (0.01 * i));
  const Smooth s = smooth(samples, 0.01, 0.07);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = 0.01 * static_cast<double>(i);
    EXPECT_NEAR(s.value[i], samples[i], 1e-12);
    EXPECT_NEAR(s.rate[i], 2 - 6 * t, 1e-10);
    EXPECT_NEAR(s.second[i], -6, 1e-8);
  }
}

// The same motion at 50 to 2000 samples a second: windows are times, so that the same speed comes out. A quadratic over h to either
// side takes (w h)^2/10 of the speed of a sine, here 16 %; twice as many samples in the window would take half of it all.
TEST(Smooth, SaysTheSameAtAnyRateOfTheSamples) {
  constexpr double half_window_s = 0.08, w = 2 * 3.141592653589793 / 0.4;
  const auto rate_at = [&](double dt_s, double time_s) {
    std::vector<double> samples;
    for (int i = 0; i * dt_s < 1; ++i) samples.push_back(std::sin(w * i * dt_s) / w);
    return smooth(samples, dt_s, half_window_s).rate[static_cast<std::size_t>(std::lround(time_s / dt_s))];
  };
  for (const double time_s : {0.4, 0.5, 0.6}) {
    const double fine = rate_at(0.0005, time_s);
    EXPECT_NEAR(fine, (1 - w * w * half_window_s * half_window_s / 10) * std::cos(w * time_s), 0.02) << time_s;
    for (const double dt_s : {0.001, 0.005, 0.02})
      EXPECT_NEAR(rate_at(dt_s, time_s), fine, 0.05) << dt_s << ' ' << time_s;
  }
}

TEST(Smooth, NoiseOfRateAndSecondIsThatOfTheWeights) {
  constexpr std::size_t n = 40000;
  constexpr double half_window_s = 0.03;
  std::vector<double> noise;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [a, b] = random::bits(11, i, 3);
    noise.push_back(std::sqrt(12.0) * (random::unit_interval(a) - 0.5));  // of standard deviation 1
  }
  const Smooth s = smooth(noise, 0.005, half_window_s);
  double rate = 0, second = 0;
  for (std::size_t i = 0; i < n; ++i) rate += s.rate[i] * s.rate[i] / n, second += s.second[i] * s.second[i] / n;
  EXPECT_NEAR(std::sqrt(rate) / rate_noise(0.005, half_window_s), 1, 0.03);
  EXPECT_NEAR(std::sqrt(second) / second_noise(0.005, half_window_s), 1, 0.03);
}

TEST(Smooth, TooFewSamplesGiveZeros) { EXPECT_EQ(smooth({1, 2, 3}, 0.01, 0.02).rate, std::vector<double>(3, 0.0)); }

}  // namespace
}  // namespace freestand::measurement
