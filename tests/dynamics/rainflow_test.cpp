#include "dynamics/rainflow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/random.hpp"

namespace freestand::dynamics::rainflow_test {
namespace {

double amplitude(const std::vector<double>& load) {
  Rainflow cycles;
  for (const double x : load) cycles.see(x);
  return cycles.amplitude();
}

// By the table of ranges and their counts.
double by_table(const std::map<double, double>& counts) {
  double sum = 0;
  for (const auto& [range, count] : counts) sum += count * std::pow(range / 2, 3);
  return std::cbrt(sum);
}

// The example of ASTM E1049-85, figure 6.
TEST(Rainflow, CountsTheExampleOfTheStandard) {
  EXPECT_NEAR(amplitude({-2, 1, -3, 5, -1, 3, -4, 4, -2}), by_table({{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1}, {9, 0.5}}),
              1e-14);
}

TEST(Rainflow, OfEqualCyclesGrowsWithTheCubeRootOfTheirNumber) {
  std::vector<double> load{0};
  for (int i = 0; i < 1000; ++i) load.insert(load.end(), {1, -1});
  // From 0 to 1 at the start; then 999 ranges of 2 down and up again, the last of them down alone.
  EXPECT_NEAR(amplitude(load), by_table({{1, 0.5}, {2, 999.5}}), 1e-10);
  EXPECT_EQ(amplitude({}), 0);
  EXPECT_EQ(amplitude({2, 2, 2}), 0);
  EXPECT_DOUBLE_EQ(amplitude({0, 1}), std::cbrt(0.5) / 2);
}

TEST(Rainflow, LooksAtTurningPointsAlone) {
  EXPECT_DOUBLE_EQ(amplitude({0, 1, 2, 2, 3, 1, 1, -1, -1, 0}), amplitude({0, 3, -1, 0}));
}

// ASTM E1049-85, 5.4.4: ranges X and Y, X the latest; Y is half a cycle where it holds the start, else a cycle, once X is as large.
double by_the_standard(std::vector<double> points) {
  double sum = 0;
  std::vector<double> stack;
  const auto range = [](double a, double b) { return std::abs(a - b); };
  for (const double point : points) {
    stack.push_back(point);
    while (stack.size() >= 3) {
      const std::size_t n = stack.size();
      const double x = range(stack[n - 1], stack[n - 2]), y = range(stack[n - 2], stack[n - 3]);
      if (x < y) break;
      if (n == 3) {
        sum += 0.5 * std::pow(y / 2, 3);
        stack.erase(stack.begin());
      } else {
        sum += std::pow(y / 2, 3);
        stack.erase(stack.end() - 3, stack.end() - 1);
      }
    }
  }
  for (std::size_t i = 1; i < stack.size(); ++i) sum += 0.5 * std::pow(range(stack[i], stack[i - 1]) / 2, 3);
  return std::cbrt(sum);
}

TEST(Rainflow, OfRandomLoadsIsWhatTheStandardCounts) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::vector<double> points{0};
    double up = 1;
    for (std::uint64_t i = 0; i < 5 + seed; ++i, up = -up)
      points.push_back(points.back() + up * random::uniform(seed, i, random::stable_hash("range")));
    EXPECT_NEAR(amplitude(points), by_the_standard(points), 1e-12) << seed;
  }
}

}  // namespace
}  // namespace freestand::dynamics::rainflow_test
