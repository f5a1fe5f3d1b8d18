// Synthetic motions against what the model itself expects, calculated from its equations by other means: quadrature of the envelope,
// sums over all impulses with the closed form of the filter, transfer functions in the frequency domain. What an ensemble may be
// off by is derived: the acceleration is a sum of independent normal numbers, so that its variance, its spectrum and its Arias intensity
// have variances that follow from the same sums.
#include "motion/synthetic.hpp"

#include <gmock/gmock.h>
#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <freestand/error.hpp>

#include "base/random.hpp"
#include "base/units.hpp"
#include "motion/cumulative.hpp"
#include "motion/filtered_noise.hpp"
#include "motion/gamma_envelope.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"

namespace freestand::motion::synthetic_test {
namespace {

using testing::HasSubstr;

constexpr double g = standard_gravity_mps2;

const SyntheticParameters usual = {.arias_mps = 0.8,
                                   .duration_s = 5,
                                   .middle_s = 3,
                                   .frequency_hz = 2,
                                   .frequency_slope_hzps = -0.2,
                                   .bandwidth = 0.3,
                                   .corner_hz = 0.15,
                                   .step_s = 0.02};

std::vector<double> white(std::size_t count, std::uint64_t number) {
  std::vector<double> noise;
  for (std::size_t i = 0; i < count; ++i) noise.push_back(random::standard_normal(7, (number << 32) + i, 42));
  return noise;
}

FloorMotion motion_of(const SyntheticParameters& p, std::uint64_t number) {
  return synthetic_motion(p, white(noise_samples(p), number), "one");
}

// Acceleration at the samples.
std::vector<double> samples(const FloorMotion& motion) {
  std::vector<double> values;
  for (std::size_t i = 0; i < motion.segments(); ++i) values.push_back(motion.horizontal_mps2[2 * i]);
  return values;
}

TEST(GammaEnvelope, HasTheIntensityAndTheTimesThatItIsGiven) {
  for (const auto& [duration, middle] : {std::pair(10.0, 6.0), {17.0, 12.0}, {4.0, 9.0}, {24.0, 5.0}, {2.0, 20.0}}) {
    const GammaEnvelope q(1.7, duration, middle);
    const double end = q.time_of_share(1 - 1e-9);
    constexpr int steps = 100'000;
    const auto time = [&](auto i) {
      return end * std::pow(static_cast<double>(i) / steps, 3);
    };                             // dense at the beginning
    std::vector<double> arias{0};  // by trapezoids
    for (int i = 1; i <= steps; ++i) {
      const double a = q(time(i - 1)), b = q(time(i));
      arias.push_back(arias.back() + pi / (2 * g) * (a * a + b * b) / 2 * (time(i) - time(i - 1)));
    }
    EXPECT_NEAR(arias.back(), 1.7, 1e-6);
    const auto time_of = [&](double share) {
      const auto at = std::lower_bound(arias.begin(), arias.end(), share * 1.7) - arias.begin();
      return time(at);
    };
    const double step = 3 * end / steps;  // the longest
    EXPECT_NEAR(time_of(0.45), middle, step);
    EXPECT_NEAR(time_of(0.95) - time_of(0.05), duration, step);
    EXPECT_NEAR(time_of(0.99), q.time_of_share(0.99), step);
  }
}

// The closed form of the filter's response, and every impulse's part in every sample of q x.
struct Impulses {
  explicit Impulses(const SyntheticParameters& p) : count(noise_samples(p)), part(count, std::vector<double>(count)) {
    const GammaEnvelope q(p.arias_mps, p.duration_s, p.middle_s);
    const double first = q.time_of_share(0.01), last = q.time_of_share(0.99);
    for (std::size_t j = 0; j < count; ++j) {
      double sum = 0;
      for (std::size_t i = 0; i < j; ++i) {
        const double at = p.step_s * static_cast<double>(i), since = p.step_s * static_cast<double>(j - i);
        const double hz = p.frequency_hz + p.frequency_slope_hzps * (std::min(std::max(at, first), last) - p.middle_s);
        const double w = 2 * pi * hz, wd = w * std::sqrt(1 - p.bandwidth * p.bandwidth);
        part[j][i] = w * w / wd * std::exp(-p.bandwidth * w * since) * std::sin(wd * since);
        sum += part[j][i] * part[j][i];
      }
      for (std::size_t i = 0; i < j; ++i) part[j][i] *= q(p.step_s * static_cast<double>(j)) / std::sqrt(sum);
    }
  }
  std::size_t count;
  std::vector<std::vector<double>> part;  // [sample][impulse]
};

TEST(Synthetic, TheNoiseHasUnitVarianceAndCrossesZeroAsItsFilterSays) {
  constexpr int motions = 400;
  constexpr double step = 0.02, hz = 3, z = 0.25;
  const std::size_t count = 600, from = 200;  // behind 12 periods the filter has forgotten its beginning
  const std::vector<double> frequency(count, hz);
  std::vector<double> squares(count, 0.0), crossings;
  for (int m = 0; m < motions; ++m) {
    const auto x = filtered_noise(frequency, z, step, white(count, static_cast<std::uint64_t>(m)));
    double crossed = 0;
    for (std::size_t j = 0; j < count; ++j) {
      squares[j] += x[j] * x[j];
      if (j > from && (x[j] > 0) != (x[j - 1] > 0)) ++crossed;
    }
    crossings.push_back(crossed);
  }
  EXPECT_EQ(squares[0], 0);
  for (std::size_t j = 1; j < count; j += 37) {  // each a chi-square of so many degrees, whatever has arrived
    EXPECT_GT(gsl_cdf_chisq_P(squares[j], motions), 1e-5) << j;
    EXPECT_GT(gsl_cdf_chisq_Q(squares[j], motions), 1e-5) << j;
  }
  // Two normal numbers with correlation r differ in sign with probability arccos(r)/pi; r of the sums by their closed form.
  const double w = 2 * pi * hz, wd = w * std::sqrt(1 - z * z);
  double lagged = 0, variance = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto h = [&](double s) { return std::exp(-z * w * s) * std::sin(wd * s); };
    lagged += h(n * step) * h((n + 1) * step);
    variance += h(n * step) * h(n * step);
  }
  const double expected = static_cast<double>(count - 1 - from) * std::acos(lagged / variance) / pi;
  double mean = 0, spread = 0;
  for (const double c : crossings) mean += c / motions;
  for (const double c : crossings) spread += (c - mean) * (c - mean) / (motions - 1);
  EXPECT_NEAR(mean, expected, 4 * std::sqrt(spread / motions));
  EXPECT_NEAR(expected, 2 * hz * step * static_cast<double>(count - 1 - from), 0.03 * expected);  // twice the frequency
}

// The acceleration is sum_i u_i r_i(t). Its transform at a frequency is A = sum_i u_i R_i, so that E|A|^2 = sum |R_i|^2 = S, and of normal
// u_i var |A|^2 = S^2 + |sum R_i^2|^2. R_i here: the transform of the filter's closed form, times that of the straight lines between
// samples and the high-pass filter's (i w)^2 / (i w + w_c)^2.
TEST(Synthetic, TheMeanSpectrumIsTheModels) {
  constexpr int motions = 200;
  const Impulses impulses(usual);
  std::vector<std::vector<double>> ensemble;
  for (int m = 0; m < motions; ++m) ensemble.push_back(samples(motion_of(usual, static_cast<std::uint64_t>(m))));
  double chi_square = 0;
  int frequencies = 0;
  for (double hz = 0.05; hz < 10; hz *= 1.25, ++frequencies) {
    const double w = 2 * pi * hz;
    std::vector<std::complex<double>> wave;
    for (std::size_t j = 0; j < ensemble.front().size(); ++j)
      wave.push_back(std::polar(1.0, -w * usual.step_s * static_cast<double>(j)));
    const std::complex<double> iw(0, w), filter = iw * iw / std::pow(iw + 2 * pi * usual.corner_hz, 2);
    std::vector<std::complex<double>> of(impulses.count);
    for (std::size_t j = 0; j < impulses.count; ++j)
      for (std::size_t i = 0; i < j; ++i) of[i] += impulses.part[j][i] * wave[j];
    double power = 0;
    std::complex<double> square = 0;
    for (auto& one : of) {
      one *= filter;
      power += std::norm(one);
      square += one * one;
    }
    // Samples of z'' follow from x as a line between its samples, whose transform is that of the samples times sinc^2; those of
    // z'' have it too, but for 2 w_c z' + w_c^2 z, which bends within a step: (w_c step)^2/12 at most.
    double mean = 0;
    for (const std::vector<double>& a : ensemble) {
      std::complex<double> transform = 0;
      for (std::size_t j = 0; j < a.size(); ++j) transform += a[j] * wave[j];
      mean += std::norm(transform) / motions;
    }
    const double deviation = std::sqrt((power * power + std::norm(square)) / motions);
    EXPECT_NEAR(mean, power, 4.5 * deviation) << hz << " Hz";
    chi_square += std::pow((mean - power) / deviation, 2);
  }
  // Neighbouring frequencies go together, which widens the sum's scatter: no more than all of them at one would, at 4.5 deviations.
  EXPECT_LT(chi_square / frequencies, 4.5);
}

// Mean square of the motion at each instant: by the filter's own impulse response, d(t) - w_c (2 - w_c t) exp(-w_c t).
TEST(Synthetic, AriasAndHusidsCurveAreTheModels) {
  constexpr int motions = 400;
  const Impulses impulses(usual);
  const double wc = 2 * pi * usual.corner_hz, dt = usual.step_s;
  const std::size_t n = impulses.count;
  std::vector<std::vector<double>> response(n, std::vector<double>(n));  // [sample][impulse], high-passed
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      double taken = 0;
      for (std::size_t k = i; k <= j; ++k) {  // trapezoids: the response is smooth over a step
        const double since = dt * static_cast<double>(j - k), weight = k == j ? dt / 2 : dt;
        taken += weight * wc * (2 - wc * since) * std::exp(-wc * since) * impulses.part[k][i];
      }
      response[j][i] = impulses.part[j][i] - taken;
    }
  // Arias by trapezoids of squares at the samples up to each; variance of a quadratic form of normal numbers: 2 tr(M^2), M = sum of
  // outer products.
  const std::vector<std::size_t> ends = {n / 8, n / 6, n / 4, n / 3, n - 1};
  std::vector<std::vector<double>> of(ends.size());
  for (int m = 0; m < motions; ++m) {
    const std::vector<double> a = samples(motion_of(usual, static_cast<std::uint64_t>(m)));
    double sum = 0;
    for (std::size_t j = 0, e = 0; e < ends.size(); ++j) {
      sum += a[j] * a[j] * dt;
      if (j == ends[e]) of[e++].push_back(sum);
    }
  }
  double mean = 0, variance = 0;
  for (std::size_t j = 0, e = 0; e < ends.size(); ++j) {
    for (std::size_t k = 0; k <= j; ++k) {
      double covariance = 0;
      for (std::size_t i = 0; i <= k; ++i) covariance += response[j][i] * response[k][i];
      if (j == k) mean += covariance * dt;
      variance += (j == k ? 2 : 4) * covariance * covariance * dt * dt;
    }
    if (j != ends[e]) continue;
    double found = 0;
    for (const double one : of[e]) found += one / motions;
    EXPECT_NEAR(found, mean, 4 * std::sqrt(variance / motions)) << e;
    ++e;
  }
  EXPECT_LT(std::sqrt(variance / motions), 0.02 * mean);
  // What was asked for, but for what the high-pass filter takes: where it is far below the filter's frequency f, whose spectrum is
  // flat there, 1 - |H|^2 over all w is 3 pi w_c/4, and the whole spectrum pi w/(4 z) of its value at 0.
  const GammaEnvelope q(usual.arias_mps, usual.duration_s, usual.middle_s);
  double taken = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double t = dt * static_cast<double>(j), f = usual.frequency_hz + usual.frequency_slope_hzps * (t - 3);
    taken += pi / (2 * g) * q(t) * q(t) * dt * 3 * usual.bandwidth * usual.corner_hz / std::max(f, 0.7);
  }
  EXPECT_NEAR(pi / (2 * g) * mean, usual.arias_mps - taken, 0.2 * taken);
}

