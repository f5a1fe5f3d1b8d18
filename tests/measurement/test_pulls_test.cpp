// How many degrees of freedom the scatter of friction from test to test has.
#include "measurement/fit/test_pulls.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace freestand::measurement {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of a test that tells its friction, which is the first number of the fit, and another number to these precisions.
Pull telling(double friction, double other) {
  MatrixXd gram = MatrixXd::Zero(3, 3);
  gram(0, 0) = gram(0, 2) = gram(2, 0) = gram(2, 2) = friction;
  gram(1, 1) = other;
  return {gram, VectorXd::Zero(3)};
}

constexpr double tau2 = 0.01, well = 1e7;

TEST(FreedomOfFrictionScatter, IsOfTheTestsThatTellOfIt) {
  EXPECT_NEAR(freedom_of_friction_scatter(std::vector(5, telling(well, well)), tau2), 4, 1e-3);
  std::vector<Pull> three(3, telling(well, well));
  EXPECT_NEAR(freedom_of_friction_scatter(three, tau2), 2, 1e-3);
  three.insert(three.end(), 4, telling(0, well));  // stand still, and tell of the other number as well as any
  EXPECT_NEAR(freedom_of_friction_scatter(three, tau2), 2, 1e-3);
  EXPECT_GT(dispersion_of(three, tau2).freedom / 2, 3);  // of what all tests say of both numbers
  EXPECT_NEAR(freedom_of_friction_scatter(of_first(std::vector(5, telling(well, well)), 0), tau2), 5,
              1e-3);  // friction is known beforehand
}

// Of tests that tell of it more or less well, by simulation: the restricted likelihood's curvature in tau2, -2 ln L = sum ln(tau2 + v) +
// ln sum 1/(tau2 + v) + sum (d - mean)^2/(tau2 + v), whose mean at the true tau2 is half the degrees of freedom over tau2^2.
TEST(FreedomOfFrictionScatter, IsTheCurvatureOfTheRestrictedLikelihood) {
  const std::vector<double> variance = {1e-6, 1e-4, 0.003, 0.01, 0.03, 0.1};
  std::vector<Pull> pulls;
  for (const double v : variance) pulls.push_back(telling(1 / v, 1));
  const auto unlikely = [&](const std::vector<double>& d, double at) {
    double weights = 0, sum = 0, value = 0;
    for (std::size_t i = 0; i < d.size(); ++i) weights += 1 / (at + variance[i]), sum += d[i] / (at + variance[i]);
    for (std::size_t i = 0; i < d.size(); ++i)
      value += std::log(at + variance[i]) + std::pow(d[i] - sum / weights, 2) / (at + variance[i]);
    return value + std::log(weights);
  };
  constexpr int sets = 20000;
  constexpr double h = 1e-3;
  double mean = 0, square = 0;
  for (std::uint64_t s = 0; s < sets; ++s) {
    std::vector<double> d;
    for (std::size_t i = 0; i < variance.size(); ++i)
      d.push_back(std::sqrt(tau2 + variance[i]) * random::standard_normal(77, s, i));
    const double curved =
        tau2 * tau2 * (unlikely(d, tau2 + h) - 2 * unlikely(d, tau2) + unlikely(d, tau2 - h)) / (h * h);
    mean += curved / sets, square += curved * curved / sets;
  }
  EXPECT_NEAR(freedom_of_friction_scatter(pulls, tau2), mean, 4 * std::sqrt((square - mean * mean) / sets));
}

}  // namespace
}  // namespace freestand::measurement
