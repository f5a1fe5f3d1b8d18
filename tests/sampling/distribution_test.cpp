#include "sampling/distribution.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace freestand::sampling {
namespace {

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

TEST(Distribution, QuantilesAgreeWithTheirClosedForms) {
  EXPECT_EQ(quantile(Fixed{0.6}, 0.123), 0.6);
  EXPECT_DOUBLE_EQ(quantile(Uniform{-1, 3}, 0.25), 0);
  EXPECT_DOUBLE_EQ(quantile(LogUniform{0.01, 100}, 0.75), 10);
  EXPECT_NEAR(quantile(Normal{2, 3}, 0.975), 2 + 3 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(quantile(Lognormal{0.2, 0.3}, 0.8413447460685429), 0.2 * std::exp(0.3), 1e-12);
  EXPECT_DOUBLE_EQ(quantile(Lognormal{0.2, 0.3}, 0.5), 0.2);
  EXPECT_DOUBLE_EQ(quantile(Triangular{0, 1, 4}, 0.25), 1);          // F(mode) = rise / width
  EXPECT_DOUBLE_EQ(quantile(Triangular{0, 1, 4}, 1 - 1.0 / 12), 3);  // 1 - F = (upper - x)^2 / (width fall)
  EXPECT_DOUBLE_EQ(quantile(Triangular{0, 0, 1}, 0.75), 0.5);        // mode at the edge
  EXPECT_EQ(quantile(Choice{{5, 3, 4}, {}}, 0.34), 3);
}

TEST(Distribution, CumulativeInvertsTheQuantile) {
  const std::vector<Distribution> all = {Uniform{0.3, 2},      LogUniform{0.3, 2},
                                         Normal{1, 2, 0, 2.5}, Normal{0, 1, 8, unbounded},
                                         Lognormal{0.2, 0.3},  Lognormal{0.2, 0.3, 0.1, 1.0},
                                         Triangular{0, 1, 4},  Triangular{0, 0, 1},
                                         Triangular{0, 1, 1}};
  for (const auto& d : all) {
    for (const double u : {1e-6, 0.01, 0.2, 0.5, 0.77, 0.99}) EXPECT_NEAR(cumulative(d, quantile(d, u)), u, 1e-9);
    EXPECT_EQ(cumulative(d, -1e9), 0) << to_string(d);
    EXPECT_EQ(cumulative(d, 1e9), 1) << to_string(d);
  }
  EXPECT_EQ(cumulative(Fixed{2}, 1.9), 0);
  EXPECT_EQ(cumulative(Fixed{2}, 2), 1);
  EXPECT_EQ(cumulative(Choice{{5, 3, 4}, {1, 2, 1}}, 4), 0.75);
}

TEST(Distribution, TruncatedQuantilesInvertTheTruncatedCdf) {
  const Normal d{1, 2, 0, 2.5};
  const double a = normal_cdf(-0.5), b = normal_cdf(0.75);
  for (const double u : {1e-6, 0.1, 0.5, 0.9, 1 - 1e-6})
    EXPECT_NEAR((normal_cdf((quantile(d, u) - 1) / 2) - a) / (b - a), u, 1e-12);
  const Lognormal ln{0.2, 0.4, 0.1, 0.3};
  const double la = normal_cdf(std::log(0.5) / 0.4), lb = normal_cdf(std::log(1.5) / 0.4);
  for (const double u : {1e-6, 0.1, 0.5, 0.9})
    EXPECT_NEAR((normal_cdf(std::log(quantile(ln, u) / 0.2) / 0.4) - la) / (lb - la), u, 1e-12);
}

// Far in the upper tail 1 - F has no digits left in double: P(Z > 20) = 3e-89. The quantile must be right all the same.
TEST(Distribution, TruncationFarInATailKeepsItsDigits) {
  for (const double end : {4.0, 8.0, 20.0}) {
    const Normal above{0, 1, end, unbounded}, below{0, 1, -unbounded, -end};
    EXPECT_FALSE(mistake(above)) << end;
    EXPECT_FALSE(mistake(below)) << end;
    const double upper = quantile(above, 0.5), lower = quantile(below, 0.5);
    EXPECT_NEAR(std::erfc(upper / std::sqrt(2.0)) / std::erfc(end / std::sqrt(2.0)), 0.5, 1e-9);
    EXPECT_NEAR(upper, -lower, 1e-12);
  }
}

TEST(Distribution, QuantilesAreMonotoneAndInsideTheSupport) {
  const std::vector<Distribution> all = {Uniform{0.3, 2},         LogUniform{0.3, 2},
                                         Normal{0, 1, -0.1, 0.2}, Lognormal{0.2, 0.3, 0.1, 1.0},
                                         Triangular{1, 2, 3},     Choice{{1, 2, 7}, {1, 0, 2}}};
  for (const auto& d : all) {
    const Support s = support(d);
    double before = -unbounded;
    for (const double u : {0x1.0p-53, 1e-9, 0.01, 0.2, 0.5, 0.77, 0.99, 1 - 0x1.0p-53}) {
      const double x = quantile(d, u);
      EXPECT_GE(x, before) << to_string(d);
      EXPECT_GE(x, s.lower) << to_string(d);
      EXPECT_LE(x, s.upper) << to_string(d);
      before = x;
    }
  }
}

TEST(Distribution, PickFollowsTheWeightsAndSkipsZeroOnes) {
  std::vector<int> counts(4);
  const std::vector<double> weights = {1, 0, 3, 0};
  for (int i = 0; i < 4000; ++i) ++counts[pick(4, weights, (i + 0.5) / 4000)];
  EXPECT_THAT(counts, testing::ElementsAre(1000, 0, 3000, 0));
  EXPECT_EQ(pick(3, {}, 1 - 0x1.0p-53), 2U);
  EXPECT_EQ(pick(4, weights, 1 - 0x1.0p-53), 2U);
}

TEST(Distribution, SupportTellsOpenFromClosedEnds) {
  EXPECT_TRUE(support(Uniform{0, 1}).positive());
  EXPECT_FALSE(support(Fixed{0}).positive());
  EXPECT_FALSE(support(Choice{{0, 1}, {}}).positive());
  EXPECT_TRUE(support(Lognormal{1, 1}).positive());
  EXPECT_FALSE(support(Normal{1, 0.01}).positive());
  EXPECT_TRUE(support(Normal{1, 0.01, 0.9, unbounded}).positive());
  EXPECT_TRUE(support(Fixed{0}).not_negative());
}

struct Impossible {
  Distribution distribution;
  const char* why;
};

TEST(Distribution, ImpossibleOnesAreToldApart) {
  const double nan = std::nan("");
  const std::vector<Impossible> all = {{Uniform{2, 1}, "lower end 2 is not below its upper end 1"},
                                       {Uniform{1, 1}, "give the single number"},
                                       {Uniform{0, nan}, "not a finite number"},
                                       {Fixed{unbounded}, "not a finite number"},
                                       {LogUniform{0, 1}, "above zero"},
                                       {Normal{0, 0}, "standard_deviation 0 is not above zero"},
                                       {Normal{0, 1, 2, 1}, "min 2 is not below its max 1"},
                                       {Normal{0, 1, 50, 60}, "practically nothing"},
                                       {Lognormal{0.2, 0}, "dispersion 0 is not above zero"},
                                       {Lognormal{-0.2, 1}, "median -0.2"},
                                       {Lognormal{0.2, 1, -1, 3}, "min -1"},
                                       {Triangular{0, 2, 1}, "mode 2"},
                                       {Choice{{}, {}}, "empty choice"},
                                       {Choice{{1, 2}, {1}}, "2 values but 1 weights"},
                                       {Choice{{1, 2}, {0, 0}}, "all weights are zero"},
                                       {Choice{{1, 2}, {1, -1}}, "weight -1"}};
  for (const auto& [distribution, why] : all) {
    const auto found = mistake(distribution);
    ASSERT_TRUE(found) << why;
    EXPECT_THAT(*found, testing::HasSubstr(why));
    EXPECT_THAT(*found, testing::MatchesRegex(".+ \\(.+\\): .+"));
  }
  EXPECT_FALSE(mistake(Lognormal{0.2, 0.3, 0.1, 0.4}));
  EXPECT_TRUE(mistake(Names{}));
}

TEST(Distribution, TextIsWhatTheStudyFileWrites) {
  EXPECT_EQ(to_string(Distribution{Fixed{0.1}}), "0.1");
  EXPECT_EQ(to_string(Distribution{Uniform{0.3, 2}}), "{uniform: [0.3, 2]}");
  EXPECT_EQ(to_string(Distribution{Normal{1, 2, -unbounded, 3}}), "{normal: {mean: 1, standard_deviation: 2, max: 3}}");
  EXPECT_EQ(to_string(Distribution{Lognormal{0.2, 0.25, 0.1, 1}}),
            "{lognormal: {median: 0.2, dispersion: 0.25, min: 0.1, max: 1}}");
  EXPECT_EQ(to_string(Distribution{Choice{{1, 2}, {0.5, 1}}}), "{choice: [1, 2], weights: [0.5, 1]}");
  EXPECT_EQ(to_string(Names{{"A", "C1", "x y"}, {}}), "[A, C1, 'x y']");
}

}  // namespace
}  // namespace freestand::sampling