// How fast it swings at each time: the mean product of two samples a quarter of the middle period apart, whose correlation falls
// through zero there. Of normal numbers with covariances C the product has the variance C_jj C_kk + C_jk^2.
TEST(Synthetic, TheFrequencyMovesWithTime) {
  constexpr int motions = 500;
  constexpr std::size_t lag = 6;
  SyntheticParameters p = usual;
  p.corner_hz = 0.05;  // takes a fiftieth of the whole, a tenth of what is allowed below
  const Impulses impulses(p);
  const auto covariance = [&](std::size_t j, std::size_t k) {
    double sum = 0;
    for (std::size_t i = 0; i < std::min(j, k); ++i) sum += impulses.part[j][i] * impulses.part[k][i];
    return sum;
  };
  const std::vector<std::size_t> at = {75, 125, 175, 225, 275};  // 1.5 to 5.5 s
  std::vector<double> found(at.size(), 0.0);
  for (int m = 0; m < motions; ++m) {
    const std::vector<double> white_noise = white(impulses.count, static_cast<std::uint64_t>(m));
    const std::vector<double> a = samples(synthetic_motion(p, white_noise, "one"));
    for (std::size_t e = 0; e < at.size(); ++e) found[e] += a[at[e]] * a[at[e] + lag] / motions;
  }
  for (std::size_t e = 0; e < at.size(); ++e) {
    const std::size_t j = at[e], k = j + lag;
    const double together = covariance(j, k), strength = covariance(j, j) * covariance(k, k);
    EXPECT_NEAR(found[e], together, 4 * std::sqrt((strength + together * together) / motions)) << e;
  }
  // It can be told: the correlation rises by seven such deviations and more as the frequency falls.
  EXPECT_GT(covariance(275, 281) / covariance(275, 275) - covariance(75, 81) / covariance(75, 75),
            7 / std::sqrt(motions));
}

