#include "motion/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>
#include <numeric>

#include "base/units.hpp"
#include "motion/pulse.hpp"
#include "motion/summary.hpp"

namespace freestand::motion {
namespace {

FloorMotion sampled(const std::function<double(double)>& a, double step, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(a(i * step));
  return piecewise_linear("sampled", step, values);
}

// Independent calculation: Runge-Kutta of order 4 on tiny steps that never cross a knot, then free vibration sampled.
double by_runge_kutta(const FloorMotion& motion, double period, double damping) {
  const double w = 2 * pi / period;
  const Shaking shaking{&motion, 1.0, 1.0, 0.0};
  double u = 0, v = 0, peak = 0;
  const auto steps = [&](double begin, double end, auto&& input) {
    const int n = std::max(8, static_cast<int>(std::ceil((end - begin) * w * 60)));
    const double h = (end - begin) / n;
    const auto pull = [&](double t, double x, double y) { return -input(t) - 2 * damping * w * y - w * w * x; };
    for (int i = 0; i < n; ++i) {
      const double t = begin + i * h;
      const double k1 = pull(t, u, v), k2 = pull(t + h / 2, u + h / 2 * v, v + h / 2 * k1),
                   k3 = pull(t + h / 2, u + h / 2 * (v + h / 2 * k1), v + h / 2 * k2),
                   k4 = pull(t + h, u + h * (v + h / 2 * k2), v + h * k3);
      u += h * v + h * h / 6 * (k1 + k2 + k3);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      peak = std::max(peak, std::abs(u));
    }
  };
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double begin = motion.knot_s[i], end = motion.knot_s[i + 1], inside = 1e-9 * (end - begin);
    steps(begin, end,
          [&](double t) { return horizontal_acceleration(shaking, std::clamp(t, begin + inside, end - inside)); });
  }
  const double end = motion.duration_s();
  steps(end, end + period, [](double) { return 0.0; });
  return peak;
}

TEST(ResponseSpectrum, UndampedStepDoublesTheStaticDisplacement) {
  const FloorMotion step = pulse_motion(find_pulse("rectangular"));
  for (const double period : {0.01, 0.1, 0.37, 1.0, 1.99}) {
    const double w = 2 * pi / period;
    EXPECT_NEAR(spectral_displacement_m(step, period, 0) * w * w, 2, 1e-11) << period;
  }
  // Longer than two pulses: the block swings freely from the end on, |u| = 2 sin(w/2) / w^2 for a pulse of 1 s.
  for (const double period : {2.5, 7.0, 40.0}) {
    const double w = 2 * pi / period;
    EXPECT_NEAR(spectral_displacement_m(step, period, 0) * w * w, 2 * std::sin(w / 2), 1e-12) << period;
  }
}

// Damped step: the first peak is 1 + exp(-pi z / sqrt(1 - z^2)) times the static displacement.
TEST(ResponseSpectrum, DampedStepOvershootsByTheTextbookFactor) {
  const FloorMotion step = pulse_motion(find_pulse("rectangular"));
  for (const double z : {0.01, 0.05, 0.3, 0.8})
    for (const double period : {0.02, 0.2, 0.9}) {
      const double w = 2 * pi / period;
      EXPECT_NEAR(spectral_displacement_m(step, period, z) * w * w, 1 + std::exp(-pi * z / std::sqrt(1 - z * z)), 1e-11)
          << z << " " << period;
    }
}

// Undamped oscillator under one sine of period 1: within the pulse u = (sin(wt) w0 ... )/(...), the textbook solution
// u = -(1/(w^2 - W^2)) (sin(W t) - (W/w) sin(w t)), sampled densely; afterwards free vibration.
TEST(ResponseSpectrum, HarmonicPulseFollowsTheClosedForm) {
  const FloorMotion sine = pulse_motion(find_pulse("A"));
  const double W = 2 * pi;
  for (const double period : {0.13, 0.4, 0.77, 1.6, 5.0}) {
    const double w = 2 * pi / period, factor = 1 / (w * w - W * W);
    double peak = 0;
    const int n = 400000;
    for (int i = 0; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      peak = std::max(peak, std::abs(factor * (std::sin(W * t) - W / w * std::sin(w * t))));
    }
    const double u = factor * (-W / w * std::sin(w)), v = factor * (W - W * std::cos(w));
    peak = std::max(peak, std::hypot(u, v / w));
    EXPECT_NEAR(spectral_displacement_m(sine, period, 0), peak, 1e-9 * peak) << period;
  }
}

TEST(ResponseSpectrum, RoughRecordAgreesWithRungeKutta) {
  const FloorMotion record =
      sampled([](double t) { return 3 * std::sin(17 * t) * std::exp(-t) + std::cos(61 * t * t) + 0.3; }, 0.02, 200);
  for (const double z : {0.0, 0.05, 0.4})
    for (const double period : {0.015, 0.05, 0.2, 1.0, 6.0}) {
      const double expected = by_runge_kutta(record, period, z);
      EXPECT_NEAR(spectral_displacement_m(record, period, z), expected, 3e-4 * expected) << z << " " << period;
    }
}

TEST(ResponseSpectrum, LimitsAreTheFloorsAccelerationAndDisplacement) {
  const FloorMotion sine = pulse_motion(find_pulse("A"));
  EXPECT_NEAR(spectral_acceleration_mps2(sine, 0.001), 1, 2e-3);
  EXPECT_NEAR(spectral_displacement_m(sine, 3000), 1 / (2 * pi), 1e-3);
}

TEST(ResponseSpectrum, PulseTablesAgreeWithDenseRecordsOfThemselves) {
  const Pulse pulse = find_pulse("C2");
  const FloorMotion record = sampled([&](double t) { return pulse.at(std::min(t, pulse.duration)).acceleration; },
                                     pulse.duration / 4000, 4001);
  const FloorMotion table = pulse_motion(pulse);
  for (const double period : {0.05, 0.3, 0.9, 2.0, 11.0}) {
    const double sa = spectral_acceleration_mps2(table, period);
    EXPECT_NEAR(spectral_acceleration_mps2(record, period), sa, 3e-6 * sa) << period;
  }
}

// Where the two ways to the forced response meet, they must agree.
TEST(ResponseSpectrum, IsContinuousInThePeriod) {
  const FloorMotion table = pulse_motion(find_pulse("ricker"));
  for (double period = 0.005; period < 0.5; period *= 1.03) {
    const double here = spectral_displacement_m(table, period),
                 next = spectral_displacement_m(table, period * (1 + 1e-9));
    EXPECT_NEAR(here, next, 1e-7 * here) << period;
  }
}

TEST(ResponseSpectrum, MirroredMotionGivesTheSameBits) {
  const auto shape = [](double t) { return std::sin(9 * t) * std::exp(-0.3 * t) + 0.1 * std::cos(70 * t); };
  const FloorMotion motion = sampled(shape, 0.01, 500);
  const FloorMotion mirror = sampled([&](double t) { return -shape(t); }, 0.01, 500);
  for (const double period : {0.03, 0.3, 3.0})
    EXPECT_EQ(spectral_displacement_m(motion, period), spectral_displacement_m(mirror, period));
}

TEST(ResponseSpectrum, RefusesWhatIsNoOscillator) {
  const FloorMotion motion = pulse_motion(find_pulse("A"));
  for (const double period : {0.0, -1.0, std::nan(""), 1 / 0.0})
    EXPECT_THROW(spectral_displacement_m(motion, period), Error);
  for (const double z : {-0.1, 1.0, std::nan("")}) EXPECT_THROW(spectral_displacement_m(motion, 1, z), Error);
}

// Of a rectangle that is short beside every period the pseudo-velocity is its impulse at zero damping; with 5 % the
// first swing falls to exp(-z/sqrt(1-z^2) acos(z)) of it: the intensity is 2.4 s times that.
TEST(HousnerIntensity, OfAnImpulseIsItsVelocityTimesTheRangeOfPeriods) {
  const double T = 1e-4, z = 0.05;
  const FloorMotion rectangle = sampled([](double) { return 1.0; }, T, 2);
  const double expected = T * 2.4 * std::exp(-z / std::sqrt(1 - z * z) * std::acos(z));
  EXPECT_NEAR(housner_intensity_m(rectangle), expected, 1e-3 * expected);
  EXPECT_NEAR(housner_intensity_m(summarize(find_pulse("rectangular")), T), expected, 1e-3 * expected);
}

// Of a pulse it is integrated over a table of the unit pulse, and here over the closed form. Beside a kink of the spectrum,
// where another peak becomes the largest, an ordinate is off by an eighth of the table's step (0.008 in ln T) times the
// change of slope, say 1e-3; of 121 ordinates a few are.
TEST(HousnerIntensity, OfAPulseIsThatOfItsClosedForm) {
  for (const char* name : {"A", "B", "C1", "C2", "rectangular"}) {
    const MotionSummary summary = summarize(find_pulse(name));
    const FloorMotion unit = pulse_motion(find_pulse(name));
    for (const double period : {0.07, 0.5, 1.3, 4.0}) {
      const double exact = housner_intensity_m([&](double T) { return spectral_acceleration_mps2(unit, T / period); });
      EXPECT_NEAR(housner_intensity_m(summary, period), exact, 1e-4 * exact) << name << " " << period;
    }
  }
}

TEST(KeptSpectrum, IsItselfAtItsPeriodsAndCloseBetweenThem) {
  const FloorMotion motion = sampled([](double t) { return std::sin(9 * t * t) * std::exp(-0.3 * t); }, 0.01, 800);
  const std::vector<double> periods = kept_periods_s();
  const ResponseSpectrum spectrum = response_spectrum(motion, periods);
  for (std::size_t i = 1; i < periods.size(); ++i) ASSERT_LT(periods[i - 1], periods[i]);
  for (const double period : {0.02, 0.37, 0.5, 1.0, 1.5, 9.9, 10.0}) {
    EXPECT_TRUE(spectrum.holds(period)) << period;
    EXPECT_EQ(spectrum.at(period), spectral_acceleration_mps2(motion, period)) << period;
  }
  for (const double period : {0.0213, 0.104, 0.375, 1.11, 3.33, 7.77}) {
    EXPECT_FALSE(spectrum.holds(period)) << period;
    EXPECT_NEAR(spectrum.at(period) / spectral_acceleration_mps2(motion, period), 1, 0.01) << period;
  }
  for (const double period : {0.019, 10.1, std::nan("")}) EXPECT_THROW(spectrum.at(period), Error) << period;
}

// Ordinates that are a power of the period are a straight line in logarithms, which a cubic meets everywhere.
TEST(KeptSpectrum, APowerLawIsMetBetweenThePeriodsToo) {
  const std::vector<double> periods{0.1, 0.13, 0.2, 0.4, 0.5};
  std::vector<double> sa_mps2;
  for (const double period : periods) sa_mps2.push_back(3 * std::pow(period, -1.7));
  const ResponseSpectrum power(periods, sa_mps2);
  for (const double period : {0.11, 0.15, 0.3, 0.49}) EXPECT_NEAR(power.at(period), 3 * std::pow(period, -1.7), 1e-12);
}

// Integral of one sine: |F| = 2 W |sin(pi f)| / |W^2 - (2 pi f)^2| for unit period, W = 2 pi.
TEST(FourierSpectrum, OfOneSineIsItsTransform) {
  const FloorMotion sine = pulse_motion(find_pulse("A"));
  const FourierSpectrum spectrum = fourier_spectrum(sine, 1.0 / 1024, 8);
  for (const std::size_t k : {1u, 5u, 12u, 20u, 37u}) {
    const double f = static_cast<double>(k) * spectrum.step_hz, W = 2 * pi, x = 2 * pi * f;
    const double exact = std::abs(f - 1) < 1e-9 ? 0.5 : 2 * W * std::abs(std::sin(x / 2)) / std::abs(W * W - x * x);
    EXPECT_NEAR(spectrum.amplitude_mps[k], exact, 2e-6) << f;
  }
  EXPECT_NEAR(spectrum.amplitude_mps[0], 0, 1e-12);
}

// Parseval: the sum over samples of a^2 dt is twice the integral of |F|^2 over positive frequencies.
TEST(FourierSpectrum, KeepsTheEnergy) {
  const FloorMotion motion = sampled([](double t) { return std::sin(30 * t * t) * std::exp(-t); }, 0.01, 512);
  const FourierSpectrum spectrum = fourier_spectrum(motion, 0.01);
  double energy = 0, bins = 0;
  for (int i = 0; i < 511; ++i) energy += std::pow(horizontal_acceleration({&motion, 1, 1, 0}, i * 0.01), 2) * 0.01;
  energy += std::pow(std::sin(30 * 5.11 * 5.11) * std::exp(-5.11), 2) * 0.01;
  for (std::size_t k = 0; k < spectrum.amplitude_mps.size(); ++k)
    bins += (k == 0 || k + 1 == spectrum.amplitude_mps.size() ? 1 : 2) * std::pow(spectrum.amplitude_mps[k], 2) *
            spectrum.step_hz;
  EXPECT_NEAR(bins, energy, 1e-10);
}

}  // namespace
}  // namespace freestand::motion
