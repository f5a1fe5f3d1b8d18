#include "fragility/counted_curve.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fragility/fit.hpp"

namespace freestand::fragility::counted_curve_test {
namespace {

constexpr double median = 0.8, dispersion = 0.4;
double law(double im) { return 0.5 * std::erfc(-std::log(im / median) / dispersion / std::sqrt(2.0)); }

// A bin in whose samples the intensities are `place` of what is spread evenly from 0 to 1, and its share that of `law` over them; its eight
// cells have even widths.
template <class Spread, class Law>
CountedBin bin_of(const Spread& place, const Law& law) {
  constexpr int samples = 4000, cells = 8;
  const double from = place(0.0), to = place(1.0);
  Result result;
  result.im_edge = {from, to};
  result.im = {0};
  result.cell_im.assign(cells, 0);
  result.cell_n.assign(cells, 0);
  double share = 0;
  for (int i = 0; i < samples; ++i) {
    const double im = place((i + 0.5) / samples);
    const auto cell = static_cast<std::size_t>((im - from) / (to - from) * cells);
    result.im[0] += im / samples;
    result.cell_im[cell] += im;
    ++result.cell_n[cell];
    share += law(im) / samples;
  }
  for (std::size_t cell = 0; cell < cells; ++cell) result.cell_im[cell] /= static_cast<double>(result.cell_n[cell]);
  return counted_bin(result, 0, share);
}

// Bins as wide as the dispersion whose shares are those of the law over each, `times` as many.
std::vector<CountedBin> bins_of_the_law(double times) {
  std::vector<CountedBin> bins;
  for (double from = 0.1; from < 2; from *= std::exp(dispersion))
    bins.push_back(
        bin_of([&](double u) { return from * std::exp(dispersion * u); }, [&](double im) { return times * law(im); }));
  return bins;
}

TEST(CountedCurve, OfATrueCurveIsThatCurve) {
  const std::vector<CountedBin> bins = bins_of_the_law(1);
  const CountedCurve curve(bins, {median, dispersion});
  for (double im = 0.01; im < 100; im *= 1.05) EXPECT_NEAR(curve(im), law(im), 0.01 * law(im) + 1e-5) << im;
}

// Six bins of 0.05 to 3, as full of samples as each other, of intensities spread evenly (records that are scaled evenly), or in a power of
// them: the lowest is three dispersions wide, and its mean far above the middle of its logarithms.
TEST(CountedCurve, OfATrueCurveIsThatCurveHoweverTheIntensitiesOfABinAreSpread) {
  for (const double power : {-1.0, 0.5, 1.0, 2.0})
    for (const double least : {0.05, 0.0}) {
      if (least == 0 && power < 0) continue;
      const auto place = [&](double u) {
        const double low = std::pow(least, power);
        return std::pow(low + u * (std::pow(3.0, power) - low), 1 / power);
      };
      std::vector<CountedBin> bins;
      for (int b = 0; b < 6; ++b) bins.push_back(bin_of([&](double u) { return place((b + u) / 6.0); }, law));
      const CountedCurve curve(bins, {median, dispersion});
      for (double im = 0.2; im < 3; im *= 1.05)
        EXPECT_NEAR(curve(im), law(im), 0.01 * law(im) + 1e-4) << power << " " << least << " " << im;
    }
}

// A curve that no lognormal is, of two kinds of specimens, by ten bins: at the bins' means, between them and over all the curve is neither
// late nor early. The lag is in widths w of a bin; half a bin late were 0.5. By Euler and Maclaurin straight lines have w/12 of the change of
// the slope, and shares of whole bins w/24: with a slope of 1.1 at most, no more than 1.1 w/8.
TEST(CountedCurve, IsNeitherLateNorEarlyWhereTheTruthIsNoLognormal) {
  const auto kind = [](double im, double at, double spread) {
    return 0.5 * std::erfc(-std::log(im / at) / spread / std::sqrt(2.0));
  };
  const auto truth = [&](double im) { return 0.7 * kind(im, 0.9, 0.3) + 0.3 * kind(im, 0.35, 0.3); };
  constexpr double least = 0.1, most = 2.1, width = (most - least) / 10;
  std::vector<CountedBin> bins;
  for (double from = least; from < most - width / 2; from += width)
    bins.push_back(bin_of([&](double u) { return from + width * u; }, truth));
  for (const double of : {0.55, 0.7, double(NAN)}) {
    const CountedCurve curve(bins, {of, of});
    double lag = 0;
    for (double im = bins[0].im; im < bins[9].im; im += 0.001) {
      EXPECT_NEAR(curve(im), truth(im), 0.03) << of << " " << im;
      lag += (truth(im) - curve(im)) * 0.001 / width;
    }
    EXPECT_NEAR(lag, 0, 1.1 * width / 8) << of;
    for (const CountedBin& bin : bins) EXPECT_NEAR(curve(bin.im), truth(bin.im), 0.02) << of << " " << bin.im;
  }
}

TEST(CountedCurve, HasTheCountsWhereTheFittedCurveHasMore) {
  const CountedCurve curve(bins_of_the_law(0.1), {median, dispersion});
  for (double im = 0.05; im < 1.5; im *= 1.1) EXPECT_NEAR(curve(im), 0.1 * law(im), 0.001 * law(im) + 1e-6) << im;
}

// A share that no curve has stays as it was counted; it is not blown up between bins.
TEST(CountedCurve, KeepsWhatTheCountsHaveBesideTheFittedCurve) {
  std::vector<CountedBin> bins = bins_of_the_law(0.7);
  for (CountedBin& bin : bins) bin.probability += 0.3;
  const CountedCurve curve(bins, {median, dispersion});
  for (double im = bins.front().places.back().im; im < bins.back().im; im *= 1.1) {
    EXPECT_NEAR(curve(im), 0.3 + 0.7 * law(im), 0.03) << im;
    EXPECT_LE(curve(im), 1);
  }
}

// Whatever the fitted curve is, P lies between the shares of the bins beside it, rises where they do, and has no leaps.
TEST(CountedCurve, OfAnyFittedCurveIsBetweenTheSharesBesideIt) {
  const std::vector<CountedBin> bins = bins_of_the_law(0.6);
  for (const double own_median : {1e-3, 0.3, 0.8, 5.0, 1e3})
    for (const double own_dispersion : {0.01, 0.4, 3.0}) {
      const CountedCurve curve(bins, {own_median, own_dispersion});
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
  const CountedCurve curve(bins_of_the_law(0), {median, dispersion});
  for (const double im : {0.1, 1.0, 2.0, 5.0}) EXPECT_EQ(curve(im), 0) << im;
}

TEST(CountedCurve, WithoutAFittedOneIsStraight) {
  const CountedCurve curve({{1, 0.1}, {2, 0.3}}, {NAN, NAN});
  EXPECT_DOUBLE_EQ(curve(1.5), 0.2);
  EXPECT_DOUBLE_EQ(curve(0.1), 0.1);
  EXPECT_DOUBLE_EQ(curve(3), 0.3);
}

TEST(CountedCurve, StraightLinesBetweenItsPlacesFollowIt) {
  const std::vector<CountedBin> bins = bins_of_the_law(1);
  const CountedCurve curve(bins, {median, dispersion});
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

// Records that are scaled to five intensities, in bins that are wide about them: the curve has the very shares there, whose truth is no
// lognormal.
TEST(CountedCurve, HasTheSharesAtIntensitiesThatAllSamplesOfABinHave) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.1, 0.25, 0.5, 0.75, 1.05, 1.4};
  options.edps = {{"overturned", "1", "", true, 0, {}}};
  options.resamples = 20;
  Tally tally(options);
  const double at[] = {0.2, 0.4, 0.6, 0.8, 1.3};
  const int above[] = {8, 20, 100, 110, 180};  // of 200
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const bool over = static_cast<int>(i / 5) < above[i % 5];
    const double value = over;
    tally.add({i, at[i % 5], 0, over ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
  }
  const Result result = fit(tally);
  const CountedCurve curve(counted_bins(result, result.edps[0], 0), CountedCurve::Shape(result.edps[0].functions[0]));
  for (int b = 0; b < 5; ++b) EXPECT_NEAR(curve(at[b]), above[b] / 200.0, 1e-9) << at[b];
}

// From 0.2 to 0.5, 1, 2 and 4.
std::vector<CountedBin> four_bins(const std::array<double, 4>& share) {
  return {{0.35, share[0], {{0.25, 1}, {0.45, 1}}},
          {0.7, share[1], {{0.5, 1}, {0.9, 1}}},
          {1.4, share[2], {{1.1, 1}, {1.7, 1}}},
          {2.9, share[3], {{2.1, 1}, {3.7, 1}}}};
}

// Shares that fall: the cells are pooled to one level, where the lines go along the intensity, whatever the digits of that level are.
TEST(CountedCurve, FollowsCountsThatFall) {
  for (int k = 1; k <= 40; ++k) {
    const double level = 0.0459 * std::pow(1.07, k);
    CountedCurve::Shape shape{median, dispersion};
    const std::vector<CountedBin> bins = four_bins({0.9 * level, 1.6 * level, 1.1 * level, 0.8 * level});
    for (const double im : {0.25, 0.45, 0.5, 0.9, 1.2, 1.7, 2.3, 4.1}) {
      shape.cell_im.push_back(im);
      shape.cell_n.push_back(1);
      shape.cell_share.push_back(im < 0.5 ? 0.9 * level : level);
    }
    const CountedCurve curve(bins, shape);
    for (std::size_t b = 1; b < bins.size(); ++b)
      EXPECT_DOUBLE_EQ(curve(bins[b].im), bins[b].probability) << level << ", bin " << b;
    EXPECT_NEAR(curve(2), level * std::lerp(1.1, 0.8, 0.6 / 1.5), 1e-12) << level;
  }
}

// And where the level begins within a bin and ends within another: each bin shows its own share about its mean.
TEST(CountedCurve, FollowsCountsThatFallBesideAnUnevenLevel) {
  CountedCurve::Shape shape{median, dispersion};
  for (const double im : {0.25, 0.45, 0.55, 0.9, 1.2, 1.7, 2.3, 3.6, 3.9}) {
    shape.cell_im.push_back(im);
    shape.cell_n.push_back(1);
    shape.cell_share.push_back(im < 0.5 ? 0.05 : im < 3.8 ? 0.09 : 0.095);
  }
  const std::vector<CountedBin> bins = four_bins({0.05, 0.12, 0.09, 0.06});
  const CountedCurve curve(bins, shape);
  EXPECT_NEAR(curve(0.7), 0.12, 0.012);
  EXPECT_NEAR(curve(1.4), 0.09, 1e-12);
  EXPECT_NEAR(curve(2.9), 0.06, 0.012);
}

}  // namespace
}  // namespace freestand::fragility::counted_curve_test
