#include "fragility/goodness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fragility/draws.hpp"
#include "fragility/histogram.hpp"
#include "fragility/lognormal.hpp"

namespace freestand::fragility {
namespace {

std::vector<double> transformed(std::vector<double> samples, double lambda, double omega) {
  for (double& x : samples) x = lognormal_cdf(x, lambda, omega);
  std::sort(samples.begin(), samples.end());
  return samples;
}

std::vector<double> transformed_with_fit(const std::vector<double>& samples) {
  const LognormalFit fit = fit_lognormal(samples);
  return transformed(samples, fit.lambda, fit.omega);
}

TEST(Goodness, StatisticsByHand) {
  const std::vector<double> u{0.1, 0.4, 0.9};
  EXPECT_NEAR(ks_statistic(u), 2.0 / 3 - 0.4, 1e-15);  // after the second step
  // 1 ln .1 + 5 ln .9 + 3 ln .4 + 3 ln .6 + 5 ln .9 + 1 ln .1
  const double sum = 2 * std::log(0.1) + 10 * std::log(0.9) + 3 * std::log(0.24);
  EXPECT_NEAR(ad_statistic(u), -3 - sum / 3, 1e-14);
}

// Exact distribution of Kolmogorov's statistic for n = 27 and 100 (independent calculation by another program).
TEST(Goodness, TextbookValuesAreTheExactOnesNearly) {
  EXPECT_NEAR(kolmogorov_p(0.2544, 27), 0.05, 0.001);
  EXPECT_NEAR(kolmogorov_p(0.2003, 27), 0.20, 0.005);
  EXPECT_NEAR(kolmogorov_p(0.1535, 27), 0.50, 0.015);
  EXPECT_NEAR(kolmogorov_p(0.1340, 100), 0.05, 0.001);
  EXPECT_NEAR(kolmogorov_critical(0.05, 27), 0.254, 0.0005);  // the value that the report used
  EXPECT_EQ(kolmogorov_p(0, 10), 1);
}

// p values of 2000 samples of a true lognormal, n each, tested against the uniform distribution.
struct PValues {
  double ks_distance, ad_distance, textbook_distance, ks_size;
};

PValues under_the_null(std::size_t n) {
  constexpr std::size_t repeats = 2000;
  std::vector<double> ks, ad, textbook;
  double rejected = 0;
  for (std::size_t r = 0; r < repeats; ++r) {
    const auto u = transformed_with_fit(test::lognormals(n, 1.5, 0.4, 100000 * n + r));
    const double size = static_cast<double>(n);
    ks.push_back(estimated_ks_p(ks_statistic(u), size));
    ad.push_back(estimated_ad_p(ad_statistic(u), size));
    textbook.push_back(kolmogorov_p(ks_statistic(u), size));
    if (ks.back() <= 0.05) rejected += 1.0 / repeats;
  }
  for (auto* p : {&ks, &ad, &textbook}) std::sort(p->begin(), p->end());
  return {ks_statistic(ks), ks_statistic(ad), ks_statistic(textbook), rejected};
}

// The distance from uniform of 2000 p values exceeds 0.0436 with probability 0.001; 0.0014 more is left for the tables,
// interpolated between sample sizes (33, 150), or scaled beyond the largest of them (3000).
TEST(Goodness, EstimatedPValuesAreUniformTextbookOnesAreNot) {
  for (const std::size_t n : {12, 33, 150, 3000}) {
    const PValues found = under_the_null(n);
    RecordProperty("ks_distance_" + std::to_string(n), std::to_string(found.ks_distance));
    RecordProperty("size_" + std::to_string(n), std::to_string(found.ks_size));
    EXPECT_LT(found.ks_distance, 0.045) << n;
    EXPECT_LT(found.ad_distance, 0.045) << n;
    EXPECT_GT(found.textbook_distance, 0.4) << n;
    EXPECT_NEAR(found.ks_size, 0.05, 0.02) << n;
  }
}

// Drawn and estimated here; and far out where the tables end, one in a thousand.
TEST(Goodness, TextbookTestOfFivePercentHasSizeNearOneInTenThousand) {
  constexpr int repeats = 200000;
  constexpr std::size_t n = 27;
  const double critical = kolmogorov_critical(0.05, n), thousandth_critical = estimated_ks_critical(0.001, n);
  std::vector<double> u(n);
  int rejected = 0, thousandth = 0, thousandth_ad = 0;
  for (std::uint64_t r = 0; r < repeats; ++r) {
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < n; ++i) mean += (u[i] = test::normal(i, r)) / n;
    for (const double x : u) squares += (x - mean) * (x - mean);
    for (double& x : u) x = 0.5 * std::erfc(-(x - mean) / std::sqrt(2 * squares / n));
    std::sort(u.begin(), u.end());
    const double s = ks_statistic(u);
    if (s > critical) ++rejected;
    if (s > thousandth_critical) ++thousandth;
    if (estimated_ad_p(ad_statistic(u), n) < 0.001) ++thousandth_ad;
  }
  RecordProperty("rejected_of_200000", rejected);
  EXPECT_GE(rejected, 5);
  EXPECT_LE(rejected, 60);
  EXPECT_NEAR(thousandth, 200, 45);  // 3.2 standard deviations
  EXPECT_NEAR(thousandth_ad, 200, 45);
}

TEST(Goodness, CriticalValuesAgreeWithPublishedOnes) {
  // Lilliefors' test at 5 %, by the formula of Stephens (1974): 0.895/(sqrt(n) - 0.01 + 0.85/sqrt(n)).
  for (const double n : {20.0, 27.0, 50.0, 1000.0, 40000.0}) {
    const double published = 0.895 / (std::sqrt(n) - 0.01 + 0.85 / std::sqrt(n));
    EXPECT_NEAR(estimated_ks_critical(0.05, n) / published, 1, 0.02) << n;
  }
  EXPECT_NEAR(estimated_ks_critical(0.05, 27), 0.167, 0.003);
  // And at other levels; of A^2 D'Agostino & Stephens, Goodness-of-Fit Techniques, 1986, table 4.7.
  for (const auto& [level, s] : {std::pair{0.15, 0.775}, {0.10, 0.819}, {0.025, 0.955}, {0.01, 1.035}})
    EXPECT_NEAR(estimated_ks_critical(level, 1000) * std::sqrt(1000) / s, 1, 0.02) << level;
  for (const auto& [level, a2] : {std::pair{0.10, 0.631}, {0.05, 0.752}, {0.025, 0.873}, {0.01, 1.035}, {0.005, 1.159}})
    EXPECT_NEAR(estimated_ad_p(a2, 1e8) / level, 1, 0.1) << level;
}

TEST(Goodness, EstimatedPValuesEndWhereTheirTablesDo) {
  EXPECT_TRUE(std::isnan(estimated_ks_p(0.3, 4)));
  EXPECT_DOUBLE_EQ(estimated_ks_p(0.9, 27), 0.0001);
  EXPECT_DOUBLE_EQ(estimated_ad_p(30, 27), 0.0001);
  EXPECT_DOUBLE_EQ(estimated_ks_p(0, 27), 0.9999);
  EXPECT_DOUBLE_EQ(estimated_ad_p(0, 200), 0.9999);
}

TEST(Goodness, CriticalValuesAreThoseWhoseProbabilityIsTheirLevel) {
  for (const double n : {5.0, 9.0, 27.0, 33.0, 5000.0})
    for (const double level : {0.5, 0.05, 0.033, 0.001})
      EXPECT_NEAR(estimated_ks_p(estimated_ks_critical(level, n), n) / level, 1, 0.005) << n << " " << level;
}

TEST(Goodness, AMixtureIsRejected) {
  auto samples = test::lognormals(150, 0, 0.3, 5);
  const auto others = test::lognormals(150, 2, 0.3, 6);
  samples.insert(samples.end(), others.begin(), others.end());
  const auto u = transformed_with_fit(samples);
  EXPECT_LT(estimated_ks_p(ks_statistic(u), 300), 0.001);
  EXPECT_LT(estimated_ad_p(ad_statistic(u), 300), 0.001);
}

TEST(Histogram, CellsCoverTheRangeWithoutGaps) {
  EXPECT_EQ(ln_cell(-100), 0);
  EXPECT_EQ(ln_cell(100), ln_cell_count - 1);
  EXPECT_EQ(ln_cell(ln_lowest), 1);
  EXPECT_EQ(ln_cell(ln_highest), ln_cell_count - 1);
  for (int cell = 1; cell + 1 < ln_cell_count; cell += 97) {
    EXPECT_EQ(ln_cell(ln_cell_edge(cell)), cell);
    EXPECT_EQ(ln_cell(std::nextafter(ln_cell_edge(cell), -100)), cell - 1);
  }
}

TEST(Histogram, GoodnessWithinTheStatedBoundOfTheExactOne) {
  for (const double omega : {0.05, 0.4, 1.2})
    for (const std::size_t n : {30, 400, 20000}) {
      const auto samples = test::lognormals(n, -1, omega, 10 * n);
      std::vector<std::int64_t> count(ln_cell_count, 0);
      for (const double x : samples) ++count[static_cast<std::size_t>(ln_cell(std::log(x)))];
      const LognormalFit fit = fit_lognormal(samples);
      const auto u = transformed(samples, fit.lambda, fit.omega);
      const HistogramGoodness found = histogram_goodness(count, fit.lambda, fit.omega);
      // A cell holds its samples spread evenly; they lay at random in it, and scatter as a bridge of its share does.
      const double cell = 0.00390625 * 0.3989423 / fit.omega;
      EXPECT_NEAR(found.ks, ks_statistic(u),
                  found.resolution + std::min(cell, std::sqrt(cell / static_cast<double>(n))))
          << omega << " " << n;
      EXPECT_NEAR(found.ad, ad_statistic(u), 0.05 * (1 + ad_statistic(u))) << omega << " " << n;
    }
}

TEST(Histogram, OfALognormalThatIsCutOffBelow) {
  const double threshold = -1.3;
  std::vector<double> above;
  for (const double x : test::lognormals(40000, -1, 0.4, 77))
    if (std::log(x) > threshold) above.push_back(x);
  std::vector<std::int64_t> count(ln_cell_count, 0);
  for (const double x : above) ++count[static_cast<std::size_t>(ln_cell(std::log(x)))];
  const double n = static_cast<double>(above.size());
  EXPECT_LT(histogram_goodness(count, -1, 0.4, {{1, threshold}}).ks, 1.5 / std::sqrt(n));  // Kolmogorov: 0.02 larger
  EXPECT_GT(histogram_goodness(count, -1, 0.4).ks, 0.1);
}

TEST(Histogram, SamplesOutsideTheRangeWidenTheBound) {
  std::vector<std::int64_t> count(ln_cell_count, 0);
  count[0] = 5;
  count[static_cast<std::size_t>(ln_cell(0))] = 95;
  EXPECT_GT(histogram_goodness(count, 0, 1).resolution, 0.05);
}

}  // namespace
}  // namespace freestand::fragility