TEST(Synthetic, TheFloorComesToRestWhereItBegan) {
  for (std::uint64_t number = 0; number < 20; ++number) {
    SyntheticParameters p = usual;
    p.step_s = 0.01;
    p.duration_s = 4 + static_cast<double>(number);
    p.middle_s = 3 + static_cast<double>(number) / 2;
    p.frequency_slope_hzps = -0.05;
    if (number % 2) p.pulse = SyntheticPulse{number % 4 == 1 ? "B" : "C1", 1.37, 0.6, 4};
    const FloorMotion motion = motion_of(p, number);
    const MotionPeaks highest = peaks(motion);
    double v = 0, u = 0;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const double a = motion.horizontal_mps2[2 * i], slope = motion.horizontal_mps2[2 * i + 1], h = p.step_s;
      u += h * (v + h * (a / 2 + h * slope / 6));
      v += h * (a + h * slope / 2);
    }
    EXPECT_LT(std::abs(v), 2e-6 * highest.pgv_mps) << number;
    EXPECT_LT(std::abs(u), 2e-6 * highest.pgd_m) << number;
  }
}

TEST(Synthetic, APulseStandsOnTop) {
  for (const char* type : {"A", "B", "C1", "C2", "ricker", "square"}) {
    SyntheticParameters with = usual;
    with.step_s = 0.005;
    const SyntheticParameters without = with;
    with.pulse = SyntheticPulse{type, 1.234, -0.7, 4.321};
    const std::vector<double> a = samples(motion_of(with, 3)), b = samples(motion_of(without, 3));
    std::vector<double> difference;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) difference.push_back(a[i] - b[i]);
    const Pulse pulse = find_pulse(type);
    const double peak = acceleration_of_peak_velocity(pulse, -0.7, 1.234), start = 4.321 - pulse.duration * 1.234 / 2;
    // Velocity and displacement of the sampled pulse, exact integrals of its lines, against the closed form: a jump of 2 a_p is smeared
    // over two steps, which moves the velocity by a_p step/4 at most and the rest by less.
    double v = 0, u = 0, highest = 0;
    for (std::size_t i = 0; i + 1 < difference.size(); ++i) {
      const double h = with.step_s;
      u += h * (v + h * (difference[i] / 3 + difference[i + 1] / 6));
      v += h * (difference[i] + difference[i + 1]) / 2;
      highest = std::max(highest, std::abs(v));
      const double at = (h * static_cast<double>(i + 1) - start) / 1.234;
      const PulseState closed = at < 0 ? PulseState{} : pulse.at(std::min(at, pulse.duration));
      EXPECT_NEAR(v, peak * 1.234 * closed.velocity, std::abs(peak) * h / 2) << type << " " << at;
      EXPECT_NEAR(u, peak * 1.234 * 1.234 * closed.displacement, std::abs(peak) * h * h) << type << " " << at;
    }
    EXPECT_NEAR(highest, 0.7, std::abs(peak) * with.step_s) << type;  // smeared, and looked at once a step
    const PulseState last = pulse.at(pulse.duration);
    EXPECT_NEAR(v, peak * 1.234 * last.velocity, 1e-9) << type;
    EXPECT_NEAR(u, peak * 1.234 * 1.234 * last.displacement, 1e-9) << type;
  }
}

