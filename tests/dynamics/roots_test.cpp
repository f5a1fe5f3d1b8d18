// First roots of witnesses: polynomials with known roots, and with no root at all.
#include "dynamics/roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "support/keyed_random.hpp"

namespace freestand::dynamics {
namespace {

using test::KeyedRandom;
constexpr int N = max_root_order;
using Witness = Series<double, N>;

// Product of (1 - x/root) and of (x - a)^2 + b^2, times what `scale` says.
Witness with_roots(const std::vector<double>& roots, const std::vector<std::pair<double, double>>& pairs,
                   double scale) {
  Witness c = Witness::zero();
  c[0] = scale;
  const auto times = [&](double c0, double c1, double c2) {
    for (int k = N; k >= 0; --k) c[k] = c0 * c[k] + (k > 0 ? c1 * c[k - 1] : 0) + (k > 1 ? c2 * c[k - 2] : 0);
  };
  for (const double root : roots) times(1, -1 / root, 0);
  for (const auto& [a, b] : pairs) times(a * a + b * b, -2 * a, 1);
  return c;
}

std::optional<double> first(const Witness& c, double h, ZeroTolerance zero = {0, 0.0}) {
  double tau = -1;
  return first_root(c, h, zero, tau) ? std::optional(tau) : std::nullopt;
}

TEST(Roots, FirstOfManyIsFound) {
  int found = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    KeyedRandom random(901, i);
    std::vector<double> roots;
    std::vector<std::pair<double, double>> pairs;
    const int real = static_cast<int>(random.uniform(0, 6)), complex = static_cast<int>(random.uniform(0, 3));
    const double unit = random.log_uniform(1e-4, 1e4);
    for (int k = 0; k < real; ++k) roots.push_back(unit * random.uniform(0.02, 3) * (random.chance(0.2) ? -1 : 1));
    for (int k = 0; k < complex; ++k) pairs.emplace_back(unit * random.uniform(-1, 2), unit * random.uniform(0.05, 1));
    std::sort(roots.begin(), roots.end());
    bool close = false;  // roots so close that round-off makes or unmakes them
    for (std::size_t k = 1; k < roots.size(); ++k) close = close || roots[k] - roots[k - 1] < 0.01 * unit;
    const auto positive = std::find_if(roots.begin(), roots.end(), [](double root) { return root > 0; });
    const bool any = positive != roots.end() && *positive < unit;
    if (close || (positive != roots.end() && std::abs(*positive - unit) < 1e-6 * unit)) continue;
    const auto tau = first(with_roots(roots, pairs, random.log_uniform(1e-6, 1e6)), unit);
    ASSERT_EQ(tau.has_value(), any) << i;
    if (any) {
      EXPECT_NEAR(*tau, *positive, 1e-9 * unit) << i;
    }
    found += any;
  }
  EXPECT_GT(found, 4000);
}

TEST(Roots, TwoCrossingsWithinAStepAreSeen) {
  for (const double gap : {1e-2, 1e-4, 1e-6}) {
    const auto tau = first(with_roots({0.5, 0.5 + gap, 4, 5}, {}, 1), 1);
    ASSERT_TRUE(tau.has_value()) << gap;
    EXPECT_NEAR(*tau, 0.5, 1e-8) << gap;
  }
}

TEST(Roots, AWitnessThatStaysAboveHasNone) {
  for (const double above : {1e-1, 1e-3, 1e-6, 1e-9})
    EXPECT_FALSE(first(with_roots({}, {{0.4, above}}, 1), 1)) << above;
}

TEST(Roots, ARootAtTheStartIsDividedOut) {
  Witness c = Witness::zero();  // x (1 - x)
  c[1] = 1;
  c[2] = -1;
  EXPECT_NEAR(*first(c, 2), 1, 1e-15);
  EXPECT_FALSE(first(c, 0.99));
  c[1] = -1;
  EXPECT_EQ(*first(c, 2), 0);  // it falls at once
  EXPECT_EQ(sign_after(c, {0, 0.0}), -1);
}

TEST(Roots, TinyRootsKeepTheirDigits) {
  Witness c = Witness::zero();
  c[0] = 1e-12;
  c[1] = -3;
  c[2] = 0.7;
  EXPECT_NEAR(*first(c, 1) * 3e12, 1, 1e-12);
}

TEST(Roots, RoundOffIsNoRoot) {
  Witness c = Witness::zero();
  c[0] = 1e-17;
  c[1] = -1e-13;
  EXPECT_FALSE(first(c, 1, {0, 1e-11}));
  EXPECT_EQ(sign_after(c, {0, 1e-11}), 0);
}

TEST(Roots, LargestMagnitudeOverAStep) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    KeyedRandom random(902, i);
    Witness c;
    for (int k = 0; k <= N; ++k) c[k] = random.uniform(-1, 1);
    double most = 0;
    for (int k = 0; k <= 20000; ++k) most = std::max(most, std::abs(c.at(1.5 * k / 20000)));
    EXPECT_NEAR(max_abs(c, 1.5, 0.0), most, 1e-7 * most) << i;
    EXPECT_EQ(max_abs(c, 1.5, 2 * most), 2 * most);
  }
}

}  // namespace
}  // namespace freestand::dynamics
