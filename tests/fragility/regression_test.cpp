#include "fragility/regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>

#include "fragility/draws.hpp"
#include "fragility/goodness.hpp"
#include "fragility/groups.hpp"

namespace freestand::fragility::regression_test {
namespace {

TEST(Regression, ThroughTheOriginByHand) {
  const std::vector<double> x{1, 2, 3}, y{1, 1, 4};
  const LinearDemand fit = fit_linear_demand(x, y);
  EXPECT_NEAR(fit.slope, 15.0 / 14, 1e-15);
  EXPECT_NEAR(fit.sd_slope, std::sqrt((18 - 225.0 / 14) / 14), 1e-14);
  EXPECT_NEAR(fit.r2, 9.0 / 12, 1e-14);  // dx = -1 0 1, dy = -1 -1 2: 3^2/(2 * 6)
  EXPECT_THROW(fit_linear_demand(x, std::vector<double>{1, 2}), Error);
  EXPECT_THROW(fit_linear_demand(std::vector<double>{0, 0}, std::vector<double>{1, 2}), Error);
}

TEST(Regression, CloudRecoversAPowerLaw) {
  std::vector<double> x, y;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    x.push_back(0.2 + 3 * test::uniform(i, 1));
    y.push_back(0.5 * std::pow(x.back(), 1.7) * std::exp(0.3 * test::normal(i, 2)));
  }
  const Cloud cloud = fit_cloud(x, y);
  EXPECT_NEAR(cloud.intercept, std::log(0.5), 0.02);
  EXPECT_NEAR(cloud.slope, 1.7, 0.03);
  EXPECT_NEAR(cloud.sd, 0.3, 0.015);
  EXPECT_GT(cloud.r2, 0.8);
}

Options options() {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0, 1, 2};
  options.edps = {{"slip", "m", "u", false, 0, {0.001}}};
  return options;
}

TEST(Regression, SumsOfATallyGiveTheSameAsTheSamples) {
  Tally tally(options());
  std::vector<double> x, y;
  for (std::uint64_t i = 0; i < 500; ++i) {
    x.push_back(0.1 + 1.8 * test::uniform(i, 3));
    y.push_back(2e-4 * x.back() * std::exp(0.5 * test::normal(i, 4)));
    tally.add({i, x.back(), 0, Outcome::moved, {&y.back(), 1}, {}});
  }
  const Regressions found = regressions(tally.regression(0), {});
  const LinearDemand line = fit_linear_demand(x, y);
  const Cloud cloud = fit_cloud(x, y);
  EXPECT_EQ(found.n, 500);
  EXPECT_NEAR(found.slope / line.slope, 1, 1e-9);
  EXPECT_NEAR(found.sd_slope / line.sd_slope, 1, 1e-7);
  EXPECT_NEAR(found.slope_r2, line.r2, 1e-7);
  EXPECT_NEAR(found.cloud_intercept, cloud.intercept, 1e-8);
  EXPECT_NEAR(found.cloud_slope, cloud.slope, 1e-8);
  EXPECT_NEAR(found.cloud_sd, cloud.sd, 1e-8);
  EXPECT_NEAR(found.cloud_r2, cloud.r2, 1e-8);
}

// Samples of 40 records, each with a level of its own: over many sweeps each coefficient scatters by what its standard error says. Records
// differ in their slope too, so samples that are counted as independent would scatter far less.
TEST(Regression, StandardErrorsAreTheScatterOverSweepsWithSharedRecords) {
  constexpr int records = 40, each = 25, repeats = 150;
  Options o = options();
  o.resamples = 100;
  for (int r = 0; r < records; ++r) o.motion_group.push_back(r);
  const std::vector<std::pair<double Regressions::*, double Regressions::*>> told{
      {&Regressions::slope, &Regressions::slope_se},
      {&Regressions::sd_slope, &Regressions::sd_slope_se},
      {&Regressions::cloud_intercept, &Regressions::cloud_intercept_se},
      {&Regressions::cloud_slope, &Regressions::cloud_slope_se},
      {&Regressions::cloud_sd, &Regressions::cloud_sd_se}};
  std::vector<double> sum(told.size()), square(told.size()), variance(told.size());
  for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
    o.seed = repeat + 1;
    Tally tally(o);
    const std::uint64_t stream = 7000 + 10 * repeat;
    std::uint64_t i = 0;
    for (std::uint64_t r = 0; r < records; ++r) {
      const double level = 0.4 * test::normal(r, stream), steeper = 0.3 * test::normal(r, stream + 1);
      for (int k = 0; k < each; ++k, ++i) {
        const double im = 0.2 + 1.8 * test::uniform(i, stream + 2);
        const double slip = 0.1 * std::pow(im, 1.2 + steeper) * std::exp(level + 0.4 * test::normal(i, stream + 3));
        tally.add({i, im, static_cast<int>(r), Outcome::moved, {&slip, 1}, {}});
      }
    }
    const Resampling resampling(tally.groups(), tally.groups_with_samples(), o.resamples, o.seed);
    const Regressions found = regressions(tally, 0, resampling, std::vector<BinFit>{});
    for (std::size_t c = 0; c < told.size(); ++c) {
      const double value = found.*told[c].first, se = found.*told[c].second;
      sum[c] += value / repeats;
      square[c] += value * value / repeats;
      variance[c] += se * se / repeats;
    }
  }
  for (std::size_t c = 0; c < told.size(); ++c) {
    const double ratio = std::sqrt(variance[c] / (square[c] - sum[c] * sum[c]));
    RecordProperty("coefficient_" + std::to_string(c), std::to_string(ratio));
    // The scatter of 150 is known to 1/sqrt(300) = 0.06: three times that.
    EXPECT_NEAR(ratio, 1, 0.18) << c;
  }
}

TEST(Regression, LineThroughTheBins) {
  std::vector<BinFit> bins(3);
  bins[0].im_mean = 1, bins[0].mean = 2, bins[0].standard_deviation = 1;
  bins[1].im_mean = 2, bins[1].mean = 3, bins[1].standard_deviation = 1;
  const Regressions found = regressions({}, bins);  // the third bin has no fit
  EXPECT_NEAR(found.bin_mean_slope, (1 * 2 + 2 * 3) / 5.0, 1e-15);
  EXPECT_NEAR(found.bin_sd_slope, (1 * 1 + 2 * 1) / 5.0, 1e-15);
  EXPECT_TRUE(std::isnan(found.slope));
}

TEST(Regression, NullDistributionIsReproducible) {
  const LinearDemand model{0.4, 0.2, 0};
  const std::vector<double> im{1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5};
  const auto a = linear_demand_null(model, im, 50, 9), b = linear_demand_null(model, im, 50, 9);
  EXPECT_EQ(a, b);
  EXPECT_GT(a.front(), 0);
  EXPECT_LT(a.back(), 1);
}

}  // namespace
}  // namespace freestand::fragility::regression_test
