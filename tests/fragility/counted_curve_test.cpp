#include "fragility/counted_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace freestand::fragility::counted_curve_test {
namespace {

constexpr double median = 0.8, dispersion = 0.4;
double law(double im) { return 0.5 * std::erfc(-std::log(im / median) / dispersion / std::sqrt(2.0)); }

// Bins as wide as the dispersion whose shares are those of the law over each, `times` as many.
std::vector<CountedBin> bins_of_the_law(double times) {
  std::vector<CountedBin> bins;
  for (double from = 0.1; from < 2; from *= std::exp(dispersion)) {
    constexpr int places = 1000;
    double im = 0, share = 0;
    for (int i = 0; i < places; ++i) {
      const double at = from * std::exp(dispersion * (i + 0.5) / places);
      im += at / places;
      share += times * law(at) / places;
    }
    bins.push_back({im, share, from, from * std::exp(dispersion), false});
  }
  return bins;
}

TEST(CountedCurve, OfATrueCurveIsThatCurve) {
  const std::vector<CountedBin> bins = bins_of_the_law(1);
  const CountedCurve curve(bins, median, dispersion);
  for (double im = 0.01; im < 100; im *= 1.05) EXPECT_NEAR(curve(im), law(im), 0.01 * law(im) + 1e-5) << im;
}

TEST(CountedCurve, HasTheCountsWhereTheFittedCurveHasMore) {
  const CountedCurve curve(bins_of_the_law(0.1), median, dispersion);
  for (double im = 0.05; im < 1.5; im *= 1.1) EXPECT_NEAR(curve(im), 0.1 * law(im), 0.001 * law(im) + 1e-6) << im;
}

// A share that no curve has stays as it was counted; it is not blown up between bins.
TEST(CountedCurve, KeepsWhatTheCountsHaveBesideTheFittedCurve) {
  std::vector<CountedBin> bins = bins_of_the_law(0.7);
  for (CountedBin& bin : bins) bin.probability += 0.3;
  const CountedCurve curve(bins, median, dispersion);
  for (double im = 0.05; im < bins.back().im; im *= 1.1) {
    EXPECT_NEAR(curve(im), 0.3 + 0.7 * law(im), 0.03) << im;
    EXPECT_LE(curve(im), 1);
  }
}

// Whatever the fitted curve is, P lies between the shares of the bins beside it, rises where they do, and has no leaps.
TEST(CountedCurve, OfAnyFittedCurveIsBetweenTheSharesBesideIt) {
  const std::vector<CountedBin> bins = bins_of_the_law(0.6);
  for (const double own_median : {1e-3, 0.3, 0.8, 5.0, 1e3})
    for (const double own_dispersion : {0.01, 0.4, 3.0}) {
      const CountedCurve curve(bins, own_median, own_dispersion);
      double before = 0;
      for (double im = bins.front().im; im < bins.back().im; im *= 1.001) {
        const double p = curve(im);
        ASSERT_GE(p, before - 1e-12) << own_median << " " << own_dispersion << " " << im;
        before = p;
      }
      for (std::size_t i = 0; i + 1 < bins.size(); ++i)
        for (const double part : {0.01, 0.5, 0.99}) {
          const double p = curve(std::lerp(bins[i].im, bins[i + 1].im, part));
          EXPECT_GE(p, (i == 0 ? 0 : bins[i - 1].probability) - 1e-12);
          EXPECT_LE(p, (i + 2 < bins.size() ? bins[i + 2].probability : 1) + 1e-12);
        }
    }
}

TEST(CountedCurve, WhatWasNeverCountedIsNotHandedOn) {
  const CountedCurve curve(bins_of_the_law(0), median, dispersion);
  for (const double im : {0.1, 1.0, 2.0, 5.0}) EXPECT_EQ(curve(im), 0) << im;
}

TEST(CountedCurve, WithoutAFittedOneIsStraight) {
  const CountedCurve curve({{1, 0.1, 0.5, 1.5, false}, {2, 0.3, 1.5, 2.5, false}}, NAN, NAN);
  EXPECT_DOUBLE_EQ(curve(1.5), 0.2);
  EXPECT_DOUBLE_EQ(curve(0.1), 0.1);
  EXPECT_DOUBLE_EQ(curve(3), 0.3);
}

TEST(CountedCurve, StraightLinesBetweenItsPlacesFollowIt) {
  const std::vector<CountedBin> bins = bins_of_the_law(1);
  const CountedCurve curve(bins, median, dispersion);
  const std::vector<double> places = places_to_follow(curve, bins, 0.05, 3);
  EXPECT_EQ(places.front(), 0.05);
  EXPECT_EQ(places.back(), 3);
  EXPECT_LT(places.size(), 50u);
  for (std::size_t i = 1; i < places.size(); ++i) {
    ASSERT_LT(places[i - 1], places[i]);
    for (const double share : {0.25, 0.5, 0.75}) {
      const double im = places[i - 1] + share * (places[i] - places[i - 1]);
      const double line = curve(places[i - 1]) + share * (curve(places[i]) - curve(places[i - 1]));
      EXPECT_NEAR(line, curve(im), 0.04 * curve(im) + 2e-6);
    }
  }
}

}  // namespace
}  // namespace freestand::fragility::counted_curve_test
