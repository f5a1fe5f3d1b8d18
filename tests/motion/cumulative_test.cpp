// Arias intensity, cumulative absolute velocity and durations against closed forms.
#include "motion/cumulative.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/units.hpp"
#include "motion/pulse.hpp"
#include "motion/summary.hpp"

namespace freestand::motion::cumulative_test {
namespace {

constexpr double pi = std::numbers::pi;

FloorMotion constant(double a, double duration) {
  return piecewise_linear("constant", duration / 100, std::vector<double>(101, a));
}

// `cycles` of a sine of amplitude a and period T, in many straight lines.
FloorMotion sine(int cycles, double a, double T) {
  std::vector<double> values;
  const int each = 2000;
  for (int i = 0; i <= cycles * each; ++i) values.push_back(a * std::sin(2 * pi * i / each));
  return piecewise_linear("sine", T / each, values);
}

TEST(Cumulative, OfAConstant) {
  const FloorMotion motion = constant(-2, 6);
  EXPECT_NEAR(arias_intensity_mps(motion), pi / (2 * standard_gravity_mps2) * 4 * 6, 1e-12);
  EXPECT_NEAR(cumulative_absolute_velocity_mps(motion), 12, 1e-12);
  EXPECT_NEAR(significant_duration_s(motion, 0.05, 0.75), 0.7 * 6, 1e-12);
  EXPECT_NEAR(significant_duration_s(motion, 0.05, 0.95), 0.9 * 6, 1e-12);
  EXPECT_NEAR(bracketed_duration_s(motion, 2), 6, 1e-12);
  EXPECT_EQ(bracketed_duration_s(motion, 2.001), 0);
}

// n cycles: integral of a^2 = n T a^2/2, of |a| = n T 2 a/pi; straight lines between samples take off (w dt)^2/6 and /12 of them.
// Of five cycles the shares are reached a quarter of a cycle after a zero, in proportion to time.
TEST(Cumulative, OfASineOfManyCycles) {
  const int n = 5;
  const double a = 3, T = 0.4, chords = std::pow(2 * pi / 2000, 2);
  const FloorMotion motion = sine(n, a, T);
  const double arias = pi / (2 * standard_gravity_mps2) * n * T * a * a / 2, cav = n * T * 2 * a / pi;
  EXPECT_NEAR(arias_intensity_mps(motion), arias * (1 - chords / 6), 1e-10 * arias);
  EXPECT_NEAR(cumulative_absolute_velocity_mps(motion), cav * (1 - chords / 12), 1e-10 * cav);
  EXPECT_NEAR(significant_duration_s(motion, 0.05, 0.75), 0.7 * n * T, 1e-9);
  EXPECT_NEAR(significant_duration_s(motion, 0.05, 0.95), 0.9 * n * T, 1e-9);
  // From asin(1/2) of the first half cycle to the same before the end of the last; the chord lies (w dt)^2/8 lower.
  EXPECT_NEAR(bracketed_duration_s(motion, 1.5), n * T - 2 * T / 12, chords * T);
}

// A triangle, up to 1 s and down again: the share of its square that is reached at t is t^3/2 up to the top.
TEST(Cumulative, OfATriangleWithinItsLines) {
  const FloorMotion motion = piecewise_linear("triangle", 1, {0, 4, 0});
  EXPECT_NEAR(arias_intensity_mps(motion), pi / (2 * standard_gravity_mps2) * 2 * 16.0 / 3, 1e-13);
  EXPECT_NEAR(cumulative_absolute_velocity_mps(motion), 4, 1e-14);
  EXPECT_NEAR(significant_duration_s(motion, 0.05, 0.5), 1 - std::cbrt(0.1), 1e-14);
  EXPECT_NEAR(significant_duration_s(motion, 0.05, 0.95), 2 - 2 * std::cbrt(0.1), 1e-14);
  EXPECT_NEAR(bracketed_duration_s(motion, 1), 1.5, 1e-14);  // from 1/4 s to 7/4 s
  const FloorMotion through = piecewise_linear("through zero", 1, {2, -2});
  EXPECT_NEAR(cumulative_absolute_velocity_mps(through), 1, 1e-14);
}

TEST(Cumulative, OfAStillFloorIsZero) {
  const FloorMotion still = constant(0, 3);
  EXPECT_EQ(arias_intensity_mps(still), 0);
  EXPECT_EQ(cumulative_absolute_velocity_mps(still), 0);
  EXPECT_EQ(significant_duration_s(still, 0.05, 0.95), 0);
  EXPECT_EQ(bracketed_duration_s(still, 0.1), 0);
}

// A unit pulse B is one cosine: integral of a^2 = 1/2, of |a| = 2/pi.
TEST(Cumulative, OfAPulseInClosedForm) {
  const MotionSummary pulse = summarize(find_pulse("B"));
  EXPECT_NEAR(pulse.arias_mps, pi / (2 * standard_gravity_mps2) / 2, 1e-10);
  EXPECT_NEAR(pulse.cav_mps, 2 / pi, 1e-10);
}

}  // namespace
}  // namespace freestand::motion::cumulative_test
