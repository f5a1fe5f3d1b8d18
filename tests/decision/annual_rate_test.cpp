// The integral of fragility and hazard against closed forms, and its bands against simulation.
#include "decision/annual_rate.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>

namespace freestand::decision {
namespace {

HazardCurve power_law(double k0, double k, double first, double last, int points) {
  HazardCurve curve;
  for (int i = 0; i < points; ++i) {
    curve.im.push_back(first * std::pow(last / first, i / (points - 1.0)));
    curve.annual_rate.push_back(k0 * std::pow(curve.im.back(), -k));
  }
  return curve;
}

TEST(AnnualRate, OfAPowerLawIsTheClosedForm) {
  for (const double k : {0.5, 2.0, 3.7, 8.0})
    for (const double dispersion : {0.05, 0.4, 0.9}) {
      const double median = 0.6, exact = 1e-3 * std::pow(median, -k) * std::exp(0.5 * k * k * dispersion * dispersion);
      // The integrand is normal about ln median - k dispersion^2.
      const double middle = median * std::exp(-k * dispersion * dispersion);
      const HazardCurve curve =
          power_law(1e-3, k, middle * std::exp(-12 * dispersion - 1), median * std::exp(12 * dispersion + 60 / k), 7);
      EXPECT_NEAR(annual_rate(curve, {median, dispersion}) / exact, 1, 1e-10) << k << " " << dispersion;
    }
}

// By parts, with z = ln(x/median)/dispersion: over [a, b] of rate = k0 x^-k
//   rate(a) Phi(z_a) - rate(b) Phi(z_b) + k0 median^-k exp(k^2 d^2/2) (Phi(z_b + k d) - Phi(z_a + k d)).
TEST(AnnualRate, OfARangeAndOfACurveWithKinks) {
  const HazardCurve curve{"pga_g", 0, {0.05, 0.2, 0.9, 3}, {0.2, 0.03, 5e-4, 2e-6}};
  const double m = 0.5, d = 0.45;
  const auto exact = [&](double a, double b, double from, double to, double rate_from, double rate_to) {
    const double k = -std::log(rate_to / rate_from) / std::log(to / from), k0 = rate_from * std::pow(from, k);
    const auto z = [&](double x) { return std::log(x / m) / d; };
    const auto phi = [](double x) { return gsl_cdf_ugaussian_P(x); };
    return k0 * std::pow(a, -k) * phi(z(a)) - k0 * std::pow(b, -k) * phi(z(b)) +
           k0 * std::pow(m, -k) * std::exp(k * k * d * d / 2) * (phi(z(b) + k * d) - phi(z(a) + k * d));
  };
  double whole = 0;
  for (std::size_t i = 0; i < 3; ++i)
    whole += exact(curve.im[i], curve.im[i + 1], curve.im[i], curve.im[i + 1], curve.annual_rate[i],
                   curve.annual_rate[i + 1]);
  EXPECT_NEAR(annual_rate(curve, {m, d}) / whole, 1, 1e-10);
  const double part = exact(0.3, 0.7, 0.2, 0.9, 0.03, 5e-4);
  EXPECT_NEAR(annual_rate(curve, {m, d}, {0.3, 0.7}) / part, 1, 1e-10);
  EXPECT_NEAR((annual_rate(curve, {m, d}, {0, 0.3}) + part + annual_rate(curve, {m, d}, {0.7, 99})) / whole, 1, 1e-10);
}

TEST(AnnualRate, OfAStepIsTheHazardThere) {
  const HazardCurve curve = power_law(1e-3, 2.5, 0.01, 10, 5);
  EXPECT_NEAR(annual_rate(curve, {0.7, 1e-9}) / (curve.rate(0.7) - curve.rate(10)), 1, 1e-7);
  EXPECT_NEAR(annual_rate(curve, {1e-9, 0.1}) / (curve.rate(0.01) - curve.rate(10)), 1, 1e-12);
  EXPECT_EQ(annual_rate(curve, {1e9, 0.1}), 0);
  EXPECT_TRUE(std::isnan(annual_rate(curve, {std::nan(""), 0.1})));
}

TEST(AnnualRate, OfATableIsItsWeightsTimesItsProbabilities) {
  const HazardCurve curve{"pga_g", 0, {0.05, 0.2, 0.9, 3}, {0.2, 0.03, 5e-4, 2e-6}};
  // P = a + b ln im exactly: over the whole of it the table gives the integral of that line, by parts
  //   [-(a + b ln x) rate] + b integral of rate d ln x, with the last = (rate(from) - rate(to))/k on each stretch.
  const auto line = [](double im) { return 0.6 + 0.2 * std::log(im); };
  TabulatedFragility table{{0.1, 0.25, 0.8, 2}, {}, {0.1, 2}};
  for (const double im : table.im) table.probability.push_back(line(im));
  const std::vector<double> weight = rate_weights(curve, table);
  double found = 0, exact = line(0.1) * curve.rate(0.1) - line(2) * curve.rate(2);
  for (std::size_t i = 0; i < weight.size(); ++i) found += weight[i] * table.probability[i];
  const double edge[] = {0.1, 0.2, 0.9, 2};
  for (int i = 0; i < 3; ++i) {
    const double k = -std::log(curve.rate(edge[i + 1]) / curve.rate(edge[i])) / std::log(edge[i + 1] / edge[i]);
    exact += 0.2 * (curve.rate(edge[i]) - curve.rate(edge[i + 1])) / k;
  }
  EXPECT_NEAR(found / exact, 1, 1e-10);
  // Beyond its points it holds on to the ends of what is known.
  table.known = {0.07, 3};
  const std::vector<double> held = rate_weights(curve, table);
  EXPECT_NEAR(held[0] - weight[0], curve.rate(0.07) - curve.rate(0.1), 1e-12);
  EXPECT_NEAR(held[3] - weight[3], curve.rate(2) - curve.rate(3), 1e-15);
  double sum = 0;
  for (const double w : held) sum += w;
  EXPECT_NEAR(sum, curve.rate(0.07) - curve.rate(3), 1e-12);
  const TabulatedFragility one{{0.5}, {1}, {0.2, 0.9}};
  EXPECT_NEAR(rate_weights(curve, one)[0], 0.03 - 5e-4, 1e-12);
}

TEST(AnnualRate, ChanceInYears) {
  EXPECT_NEAR(probability_in_years(1e-3, 50), 0.04877057549928599, 1e-15);
  EXPECT_NEAR(probability_in_years(1e-12, 50), 5e-11, 1e-20);
}

}  // namespace
}  // namespace freestand::decision
