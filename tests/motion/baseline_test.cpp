#include "motion/baseline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motion/peaks.hpp"

namespace freestand::motion::baseline_test {
namespace {

// A sensor's offset on a floor that does not move is all trend.
TEST(Baseline, OffsetIsTakenAwayOnBothChannels) {
  const std::vector<double> offset(2001, 0.25);
  const FloorMotion repaired = remove_baseline(piecewise_linear("x", 0.01, offset, offset), Baseline::linear);
  EXPECT_NEAR(peaks(repaired).pgv_mps, 0, 1e-12);
  EXPECT_NEAR(peaks(repaired, Channel::vertical).pgv_mps, 0, 1e-12);
}

// The line through 0 that fits v = sin(t) over [0, 2 pi] best has the slope integral(t sin t)/integral(t^2) = -6/(8
// pi^2).
TEST(Baseline, TrendIsTheLeastSquaresLine) {
  std::vector<double> cosine;
  const int n = 4000;
  const double step = 2 * 3.14159265358979323846 / n;
  for (int i = 0; i <= n; ++i) cosine.push_back(std::cos(i * step));
  const FloorMotion before = piecewise_linear("cosine", step, cosine),
                    after = remove_baseline(before, Baseline::linear);
  EXPECT_NEAR(after.horizontal_mps2[0] - before.horizontal_mps2[0], 6 / (8 * 9.8696044010893586), 1e-6);
  EXPECT_EQ(after.horizontal_mps2[1], before.horizontal_mps2[1]);
}

constexpr double step = 0.005;

// A floor that shakes for a while and comes back.
std::vector<double> shaking() {
  std::vector<double> a;
  for (int i = 0; i <= 4000; ++i) {
    const double t = i * step;
    a.push_back(std::pow(std::sin(std::numbers::pi * t / 20), 2) * (3 * std::sin(9.3 * t) + std::sin(31 * t + 1)));
  }
  return a;
}

double largest_difference(const FloorMotion& a, const FloorMotion& b) {
  double most = 0;
  const FloorHistory of_a = floor_history(a, step), of_b = floor_history(b, step);
  for (std::size_t i = 0; i < of_a.displacement_m.size(); ++i)
    most = std::max(most, std::abs(of_a.displacement_m[i] - of_b.displacement_m[i]));
  return most;
}

// What was taken off once is gone, so that a record without a baseline comes back from under any that is added.
TEST(Baseline, ARecordComesBackFromUnderAParabolaOfDisplacement) {
  const FloorMotion level = remove_baseline(piecewise_linear("level", step, shaking()), Baseline::linear);
  FloorMotion bent = level;
  for (std::size_t i = 0; i < bent.segments(); ++i) bent.horizontal_mps2[2 * i] += 0.02;  // 4 m after 20 s
  EXPECT_GT(largest_difference(level, bent), 3.9);
  EXPECT_LT(largest_difference(level, remove_baseline(bent, Baseline::linear)), 1e-11);
}

TEST(Baseline, ARecordComesBackFromUnderACubicOfDisplacement) {
  const FloorMotion level = remove_baseline(piecewise_linear("level", step, shaking()), Baseline::quadratic);
  FloorMotion bent = level;
  for (std::size_t i = 0; i < bent.segments(); ++i) {
    bent.horizontal_mps2[2 * i] += 0.03 - 0.004 * bent.knot_s[i];
    bent.horizontal_mps2[2 * i + 1] -= 0.004;
  }
  EXPECT_LT(largest_difference(level, remove_baseline(bent, Baseline::quadratic)), 1e-11);
  EXPECT_GT(largest_difference(level, remove_baseline(bent, Baseline::linear)), 0.1);  // a line is no parabola
}

// v = t^2 on [0, 1] is a parabola itself; by a line 3/4 t comes nearest: a = 2 t - 3/4 is left.
TEST(Baseline, OfAParabolaIsThatParabola) {
  std::vector<double> a;
  for (int i = 0; i <= 100; ++i) a.push_back(0.02 * i);
  const FloorMotion motion = piecewise_linear("parabola", 0.01, a);
  EXPECT_NEAR(peaks(remove_baseline(motion, Baseline::quadratic)).pga_mps2, 0, 1e-13);
  EXPECT_NEAR(remove_baseline(motion, Baseline::linear).horizontal_mps2[0], -0.75, 1e-13);
}

}  // namespace
}  // namespace freestand::motion::baseline_test
