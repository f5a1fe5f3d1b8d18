#include "motion/band_pass.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "motion/peaks.hpp"
#include "record_fixture.hpp"
#include "support/error_text.hpp"

namespace freestand::motion::band_pass_test {
namespace {

constexpr double step = 0.01, duration = 160;
constexpr BandPass band{0.5, 10};

std::vector<double> sine(double frequency_hz) {
  std::vector<double> a;
  for (int i = 0; i <= static_cast<int>(duration / step); ++i)
    a.push_back(std::sin(2 * std::numbers::pi * frequency_hz * i * step));
  return a;
}

// Samples before the record's first one, as many as after its last.
std::size_t lead_of(const std::vector<double>& out, const std::vector<double>& in) {
  return (out.size() - in.size()) / 2;
}

// The squared gain of the fourth-order Butterworth filter, from its poles: |H(i w)|^2 = product of |pole|^2/|i w - pole|^2.
double squared_gain(double ratio) {
  double gain = 1;
  for (int k = 0; k < 4; ++k) {
    const double angle = std::numbers::pi * (2 * k + 5) / 8, re = std::cos(angle), im = std::sin(angle);
    gain /= re * re + (ratio - im) * (ratio - im);
  }
  return gain;
}

// Far from the ends a sine comes out as itself, without a shift, times the filter's squared gain.
TEST(BandPassFilter, SinesComeOutTimesTheSquaredGain) {
  for (const double frequency : {0.2, 0.4, 0.5, 0.9, 2.0, 6.0, 10.0, 13.0, 25.0}) {
    const std::vector<double> in = sine(frequency), out = samples(band_pass(piecewise_linear("sine", step, in), band));
    const std::size_t lead = lead_of(out, in);
    const double gain = squared_gain(band.low_hz / frequency) * squared_gain(frequency / band.high_hz);
    double most = 0;
    for (std::size_t i = 6000; i < 10001; ++i) most = std::max(most, std::abs(out[lead + i] - gain * in[i]));
    EXPECT_LT(most, 1e-6) << frequency << " Hz, gain " << gain;
    EXPECT_NEAR(band_pass_gain(band, frequency), gain, 1e-12 * gain);
  }
  EXPECT_NEAR(band_pass_gain(band, 0.5), 0.5, 1e-9);
  EXPECT_EQ(band_pass_gain(band, 0), 0);
}

// The zeros that stay at both ends hold what the filter makes before and after the record: what comes out of it and of the same with
// many more zeros is the same, and the floor, which a filter without gain at zero frequency leaves no shift, comes back to where it was.
TEST(BandPassFilter, EndsHoldWhatTheFilterMakesBeforeAndAfter) {
  std::vector<double> shaking = sine(2);
  for (std::size_t i = 0; i < shaking.size(); ++i) shaking[i] += i % 1000 < 500 ? 0.3 : 0.1;
  const std::vector<double> out = samples(band_pass(piecewise_linear("shaking", step, shaking), band));
  std::vector<double> longer = shaking;
  longer.insert(longer.begin(), 20000, 0.0);
  longer.resize(5 * shaking.size(), 0.0);
  const std::vector<double> of_longer = samples(band_pass(piecewise_linear("longer", step, longer), band));
  const std::size_t lead = lead_of(out, shaking), of_longer_lead = lead_of(of_longer, longer) + 20000;
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_NEAR(out[i], of_longer[i + of_longer_lead - lead], 1e-7);
  const FloorHistory floor = floor_history(piecewise_linear("out", step, out), step);
  EXPECT_NEAR(floor.velocity_mps.back(), 0, 1e-7);
  EXPECT_NEAR(floor.displacement_m.back(), 0, 1e-5);
  EXPECT_GT(lead * step * band.low_hz, 7);  // ln(1e8)/(2 pi sin(pi/8)) = 7.66 periods of the lower corner
}

TEST(BandPassFilter, TreatsBothChannelsAlikeAndNothingElse) {
  const std::vector<double> a = sine(2), v = sine(3);
  const FloorMotion both = band_pass(piecewise_linear("both", step, a, v), band);
  EXPECT_EQ(both.horizontal_mps2, band_pass(piecewise_linear("a", step, a), band).horizontal_mps2);
  EXPECT_EQ(both.vertical_mps2, band_pass(piecewise_linear("v", step, v), band).horizontal_mps2);
  EXPECT_EQ(both.name, "both");
}

TEST(BandPassFilter, WhatTheRecordCannotHoldIsRefused) {
  const FloorMotion record = piecewise_linear("short.AT2", 0.02, std::vector<double>(251, 1.0));  // 5 s
  const auto refusal = [&](const BandPass& asked) {
    return freestand::test::error_text(Exit::data, [&] { band_pass(record, asked); });
  };
  EXPECT_THAT(refusal({0.5, 25}), testing::HasSubstr("short.AT2: no band up to 25 Hz (its step of 0.02 s"));
  EXPECT_THAT(refusal({0.1, 20}), testing::HasSubstr("a period of 10 s is longer than the record, 5 s"));
}

}  // namespace
}  // namespace freestand::motion::band_pass_test
