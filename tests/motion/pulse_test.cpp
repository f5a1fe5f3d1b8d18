#include "motion/pulse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <freestand/error.hpp>
#include <random>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse_family.hpp"
#include "support/data.hpp"

namespace freestand::motion {
namespace {

const std::vector<std::string> every_pulse = {"A",   "B",           "C1",     "C2",     "C3",
                                              "C11", "rectangular", "square", "ricker", "ricker_antisymmetric"};

class EveryPulse : public testing::TestWithParam<std::string> {
 protected:
  const Pulse pulse = find_pulse(GetParam());
  const FloorMotion table = pulse_motion(pulse);
};

INSTANTIATE_TEST_SUITE_P(Pulse, EveryPulse, testing::ValuesIn(every_pulse), [](const auto& one) { return one.param; });

// Numeric integration that knows nothing of the closed forms of v and u: Gauss's rule of three points on small steps.
struct Integrated {
  double velocity = 0, displacement = 0, peak_velocity = 0, peak_displacement = 0;
};
Integrated integrate(const Pulse& pulse, double until) {
  Integrated now;
  for (std::size_t piece = 0; piece + 1 < pulse.breaks.size(); ++piece) {
    const double begin = pulse.breaks[piece], end = std::min(until, pulse.breaks[piece + 1]);
    if (end <= begin) break;
    const int steps = 4000;
    const double h = (end - begin) / steps, node[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
    for (int i = 0; i < steps; ++i) {
      double change = 0, moment = 0;
      for (int k = 0; k < 3; ++k) {
        const double part = pulse.at(begin + (i + node[k]) * h).acceleration * h * (k == 1 ? 8.0 : 5.0) / 18;
        change += part;
        moment += part * (1 - node[k]) * h;
      }
      now.displacement += h * now.velocity + moment;
      now.velocity += change;
      now.peak_velocity = std::max(now.peak_velocity, std::abs(now.velocity));
      now.peak_displacement = std::max(now.peak_displacement, std::abs(now.displacement));
    }
  }
  return now;
}

TEST_P(EveryPulse, VelocityAndDisplacementAreTheIntegralsOfTheAcceleration) {
  for (const double share : {0.13, 0.37, 0.5, 0.61, 0.94, 1.0}) {
    const double t = share * pulse.duration;
    const Integrated numeric = integrate(pulse, t);
    EXPECT_NEAR(pulse.at(t).velocity, numeric.velocity, 1e-12) << t;
    EXPECT_NEAR(pulse.at(t).displacement, numeric.displacement, 1e-12) << t;
  }
}

TEST_P(EveryPulse, StartsFromRestAndPeaksWhereItSays) {
  EXPECT_NEAR(pulse.at(0).velocity, 0, 3e-16);
  EXPECT_NEAR(pulse.at(0).displacement, 0, 3e-16);
  const Integrated numeric = integrate(pulse, pulse.duration);
  EXPECT_NEAR(pulse.peak_velocity, numeric.peak_velocity, 1e-5 * pulse.peak_velocity);
  EXPECT_NEAR(pulse.peak_displacement, numeric.peak_displacement, 1e-5 * pulse.peak_displacement);
  const MotionPeaks exact = peaks(table);
  EXPECT_NEAR(exact.pga_mps2, 1, 1e-14);
  EXPECT_NEAR(exact.pgv_mps, pulse.peak_velocity, 1e-14);
  EXPECT_NEAR(exact.pgd_m, pulse.peak_displacement, 1e-14);
}

TEST_P(EveryPulse, TableAgreesWithTheClosedFormAtRandomTimes) {
  std::mt19937_64 random(7);
  const Shaking shaking{&table, 1.0, 1.0, 0.0};
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double t = static_cast<double>(random() >> 11) * 0x1p-53 * pulse.duration;
    worst = std::max(worst, std::abs(horizontal_acceleration(shaking, t) - pulse.at(t).acceleration));
  }
  EXPECT_LT(worst, 2e-13);
  EXPECT_DOUBLE_EQ(table.duration_s(), pulse.duration);
  EXPECT_EQ(table.knot_s.front(), 0);
  EXPECT_LE(table.degree, 7);
  EXPECT_EQ(horizontal_acceleration(shaking, pulse.duration * 1.0000001), 0);
}

TEST_P(EveryPulse, JumpsAreKnots) {
  for (const double jump : pulse.breaks)
    EXPECT_TRUE(std::find(table.knot_s.begin(), table.knot_s.end(), jump) != table.knot_s.end()) << jump;
}

TEST_P(EveryPulse, PeakVelocityAndPeakAccelerationBelongTogether) {
  const double a = acceleration_of_peak_velocity(pulse, 0.7, 0.45);
  EXPECT_NEAR(scaled(peaks(table), a, 0.45).pgv_mps, 0.7, 1e-14);
}

TEST(Pulse, PhasesOfTheCPulsesAreThoseOfTheReport) {
  EXPECT_NEAR(c_pulse_phase_rad(1) / pi, 0.0697, 5e-5);
  EXPECT_NEAR(c_pulse_phase_rad(2) / pi, 0.0410, 5e-5);
}

// With y = (n + 1/2) pi - phi the condition reads tan(y) = y: the extrema of the spherical Bessel function j_0.
TEST(Pulse, PhasesSolveTanYEqualsY) {
  for (const int n : {1, 2, 3, 7, 40, 200}) {
    const double phi = c_pulse_phase_rad(n), y = (n + 0.5) * pi - phi;
    EXPECT_NEAR(std::tan(phi) * y, 1, 1e-12) << n;
    EXPECT_GT(phi, 0);
  }
  EXPECT_NEAR(1.5 * pi - c_pulse_phase_rad(1), 4.493409457909064, 1e-14);
  EXPECT_NEAR(2.5 * pi - c_pulse_phase_rad(2), 7.725251836937707, 1e-14);
}

TEST(Pulse, ThoseThatShouldEndAtRestDo) {
  for (const std::string& name : every_pulse) {
    if (name == "rectangular") continue;
    const Pulse pulse = find_pulse(name);
    EXPECT_NEAR(pulse.at(pulse.duration).velocity, 0, 2e-15) << name;
    const bool displaced = name == "A" || name == "square";
    const bool returns = std::abs(pulse.at(pulse.duration).displacement) < 2e-15;
    EXPECT_EQ(returns, !displaced) << name;
  }
}

TEST(Pulse, VelocityAmplitudeIsThatOfTheReport) {
  const double v = 0.6, T = 0.8, w = 2 * pi / T;
  EXPECT_NEAR(acceleration_of_velocity_amplitude(find_pulse("A"), v, T), w * v / 2, 1e-14);
  EXPECT_NEAR(acceleration_of_velocity_amplitude(find_pulse("B"), v, T), w * v, 1e-14);
  EXPECT_NEAR(acceleration_of_velocity_amplitude(find_pulse("C1"), v, T), w * v, 1e-14);
  const double phi = c_pulse_phase_rad(1);
  EXPECT_NEAR(acceleration_of_peak_velocity(find_pulse("C1"), v, T), w * v / (1 + std::sin(phi)), 1e-14);
}

TEST(Pulse, RickerHasItsSpectralPeakAtItsPeriod) {
  // |F(f)| = (2 / sqrt(pi)) f^2 exp(-f^2) for unit period: its derivative vanishes at f = 1.
  const Pulse ricker = find_pulse("ricker");
  const auto amplitude = [&](double f) {
    double sum = 0;
    const int n = 4000;
    for (int i = 0; i <= n; ++i) {
      const double t = ricker.duration * i / n;
      sum += ricker.at(t).acceleration * std::cos(2 * pi * f * (t - 2));
    }
    return sum * ricker.duration / n;
  };
  for (const double f : {0.5, 1.0, 1.7})
    EXPECT_NEAR(amplitude(f), 2 / std::sqrt(pi) * f * f * std::exp(-f * f), 1e-13) << f;
}

TEST(Pulse, NamesAreFoundWhateverTheCaseAndUnknownOnesAreRefused) {
  EXPECT_EQ(find_pulse("c7").name, "C7");
  EXPECT_EQ(find_pulse("sine").name, "A");
  EXPECT_EQ(find_pulse("cosine").name, "B");
  EXPECT_EQ(find_pulse("Ricker").name, "ricker");
  for (const char* wrong : {"", "D", "C", "C0", "C-1", "C01", "C1x", "Cn", "C999999999999"}) {
    try {
      find_pulse(wrong);
      ADD_FAILURE() << wrong << " was found";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(),
                  testing::HasSubstr("A, sine, one_sine, B, cosine, one_cosine, Cn, rectangular, ricker"));
      EXPECT_EQ(error.exit(), Exit::usage);
    }
  }
}

TEST(Pulse, EveryFileIsInTheRegistry) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "src" / "motion")) {
    const std::string name = entry.path().filename().string();
    files += name.rfind("pulse_", 0) == 0 && entry.path().extension() == ".cpp" && name != "pulse_table.cpp" &&
             name != "pulse_fit.cpp";
  }
  EXPECT_EQ(registry<PulseFamily>().size(), files);
}

}  // namespace
}  // namespace freestand::motion
