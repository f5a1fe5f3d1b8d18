// Intervals by leaving out groups in turn.
#include "fragility/jackknife.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fragility/groups.hpp"

namespace freestand::fragility {
namespace {

// By hand: ln of left out 0, 1, 2, 3 about 1.5: V = 3/4 * 5 = 3.75; they scatter less than normal ones (k < 0), so 3 degrees of freedom.
TEST(PositiveLimits, AreStudentsOfTheLogarithm) {
  const PositiveLimits found(5, {{1, std::exp(1), std::exp(2), std::exp(3)}});
  const double reach = gsl_cdf_tdist_Qinv(0.05, 3) * std::sqrt(3.75);
  EXPECT_NEAR(std::log(found.upper(0.05) / 5), reach, 1e-12);
  EXPECT_NEAR(std::log(found.lower(0.05) / 5), -reach, 1e-12);
}

// One group of twenty makes all of the scatter: ln left out are 19 times 0 and once 20; V = 19/20 * 20 * 19 = 361, and the unbiased
// kurtosis of one outlier among n is n: f = 2/(2/19 + 20/20) = 38/21.
TEST(PositiveLimits, HaveFewDegreesOfFreedomWhereOneGroupMakesTheScatter) {
  std::vector<double> left_out(19, 1.0);
  left_out.push_back(std::exp(20));
  EXPECT_NEAR(std::log(PositiveLimits(1, {left_out}).upper(0.05)), gsl_cdf_tdist_Qinv(0.05, 38.0 / 21) * 19, 1e-9);
}

TEST(PositiveLimits, AddVariancesOfStrata) {
  const std::vector<double> one{1, 2, 3}, two{1, 1.5, 2};
  const auto variance = [](const std::vector<double>& values) {
    std::vector<double> logarithms;
    for (const double value : values) logarithms.push_back(std::log(value));
    return jackknife_variance(logarithms);
  };
  const double a = variance(one), b = variance(two), freedom = (a + b) * (a + b) / (a * a / 2 + b * b / 2);
  EXPECT_NEAR(std::log(PositiveLimits(1, {one, two, {7}}).upper(0.05)),
              gsl_cdf_tdist_Qinv(0.05, freedom) * std::sqrt(a + b), 1e-12);
}

// Three records, of which the second has no samples, beside hashed groups: the mix of records and others stays as it was.
TEST(LeavingOut, KeepsTheMixOfTheStudy) {
  Options options;
  options.motion_group = {0, 1, 2, -1};
  const MotionGroups groups(options);
  std::vector<bool> there(static_cast<std::size_t>(groups.count()), false);
  there[0] = there[2] = there[3] = there[4] = there[5] = true;
  const Resampling resampling(groups, there, 2, 1);
  ASSERT_EQ(resampling.left_out(), 2 + 3);
  EXPECT_EQ(resampling.left_out_records(), 2);
  Eigen::MatrixXd counts = Eigen::MatrixXd::Zero(groups.count(), 2);  // of records, of others
  for (int g = 0; g < groups.count(); ++g)
    if (there[static_cast<std::size_t>(g)]) counts(g, g < 3 ? 0 : 1) = 1;
  counts(0, 0) = 5;
  const Eigen::MatrixXd without = resampling.totals_left_out(counts);
  EXPECT_DOUBLE_EQ(without(0, 0), 2 * 1.0);
  EXPECT_DOUBLE_EQ(without(1, 0), 2 * 5.0);
  for (int i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(without(i, 1), 3.0);
  EXPECT_DOUBLE_EQ(without(4, 0), 6.0);
}

TEST(PositiveLimits, AreUnknownWhereOneGroupMakesAllOfTheNumber) {
  EXPECT_FALSE(PositiveLimits(1, {{1, 2, 0}}).known());
  EXPECT_FALSE(PositiveLimits(0, {{0, 0, 0}}).known());
  EXPECT_FALSE(PositiveLimits(1, {{1}}).known());
}

}  // namespace
}  // namespace freestand::fragility
