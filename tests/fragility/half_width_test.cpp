#include "fragility/half_width.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <tuple>

#include "fragility/fit.hpp"
#include "fragility/made_study.hpp"

namespace freestand::fragility {
namespace half_width_tests {
namespace {

using test::counted, test::options;

// z(1 - 0.025/points)/z(0.975), of points whose half widths hold at once with a confidence of 95 %:
//   python3 -c 'from statistics import NormalDist as N; q = N().inv_cdf; print([q(1 - 0.025/m)/q(0.975) for m in (2, 3, 4, 9)])'
constexpr double of_two = 1.1435938340116685, of_three = 1.2214407094731936, of_four = 1.2743629444795703,
                 of_nine = 1.4147817595022727;

// Two bins of 20 and 2000 samples, a second axis with a common cell and one of 100 samples, and one of 3.
Result with_axis() {
  Options o = options(0, false);
  o.im_edge = {0, 1, 2};
  o.axes = {{"mu", "1", {0, 1, 2, 3}}};
  Tally tally(o);
  const auto add = [&](std::uint64_t i, double im, double mu) {
    const double value = std::exp(0.5 * test::normal(i, 91));
    tally.add({i, im, 0, Outcome::moved, {&value, 1}, {&mu, 1}});
  };
  for (std::uint64_t i = 0; i < 20; ++i) add(i, 0.5, 0.5);
  for (std::uint64_t i = 100; i < 2100; ++i) add(i, 1.5, i < 200 ? 1.5 : i < 203 ? 2.5 : 0.5);
  return fit(tally);
}

double widest(const std::vector<double>& lower, const std::vector<double>& upper) {
  double most = 0;
  for (std::size_t i = 0; i < lower.size(); ++i)
    if (std::isfinite(lower[i])) most = std::max(most, (upper[i] - lower[i]) / 2);
  return most;
}

// The longest side of the bands.
template <class Surface>
double longest(const Surface& surface) {
  double most = 0;
  for (std::size_t i = 0; i < surface.lower.size(); ++i) {
    const double p = surface.probability[i];
    if (std::isfinite(surface.lower[i])) most = std::max({most, surface.upper[i] - p, p - surface.lower[i]});
  }
  return most;
}

TEST(HalfWidth, IsTheLargestOfTheSurfacesAndTheirSecondAxes) {
  Result result = with_axis();
  const HalfWidth open = half_width(result);
  EXPECT_EQ(open.largest, 0.5);  // the first bin has samples, but too few
  EXPECT_EQ(open.im, result.im[0]);
  EXPECT_EQ(open.axis, "");

  EdpResult& edp = result.edps[0];
  edp.bins[0].n = edp.axes[0].n[0] = 0;  // what is never reached is not waited for
  EXPECT_EQ(half_width(result).largest, 0.5);
  EXPECT_EQ(half_width(result).axis, "mu");
  EXPECT_EQ(half_width(result).on_axis, 2.5);  // three samples

  // With 6000 samples there would be nine in that cell, and 18,000 would fill it.
  const HalfWidth wanted = half_width(result, {.half_width = 0.02, .at_most = 6000});
  EXPECT_EQ(wanted.rare_cells, 1);
  EXPECT_EQ(wanted.on_axis, 1.5);
  EXPECT_EQ(wanted.points, 9);  // of the bin, and of two cells
  EXPECT_NEAR(wanted.largest, of_nine * longest(edp.axes[0]), 1e-12);
  EXPECT_GT(wanted.largest, of_nine * longest(edp.surface));
  EXPECT_EQ(half_width(result, {.half_width = 0.02, .at_most = 21000}).rare_cells, 0);

  edp.axes.clear();
  EXPECT_EQ(half_width(result).largest, widest(edp.surface.lower, edp.surface.upper));
  EXPECT_EQ(half_width(Result{}).largest, 0.5);
}

// As many samples as are said to be needed make the half width that was wanted. One capacity, at the median: the half width hardly
// scatters there.
TEST(Outlook, SamplesOfTheirOwnAreNeededByTheSquare) {
  Options o = options(0, false);
  o.edps[0].capacities = {1};
  const Result few = fit(counted(o, {2000, 1, 0, 0.6}, 40));  // enough to know that the lognormal is adequate
  for (const double half : {0.015, 0.01}) {
    const Outlook found = outlook(few, {.half_width = half});
    EXPECT_EQ(found.stays, 0);
    const int samples = static_cast<int>(found.samples);
    EXPECT_NEAR(half_width(fit(counted(o, {samples, 1, 0, 0.6}, 41))).largest / half, 1, 0.15) << samples;
  }
}

TEST(Outlook, ABinThatIsTooEmptyNeedsItsSamples) {
  const Result result = with_axis();
  EXPECT_GE(outlook(result, {.half_width = 0.4, .at_most = 3000}).samples, 1.5 * 2020);  // 20 of 30
  EXPECT_GE(outlook(result, {.half_width = 0.4}).samples, 10 * 2020.0);                  // a cell with 3 of 30
}

// Samples that share a record with correlation r in ln EDP: whether two lie above the median correlates so that the variance between
// records is asin(r)/(2 pi) (W. Sheppard, 1899), and z sqrt(asin(r)/(2 pi)/records) stays of the half width. By counts and by the fit, whose
// part is r/(2 pi). The t of 39 degrees of freedom makes the square 1.06 times as large.
TEST(Outlook, WhatRecordsLeaveStays) {
  constexpr int records = 40, each = 30, repeats = 40;
  constexpr double between = 0.5, within = 1, r = between * between / (between * between + within * within);
  for (const bool binary : {false, true}) {
    double sum = 0, squares = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      Options o = options(records);
      o.confidence = 0.9;
      o.edps[0].capacities = {1};
      const auto stream = static_cast<std::uint64_t>(500 + repeat);
      Tally tally = counted(o, {records, each, between, within}, stream);
      if (binary) {
        o.edps[0] = {"hit", "1", "", true, 0, {}};
        tally = Tally(o);
        for (std::uint64_t i = 0; i < records * each; ++i) {
          const double hit = between * test::normal(i / each, stream + 1000000) + within * test::normal(i, stream) > 0;
          tally.add({i, 0.5, static_cast<int>(i / each), Outcome::moved, {&hit, 1}, {}});
        }
      }
      const double stays = outlook(fit(tally), {.half_width = 0.01}).stays;
      sum += stays * stays;
      squares += std::pow(stays, 4);
    }
    const double mean = sum / repeats, error = std::sqrt((squares / repeats - mean * mean) / repeats);
    const double expected = 1.645 * 1.645 * (binary ? std::asin(r) : r) / (2 * pi) / records;
    EXPECT_NEAR(mean / expected, 1.03, 0.05 + 3 * error / expected) << binary;
  }
}

TEST(Outlook, OnlyMoreRecordsHelpWhereWhatStaysIsTooMuch) {
  Options o = options(20);
  o.edps[0].capacities = {1};
  const Outlook found = outlook(fit(counted(o, {20, 50, 0.8, 0.5}, 60)), {.half_width = 0.05});
  EXPECT_TRUE(std::isinf(found.samples));
  EXPECT_GT(found.stays, 0.05);
  EXPECT_GT(half_width(fit(counted(o, {20, 2000, 0.8, 0.5}, 60))).largest, 0.05);  // and so it is
}

// Samples of their own, of which a share happens to be hit, in the last bin another: as many in each bin as given.
Result hits(const std::vector<int>& samples, double share, std::optional<double> last = {}) {
  Options o = options(0, false);
  o.im_edge.clear();
  for (std::size_t bin = 0; bin <= samples.size(); ++bin) o.im_edge.push_back(static_cast<double>(bin));
  o.edps[0] = {"hit", "1", "", true, 0, {}};
  Tally tally(o);
  std::uint64_t i = 0;
  for (std::size_t bin = 0; bin < samples.size(); ++bin)
    for (int k = 0; k < samples[bin]; ++k, ++i) {
      const double hit = k < (bin + 1 == samples.size() ? last.value_or(share) : share) * samples[bin];
      tally.add({i, static_cast<double>(bin) + 0.5, 0, Outcome::moved, {&hit, 1}, {}});
    }
  return fit(tally);
}

// Of n samples of which np are hit the standard error is sqrt(p(1 - p)/n): 0.1 p at p = 0.01 and n = 9900. Exact intervals are up to a tenth
// wider there.
TEST(HalfWidth, IsRelativeDownToALeastProbability) {
  const Result rare = hits({9900}, 0.01);
  for (const auto& [relative, down_to, times] :
       {std::tuple(0.1, 0.001, 1.0), {0.2, 0.001, 0.5}, {0.1, 0.04, 0.25}, {0.05, 0.01, 2.0}}) {
    const Wanted wanted{.relative_error = relative, .down_to = down_to};
    EXPECT_NEAR(half_width(rare, wanted).times_wanted / times, 1.05, 0.06) << relative;
    EXPECT_NEAR(outlook(rare, wanted).samples / (9900 * times * times), 1.1, 0.12) << relative;
  }
  EXPECT_NEAR(half_width(rare, {.half_width = 0.001, .relative_error = 0.1, .down_to = 0.001}).times_wanted, 2, 0.2);
}

// Of 900 samples each with P = 0.4 and P = 0.02 the standard errors are 4 % and 23 % of P; the wider band is that of the first.
TEST(HalfWidth, TheWidestBandIsNotTheOneThatIsFarthestFromARelativeError) {
  const Result result = hits({900, 900}, 0.4, 0.02);
  const Wanted wanted{.relative_error = 0.1, .down_to = 0.001};
  const HalfWidth found = half_width(result, wanted);
  const Surface& surface = result.edps[0].surface;
  EXPECT_EQ(found.largest, (surface.upper[0] - surface.lower[0]) / 2);
  EXPECT_EQ(found.farthest, (surface.upper[1] - surface.lower[1]) / 2);
  EXPECT_LT(2 * found.farthest, found.largest);
  EXPECT_EQ(found.im, result.im[1]);
  const HalfWidth plain = half_width(result, {.half_width = 0.01});
  EXPECT_EQ(plain.farthest, plain.largest);
  EXPECT_NEAR(plain.largest, of_two * longest(surface), 1e-12);
}

// All points at once: the more there are, the wider. A single one is known as its band says.
TEST(HalfWidth, HoldsAtAllPointsAtOnce) {
  const auto band = [](const Result& result) {
    return widest(result.edps[0].surface.lower, result.edps[0].surface.upper);
  };
  const Result one = hits({900}, 0.5), four = hits({900, 900, 900, 900}, 0.5);
  EXPECT_EQ(half_width(one, {.half_width = 0.01}).largest, band(one));
  const HalfWidth found = half_width(four, {.half_width = 0.01});
  EXPECT_NEAR(found.largest, of_four * band(four), 1e-12);
  EXPECT_EQ(found.farthest, found.largest);
  EXPECT_NEAR(found.times_wanted, found.largest / 0.01, 1e-12);
  EXPECT_NEAR(outlook(four, {.half_width = 0.01}).samples, 3600 * std::pow(found.largest / 0.01, 2), 1e-6);
  EXPECT_EQ(half_width(four).largest, band(four));  // nothing is wanted of it
  Result few = four;
  few.edps[0].surface.lower[0] = 0.05, few.edps[0].surface.upper[0] = 0.95;
  EXPECT_EQ(half_width(few, {.half_width = 0.01}).largest, 0.5);  // no probability is known worse
  EXPECT_EQ(half_width(few, {.half_width = 0.01}).times_wanted, 50);
}

// A standard error is that of a point by itself, beside as many others as there may be; with both wishes the narrower band is wanted.
TEST(HalfWidth, OfARelativeErrorIsThatOfEachPoint) {
  const Result one = hits({900}, 0.4), four = hits({900, 900, 900, 900}, 0.4);
  Wanted wanted{.relative_error = 0.1, .down_to = 0.001};
  const double alone = half_width(one, wanted).times_wanted;
  EXPECT_EQ(half_width(four, wanted).times_wanted, alone);
  EXPECT_EQ(half_width(four, wanted).largest, half_width(one, wanted).largest);
  EXPECT_NEAR(outlook(four, wanted).samples, 4 * outlook(one, wanted).samples, 1e-6);
  wanted.half_width = 0.2;
  EXPECT_EQ(half_width(four, wanted).times_wanted, alone);
  wanted.half_width = 0.04;
  EXPECT_NEAR(half_width(four, wanted).times_wanted, of_four * longest(one.edps[0].surface) / 0.04, 1e-12);
}

// Student's t of four degrees of freedom: with a = 4 p (1 - p) and q = cos(arccos(sqrt(a))/3)/sqrt(a), t = 2 sqrt(q - 1)
// (W. Shaw, J. Computational Finance 9, 2006). Of five records it is this and not the normal distribution's.
TEST(HalfWidth, OfFewRecordsGoesByStudentsT) {
  const auto t = [](double tail) {
    const double root = std::sqrt(4 * tail * (1 - tail));
    return 2 * std::sqrt(std::cos(std::acos(root) / 3) / root - 1);
  };
  const Result result = fit(counted(options(5), {5, 60, 0.1, 1}, 70));
  const HalfWidth found = half_width(result, {.half_width = 0.01});
  const double band = longest(result.edps[0].surface);
  EXPECT_NEAR(found.largest, t(0.025 / 3) / t(0.025) * band, 1e-9);
  EXPECT_GT(found.largest, 1.1 * of_three * band);
  EXPECT_LT(found.largest, 0.5);
}

// By one half width more records are wanted where most stays; by a relative error where that is most of what is wanted.
TEST(Outlook, WhatStaysIsOfThePointForWhichItIsMostOfWhatIsWanted) {
  Options o = options(20);
  o.im_edge = {0, 0.5, 1};
  o.edps[0] = {"hit", "1", "", true, 0, {}};
  Tally tally(o);
  std::uint64_t i = 0;
  for (int record = 0; record < 20; ++record)
    for (int k = 0; k < 200; ++k, ++i)
      for (const bool rare : {false, true}) {
        const double hit = rare ? record < 4 : record % 2 == 0;
        tally.add({2 * i + rare, rare ? 0.75 : 0.25, record, Outcome::moved, {&hit, 1}, {}});
      }
  const Result result = fit(tally);
  const double by_width = outlook(result, {.half_width = 0.01}).stays,
               by_share = outlook(result, {.relative_error = 0.1, .down_to = 0.001}).stays;
  EXPECT_LT(by_share, by_width);
  EXPECT_NEAR(by_share, half_width(result, {.relative_error = 0.1, .down_to = 0.001}).farthest, 0.02);
}

TEST(BinsThatWant, AreThoseThatAreNotKnownWellEnough) {
  Result result = hits({20, 2000, 200, 2000}, 0.3);  // half widths: none, 0.02, 0.065, 0.02
  const auto want = [&](double half) { return bins_that_want(result, {.half_width = half}); };
  EXPECT_EQ(want(0.03), (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(want(0.1), (std::vector<bool>{true, false, false, false}));
  EXPECT_EQ(want(0.07), (std::vector<bool>{true, false, true, false}));  // 0.083 of four points at once
  EXPECT_EQ(want(0.01), (std::vector<bool>(4, true)));
  result.edps[0].bins[3].n = 0;  // never reached
  EXPECT_EQ(want(0.1), (std::vector<bool>{true, false, false, true}));
}

// A bin that would hold 30 of 60,000 samples stays empty in 6000 with a chance of exp(-3) = 0.0498.
TEST(BinsThatWant, AreNotThoseThatStayEmptyThoughTheyMightHaveFilled) {
  Result result = hits({2000, 2000, 2000, 200}, 0.3);
  result.edps[0].bins[2].n = 0;
  const auto want = [&](double at_most) {
    return bins_that_want(result, {.half_width = 0.03, .at_most = at_most, .drawn = 6000});
  };
  EXPECT_EQ(want(59000), (std::vector<bool>{false, false, false, true}));
  EXPECT_EQ(want(61000), (std::vector<bool>{false, false, true, true}));
}

// What is drawn counts for rare cells and for what is still needed, not what was integrated.
TEST(HalfWidth, GoesByWhatIsDrawn) {
  const Result result = with_axis();
  EXPECT_EQ(half_width(result, {.half_width = 0.02, .at_most = 21000}).rare_cells, 0);
  EXPECT_EQ(half_width(result, {.half_width = 0.02, .at_most = 21000, .drawn = 8080}).rare_cells, 1);
  EXPECT_NEAR(outlook(result, {.half_width = 0.4, .drawn = 8080}).samples, 10 * 8080.0, 1);
}

// 20 records: of few samples each, more of them narrow the band; of many, the records alone make it, and it wants no more of them,
// unless that is enough.
TEST(BinsThatWant, AreNotThoseWhereOnlyMoreRecordsHelp) {
  Options o = options(20);
  o.edps[0].capacities = {1};
  const Result few = fit(counted(o, {20, 2, 0.8, 0.5}, 60)), many = fit(counted(o, {20, 500, 0.8, 0.5}, 60));
  EXPECT_TRUE(bins_that_want(few, {.half_width = 0.05})[0]);
  ASSERT_GT(half_width(many).largest, 0.05);
  EXPECT_FALSE(bins_that_want(many, {.half_width = 0.05})[0]);
  const Result own = fit(counted(options(0, false), {500, 1, 0, 0.5}, 60));
  EXPECT_TRUE(bins_that_want(own, {.half_width = 0.001})[0]);
}

}  // namespace
}  // namespace half_width_tests
}  // namespace freestand::fragility
