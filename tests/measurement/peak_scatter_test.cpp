// How peaks scatter about a model, against data that are made from it.
#include "measurement/fit/peak_scatter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of tests with so many peaks each, which say of friction between nothing and ten times its logarithm.
class Made {
 public:
  Made(Index tests, Index peaks) : peaks_(static_cast<std::size_t>(tests), peaks), slope_(tests * peaks) {
    for (Index k = 0; k < slope_.size(); ++k)
      slope_[k] = -10.0 * static_cast<double>(k / peaks) / static_cast<double>(tests);
  }

  VectorXd y(double of_friction, double own, double in_common, std::uint64_t key) const {
    test::KeyedRandom random(61, key);
    VectorXd y(slope_.size());
    const Index n = peaks_.front();
    for (Index first = 0; first < y.size(); first += n) {
      const double shift = of_friction * random.normal(), common = std::sqrt(in_common) * random.normal();
      for (Index k = first; k < first + n; ++k)
        y[k] = (slope_[k] * shift + own * (common + std::sqrt(1 - in_common) * random.normal())) /
               std::sqrt(static_cast<double>(n));
    }
    return y;
  }

  PeakScatter scatter(const VectorXd& y, std::size_t numbers = 0) const {
    const std::vector<double> shifts = PeakScatter::shifts();
    const Eigen::Map<const Eigen::RowVectorXd> s(shifts.data(), static_cast<Index>(shifts.size()));
    return {y, slope_ * s / std::sqrt(static_cast<double>(peaks_.front())), peaks_, numbers};
  }

 private:
  std::vector<Index> peaks_;
  VectorXd slope_;
};

// Linear in the shift, y is normal with variance (slope tau)^2 + sigma^2. Of 400 tests tau is known to some 5 %.
TEST(PeakScatter, TellsFrictionFromAllElse) {
  const Made made(400, 1);
  const PeakScatter both = made.scatter(made.y(0.1, 0.2, 0, 1));
  EXPECT_NEAR(both.of_friction(), 0.1, 0.02);
  EXPECT_NEAR(both.own(), 0.2, 0.05);
  EXPECT_LT(both.p_without_friction(), 1e-6);
}

TEST(PeakScatter, OfATestThePeaksGoTogether) {
  const Made made(300, 3);
  const PeakScatter found = made.scatter(made.y(0.08, 0.2, 0.5, 2));
  EXPECT_NEAR(found.of_friction(), 0.08, 0.02);
  EXPECT_NEAR(found.own(), 0.2, 0.05);
}

// As often as it says, and no more, there is friction that does not scatter: at 5 % in 1 to 12 of 100 sets but for one in 250.
TEST(PeakScatter, SeesNoFrictionWhereNoneScatters) {
  const Made made(20, 1);
  const int sets = test::repeats_asked(100);
  int seen = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key)
    seen += made.scatter(made.y(0, 0.2, 0, key)).p_without_friction() <= 0.05;
  EXPECT_LE(seen, test::likely_counts(sets, 0.05).most);
}

// Data that are made again have the covariance that weighing takes away.
TEST(PeakScatter, MakesWhatItWeighs) {
  const Made made(40, 2);
  const PeakScatter scatter = made.scatter(made.y(0.1, 0.15, 0.3, 3));
  constexpr std::uint64_t draws = 4000;
  MatrixXd covariance = MatrixXd::Zero(80, 80);
  for (std::uint64_t s = 0; s < draws; ++s) {
    const VectorXd z = scatter.weighed(scatter.draw(s));
    covariance += z * z.transpose() / static_cast<double>(draws);
  }
  // 3240 numbers, each known to 1/sqrt(4000) = 0.016, of the diagonal 0.022: five deviations. Shifts are taken to 2.5 deviations, whose
  // variance is less by 0.04.
  EXPECT_LT((covariance - MatrixXd::Identity(80, 80)).cwiseAbs().maxCoeff(), 5 * 0.022 + 0.04);
}

// Numbers that were fitted take their share of the scatter.
TEST(PeakScatter, IsWiderWhereNumbersWereFitted) {
  const Made made(12, 1);
  const VectorXd y = made.y(0, 0.2, 0, 4);
  const PeakScatter known = made.scatter(y), fitted = made.scatter(y, 3);
  EXPECT_DOUBLE_EQ(fitted.own(), known.own() * std::sqrt(12.0 / 9));
}

TEST(PeakScatter, WhatIsMetDoesNotScatter) {
  const Made made(10, 2);
  VectorXd y = made.y(0.1, 0.2, 0, 5);
  y.segment(4, 6).setZero();
  const VectorXd drawn = made.scatter(y).draw(0);
  EXPECT_EQ(drawn.segment(4, 6).norm(), 0);
  EXPECT_GT(drawn.norm(), 0);
  const PeakScatter none = made.scatter(VectorXd::Zero(20));
  EXPECT_EQ(none.draw(0).norm(), 0);
  EXPECT_EQ(none.p_without_friction(), 1);
  EXPECT_EQ(none.weighed(y), y);
}

}  // namespace
}  // namespace freestand::measurement
