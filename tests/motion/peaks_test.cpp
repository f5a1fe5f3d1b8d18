#include "motion/peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>

#include "motion/polynomial.hpp"
#include "motion/pulse.hpp"

namespace freestand::motion {
namespace {

// a = 1 - t on [0, 2]: v = t - t^2/2 peaks between the knots of the second one, u grows to 2/3.
TEST(Peaks, OfALineAreFoundBetweenTheKnots) {
  const FloorMotion line = piecewise_linear("line", 2, {1, -1});
  const MotionPeaks p = peaks(line);
  EXPECT_DOUBLE_EQ(p.pga_mps2, 1);
  EXPECT_DOUBLE_EQ(p.pgv_mps, 0.5);
  EXPECT_DOUBLE_EQ(p.pgd_m, 2.0 / 3);
}

TEST(Peaks, OfAMissingVerticalChannelAreZeroAndOfAPresentOneItsOwn) {
  EXPECT_EQ(peaks(piecewise_linear("x", 1, {1, 2}), Channel::vertical).pga_mps2, 0);
  EXPECT_EQ(peaks(piecewise_linear("x", 1, {1, 2}, {0, -5}), Channel::vertical).pga_mps2, 5);
}

TEST(Peaks, ScaleAndStretchAsTheDimensionsSay) {
  const MotionPeaks p = scaled({1, 2, 3}, -2, 3);
  EXPECT_EQ(p.pga_mps2, 2);
  EXPECT_EQ(p.pgv_mps, 12);
  EXPECT_EQ(p.pgd_m, 54);
}

TEST(Peaks, MirroredMotionGivesTheSameBits) {
  std::vector<double> a, b;
  for (int i = 0; i < 1000; ++i) {
    a.push_back(std::sin(0.1 * i) * std::exp(-0.003 * i) + 0.1 * std::sin(2.7 * i));
    b.push_back(-a.back());
  }
  const MotionPeaks p = peaks(piecewise_linear("a", 0.01, a)), q = peaks(piecewise_linear("b", 0.01, b));
  EXPECT_EQ(p.pga_mps2, q.pga_mps2);
  EXPECT_EQ(p.pgv_mps, q.pgv_mps);
  EXPECT_EQ(p.pgd_m, q.pgd_m);
}

TEST(Peaks, HistoryIsTheIntegralAndReachesTheEnd) {
  const Pulse pulse = find_pulse("C1");
  const FloorMotion table = pulse_motion(pulse);
  const int n = 97;
  const FloorHistory history = floor_history(table, pulse.duration / n);
  ASSERT_EQ(history.velocity_mps.size(), static_cast<std::size_t>(n) + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    const PulseState state = pulse.at(std::min(pulse.duration, static_cast<double>(i) * history.step_s));
    EXPECT_NEAR(history.acceleration_mps2[i], state.acceleration, 1e-13);
    EXPECT_NEAR(history.velocity_mps[i], state.velocity, 1e-13);
    EXPECT_NEAR(history.displacement_m[i], state.displacement, 1e-13);
  }
  EXPECT_THROW(floor_history(table, 0), Error);
}

TEST(Polynomial, RootsOfAChebyshevPolynomialAreAllFound) {
  // T_6(2x - 1) = 2048x^6 - 6144x^5 + 6912x^4 - 3584x^3 + 840x^2 - 72x + 1, roots (1 + cos((2k+1) pi/12))/2.
  Polynomial p;
  p.degree = 6;
  p.c = {1, -72, 840, -3584, 6912, -6144, 2048};
  const Roots roots = sign_changes(p, 1);
  ASSERT_EQ(roots.count, 6);
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(roots.at[static_cast<std::size_t>(5 - k)], (1 + std::cos((2 * k + 1) * 3.14159265358979324 / 12)) / 2,
                1e-13);
  EXPECT_NEAR(peak(p, 1), 1, 1e-12);
}

TEST(Polynomial, DoubleRootsAreNoSignChangesButTripleOnesAre) {
  Polynomial twice;
  twice.degree = 2;
  twice.c = {0.25, -1, 1};  // (x - 1/2)^2
  EXPECT_EQ(sign_changes(twice, 1).count, 0);
  Polynomial thrice;
  thrice.degree = 3;
  thrice.c = {-0.125, 0.75, -1.5, 1};  // (x - 1/2)^3
  ASSERT_EQ(sign_changes(thrice, 1).count, 1);
  EXPECT_NEAR(sign_changes(thrice, 1).at[0], 0.5, 1e-4);
}

}  // namespace
}  // namespace freestand::motion