TEST(Synthetic, WhatCannotBeIsRefused) {
  const auto why = [](auto&& change) {
    SyntheticParameters p = usual;
    change(p);
    return refusal(p);
  };
  EXPECT_EQ(refusal(usual), "");
  EXPECT_THAT(why([](auto& p) { p.duration_s = 15; }), HasSubstr("raise middle_s"));
  EXPECT_THAT(why([](auto& p) { p.duration_s = 0.05; }), HasSubstr("lower middle_s"));
  EXPECT_THAT(why([](auto& p) { p.frequency_slope_hzps = -1; }), HasSubstr("correct frequency_slope_hzps"));
  EXPECT_THAT(why([](auto& p) { p.frequency_hz = 7; }), HasSubstr("lower frequency_slope_hzps, or step_s"));
  EXPECT_THAT(why([](auto& p) { p.corner_hz = 3; }), HasSubstr("or lower corner_hz"));
  EXPECT_THAT(why([](auto& p) {
                p.pulse = SyntheticPulse{"B", 4, 1, 1.5};
              }),
              HasSubstr("raise pulse.middle_s to 2.02"));
  EXPECT_THAT(why([](auto& p) {
                p.pulse = SyntheticPulse{"rectangular", 1, 1, 5};
              }),
              HasSubstr("leaves the floor moving"));
  EXPECT_THAT(why([](auto& p) { p.corner_hz = 1e-4; }), HasSubstr("samples"));
  SyntheticParameters late = usual;
  late.duration_s = 15;
  EXPECT_THROW(synthetic_motion(late, {0, 1}, "late"), Error);
}

}  // namespace
}  // namespace freestand::motion::synthetic_test
