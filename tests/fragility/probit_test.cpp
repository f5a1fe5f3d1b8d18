// Maximum likelihood of a lognormal curve through outcomes.
#include "fragility/probit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "fragility/draws.hpp"

namespace freestand::fragility::probit_test {
namespace {

// `n` trials at each of 40 intensities between 0.05 and 2; the block overturns with probability
// Phi(ln(im/median)/beta).
std::vector<ProbitPoint> trials(int n, double median, double beta, std::uint64_t stream) {
  std::vector<ProbitPoint> points;
  std::uint64_t i = 0;
  for (int k = 1; k <= 40; ++k) {
    ProbitPoint point{0.05 * k, static_cast<double>(n), 0};
    const double p = 0.5 * std::erfc(-std::log(point.im / median) / beta / std::sqrt(2.0));
    for (int j = 0; j < n; ++j) point.hits += test::uniform(i++, stream) < p ? 1 : 0;
    points.push_back(point);
  }
  return points;
}

TEST(Overturning, RecoversAKnownCurve) {
  constexpr int repeats = 300;
  double median = 0, dispersion = 0;
  for (std::uint64_t r = 0; r < repeats; ++r) {
    const ProbitFit fit = fit_probit(trials(20, 0.9, 0.45, r));
    EXPECT_FALSE(fit.penalised);
    median += fit.median / repeats;
    dispersion += fit.dispersion / repeats;
  }
  EXPECT_NEAR(median, 0.9, 0.005);
  EXPECT_NEAR(dispersion, 0.45, 0.01);
}

// Counts so great that the likelihood is rounded to more than one step gains, and a curve that does not describe them: the
// fit must end there and not search the rounding. 200 such fits take 0.03 s; searching took 10 s.
TEST(Overturning, EndsWhereRoundingHidesTheRest) {
  std::vector<ProbitPoint> points;
  for (int k = 1; k <= 240; ++k) {
    const double n = 1000 + 37 * (k % 11);
    points.push_back({k / 120.0, n, std::floor(n * (0.1 + 0.3 * std::pow(k / 240.0, 2)))});
  }
  const ProbitFit fit = fit_probit(points);
  ProbitFit start = fit;
  start.a *= 1.1;
  const double over = points[200].hits;
  const std::clock_t began = std::clock();
  for (int i = 0; i < 200; ++i) {
    points[200].hits = over - i % 2;
    EXPECT_NEAR(fit_probit(points, start).median, fit.median, 0.01 * fit.median);
  }
  EXPECT_LT(static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC, 2);
}

TEST(Overturning, LikelihoodIsLargestAtTheFit) {
  const auto points = trials(15, 1.1, 0.3, 77);
  const ProbitFit fit = fit_probit(points);
  const auto log_likelihood = [&](double median, double beta) {
    double sum = 0;
    for (const auto& p : points) {
      const double eta = std::log(p.im / median) / beta / std::sqrt(2.0);
      sum += p.hits * std::log(0.5 * std::erfc(-eta)) + (p.n - p.hits) * std::log(0.5 * std::erfc(eta));
    }
    return sum;
  };
  const double best = log_likelihood(fit.median, fit.dispersion);
  for (const double factor : {0.999, 1.001}) {
    EXPECT_LT(log_likelihood(fit.median * factor, fit.dispersion), best);
    EXPECT_LT(log_likelihood(fit.median, fit.dispersion * factor), best);
  }
}

TEST(Overturning, SeparatedOutcomesStayFinite) {
  for (const double n : {1.0, 5.0, 1000.0}) {
    const ProbitFit fit = fit_probit({{0.5, n, 0}, {0.8, n, 0}, {1.0, n, 0}, {1.3, n, n}, {1.6, n, n}, {2.0, n, n}});
    EXPECT_TRUE(fit.penalised);
    EXPECT_GT(fit.median, 1.0) << n;
    EXPECT_LT(fit.median, 1.3) << n;
    EXPECT_GT(fit.dispersion, 0.005) << n;
    EXPECT_LT(fit.dispersion, 1) << n;
  }
  // One intensity at which both happen, nothing to overlap with: the likelihood has no maximum either.
  const ProbitFit touching = fit_probit({{0.5, 10, 0}, {1.0, 10, 4}, {2.0, 10, 10}});
  EXPECT_TRUE(touching.penalised);
  EXPECT_TRUE(std::isfinite(touching.median) && touching.dispersion > 0);
}

// The penalised objective, maximised on a fine grid by other means.
TEST(Overturning, PenaltyIsJeffreysPrior) {
  const std::vector<ProbitPoint> points{{0.5, 3, 0}, {1.0, 3, 0}, {1.4, 3, 3}, {2.0, 3, 3}};
  const auto objective = [&](double a, double b) {
    double value = 0, i00 = 0, i01 = 0, i11 = 0;
    for (const auto& p : points) {
      const double x = std::log(p.im), eta = a + b * x, cdf = 0.5 * std::erfc(-eta / std::sqrt(2.0));
      const double pdf = std::exp(-eta * eta / 2) / std::sqrt(2 * pi), w = p.n * pdf * pdf / (cdf * (1 - cdf));
      value += p.hits * std::log(cdf) + (p.n - p.hits) * std::log(1 - cdf);
      i00 += w, i01 += w * x, i11 += w * x * x;
    }
    return value + 0.5 * std::log(i00 * i11 - i01 * i01);
  };
  const ProbitFit fit = fit_probit(points);
  const double best = objective(fit.a, fit.b);
  for (const double da : {-1e-3, 0.0, 1e-3})
    for (const double db : {-1e-3, 0.0, 1e-3})
      EXPECT_LE(objective(fit.a + da, fit.b + db), da == 0 && db == 0 ? best : best - 1e-9) << da << " " << db;
}

TEST(Overturning, NoCurveWhereThereIsNone) {
  EXPECT_TRUE(std::isnan(fit_probit({{0.5, 10, 0}, {1, 10, 0}}).median));
  EXPECT_TRUE(std::isnan(fit_probit({{0.5, 10, 10}, {1, 10, 10}}).median));
  EXPECT_TRUE(std::isnan(fit_probit({{1, 10, 4}}).median));
  EXPECT_TRUE(std::isnan(fit_probit({}).median));
  const ProbitFit falling = fit_probit({{0.5, 10, 8}, {1, 10, 5}, {2, 10, 1}});
  EXPECT_TRUE(std::isnan(falling.median));
  EXPECT_LT(falling.b, 0);
  EXPECT_EQ(probit_probability(falling, 0), 0);
}

}  // namespace
}  // namespace freestand::fragility::probit_test
