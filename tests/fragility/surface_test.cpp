#include "fragility/surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fragility/bin_fit.hpp"
#include "fragility/fit.hpp"
#include "fragility/lognormal.hpp"
#include "fragility/made_study.hpp"
#include "fragility/pilot.hpp"
#include "fragility/validate.hpp"

namespace freestand::fragility {
namespace {

using test::counted, test::options;

// Three bins: one nearly empty, one in which nothing moves, one with all three parts.
Tally three_bins() {
  Options o = options(0, false);
  o.im_edge = {0, 1, 2, 3};
  o.axes = {{"mu", "1", {0, 0.5, 1}}};
  o.edps.push_back({"overturned", "1", "", true, 0, {}});
  Tally tally(o);
  const auto add = [&](std::uint64_t i, double im, Outcome outcome, double value) {
    const double edp[] = {value, outcome == Outcome::overturned ? 1.0 : 0.0}, axis[] = {test::uniform(i, 90) / 2};
    tally.add({i, im, 0, outcome, edp, axis});
  };
  for (std::uint64_t i = 0; i < 5; ++i) add(i, 0.5, Outcome::moved, 1);
  for (std::uint64_t i = 0; i < 200; ++i) add(i, 1.5, Outcome::at_rest, 0);
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Outcome outcome = i < 400 ? Outcome::overturned : i < 1120 ? Outcome::at_rest : Outcome::moved;
    add(i, 2.5, outcome, outcome == Outcome::moved ? std::exp(0.5 * test::normal(i, 91)) : 0);
  }
  return tally;
}

TEST(Surface, RowsByStatus) {
  const Result result = fit(three_bins());
  const EdpResult& delta = result.edps[0];
  ASSERT_EQ(delta.bins[0].status, BinStatus::too_few);
  ASSERT_EQ(delta.bins[1].status, BinStatus::counts_only);
  ASSERT_EQ(delta.bins[2].status, BinStatus::fitted);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(std::isnan(delta.surface.probability[c]));  // empty, not zero
    EXPECT_TRUE(std::isnan(delta.surface.empirical[c]));
    EXPECT_EQ(delta.surface.probability[3 + c], 0);
    EXPECT_NEAR(delta.surface.upper[3 + c], 1 - std::pow(0.025, 1.0 / 200), 1e-12);  // nothing of 200 is not never
  }
  const BinFit& bin = delta.bins[2];
  EXPECT_NEAR(bin.p_over, 0.1, 1e-15);
  EXPECT_NEAR(bin.p_still, 0.2, 1e-15);
  EXPECT_NEAR(delta.surface.probability[6 + 2], 0.1 + 0.9 * 0.8 * lognormal_exceedance(2, bin.lambda, bin.omega),
              1e-15);
  EXPECT_NEAR(delta.surface.probability[6 + 2], delta.surface.empirical[6 + 2], 0.02);
  EXPECT_EQ(result.edps[1].bins[2].status, BinStatus::counts_only);
  EXPECT_EQ(result.edps[1].capacity, std::vector<double>{0.5});
  EXPECT_NEAR(result.edps[1].surface.probability[2], 0.1, 1e-15);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("1 of 3 bins hold fewer than 30")));
}

TEST(Surface, SecondAxisIsEmptyWhereItHasNoSamples) {
  const AxisSurface axis = fit(three_bins()).edps[0].axes[0];
  ASSERT_EQ(axis.n.size(), 6u);
  EXPECT_EQ(axis.n[5], 0);
  EXPECT_EQ(axis.n[4], 4000);
  EXPECT_TRUE(std::isnan(axis.probability[5 * 3]));
  EXPECT_NEAR(axis.probability[4 * 3 + 1], fit(three_bins()).edps[0].surface.empirical[6 + 1], 1e-15);
  EXPECT_LT(axis.lower[4 * 3 + 1], axis.probability[4 * 3 + 1]);
}

// As a bin stands at its mean intensity: an axis that is drawn unevenly is not at the middles of its cells. Samples outside of all bins
// are in no cell.
TEST(Surface, ACellOfASecondAxisStandsAtTheMeanOfItsSamples) {
  Options o = options(0, false);
  o.im_edge = {0, 1, 2};
  o.axes = {{"mu", "1", {0, 0.5, 1, 2}}};
  Tally tally(o), rest(o);
  double sum = 0, n = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double im = 2.2 * test::uniform(i, 92), mu = std::pow(test::uniform(i, 93), 3), value = 1;
    (i % 3 ? tally : rest).add({i, im, 0, Outcome::moved, {&value, 1}, {&mu, 1}});
    if (im <= 2 && mu < 0.5) sum += mu, n += 1;
  }
  tally.merge(rest);
  const AxisSurface axis = fit(Tally::from_words(o, tally.words())).edps[0].axes[0];
  EXPECT_NEAR(axis.centre[0], sum / n, 1e-10);
  EXPECT_LT(axis.centre[0], 0.15);
  EXPECT_EQ(axis.centre[2], 1.5);  // without a sample: the middle
}

// 200 samples of a true lognormal: its test passes, and would pass many that are off by 0.1.
TEST(Surface, ABinThatIsMerelyNotRefutedFallsBackOnTheCountsAndSaysSo) {
  Options o = options(0, false);
  const auto of = [](const Options& with) {
    Tally tally(with);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const double value = std::exp(0.6 * test::normal(i, 53));
      tally.add({i, 0.5, 0, Outcome::moved, {&value, 1}, {}});
    }
    return fit(tally);
  };
  const Result found = of(o);
  const BinFit& bin = found.edps[0].bins[0];
  EXPECT_EQ(bin.fdr_rejected, 0);
  EXPECT_GT(bin.off_by, o.adequate);
  EXPECT_EQ(bin.status, BinStatus::not_refuted);
  EXPECT_EQ(found.edps[0].surface.probability, found.edps[0].surface.empirical);
  EXPECT_THAT(found.warnings,
              testing::Contains(testing::HasSubstr("not refuted in 1 of 1 bins, but may be off by up")));
  o.empirical_fallback = false;
  const Surface kept = of(o).edps[0].surface;
  EXPECT_NE(kept.probability[2], kept.empirical[2]);
  o.adequate = 0.2;
  EXPECT_EQ(of(o).edps[0].bins[0].status, BinStatus::fitted);
}

// Demands that grow fast within the bin: about their line they are a lognormal, and as they stand, as they are tested, none has so heavy a
// tail (S would be 0.3). Such a fit is not told, and not called "not refuted".
TEST(Surface, ALawThatCannotBeTestedIsNone) {
  Options o = options(0, false);
  o.edps[0].still_threshold = 0.4;
  Tally tally(o);
  for (std::uint64_t i = 0; i < 330; ++i) {
    const bool strong = i % 11 == 0;
    const double value = 0.4 * std::exp((strong ? 8 : 0.01) + 0.3 * std::abs(test::normal(i, 54)));
    tally.add({i, strong ? 0.9 : 0.2, 0, Outcome::moved, {&value, 1}, {}});
  }
  const Result found = fit(tally);
  const BinFit& bin = found.edps[0].bins[0];
  EXPECT_EQ(bin.n_moved, 330);
  EXPECT_EQ(bin.status, BinStatus::counts_only);
  EXPECT_TRUE(std::isnan(bin.lambda));
  EXPECT_EQ(found.edps[0].surface.probability, found.edps[0].surface.empirical);
  EXPECT_THAT(found.warnings, testing::Not(testing::Contains(testing::HasSubstr("not refuted"))));
}

// Of 20 records two exceed the first capacity and one the second: by itself that one would have the higher limit.
TEST(Surface, LimitsFallAsTheCapacityRises) {
  Options o = options(20);
  o.axes = {{"mu", "1", {0, 1}}};
  o.edps[0].capacities = {1, 2, 3};
  Tally tally(o);
  std::uint64_t i = 0;
  for (int record = 0; record < 20; ++record)
    for (int k = 0; k < 40; ++k, ++i) {
      const double value = record == 0 ? 2.5 : record == 1 ? 1.5 : 0.5, axis = 0.5;
      tally.add({i, 0.5, record, Outcome::moved, {&value, 1}, {&axis, 1}});
    }
  const EdpResult edp = fit(tally).edps[0];
  const auto fall = [](const std::vector<double>& lower, const std::vector<double>& p,
                       const std::vector<double>& upper) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(lower[c] <= p[c] && p[c] <= upper[c]) << c;
    EXPECT_TRUE(upper[0] >= upper[1] && upper[1] >= upper[2]) << upper[0] << ' ' << upper[1] << ' ' << upper[2];
    EXPECT_TRUE(lower[0] >= lower[1] && lower[1] >= lower[2]);
  };
  EXPECT_NEAR(edp.surface.empirical[1], 0.05, 1e-12);
  fall(edp.surface.empirical_lower, edp.surface.empirical, edp.surface.empirical_upper);
  fall(edp.axes[0].lower, edp.axes[0].probability, edp.axes[0].upper);
}

TEST(Surface, FailingBinFallsBackOnTheCounts) {
  Options o = options(0, false);
  const auto mixture = [&](const Options& with) {
    Tally tally(with);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const double value = std::exp((i % 2 ? 1.5 : -1.5) + 0.3 * test::normal(i, 20));
      tally.add({i, 0.5, 0, Outcome::moved, {&value, 1}, {}});
    }
    return fit(tally);
  };
  const Result fallen = mixture(o);
  o.empirical_fallback = false;
  const Result kept = mixture(o);
  const BinFit& bin = fallen.edps[0].bins[0];
  EXPECT_EQ(bin.status, BinStatus::rejected);
  EXPECT_EQ(bin.fdr_rejected, 1);
  EXPECT_GT(bin.ks_statistic, 0.15);
  EXPECT_LT(bin.ks_p_estimated, 0.001);
  EXPECT_EQ(fallen.edps[0].surface.probability[2], fallen.edps[0].surface.empirical[2]);
  EXPECT_NE(kept.edps[0].surface.probability[2], kept.edps[0].surface.empirical[2]);
  EXPECT_THAT(fallen.warnings, testing::Contains(testing::HasSubstr("empirical")));
}

// ln EDP = 1.5 ln IM + 0.4 z in one bin from 0.1 to 1: without the line omega were hypot(0.4, 1.5 * 0.57).
TEST(Surface, OmegaDoesNotGrowWithTheWidthOfABin) {
  Options o = options(0, false);
  o.im_edge = {0.1, 1};
  const auto tally_of = [](const Options& with, std::uint64_t samples) {
    Tally tally(with);
    for (std::uint64_t i = 0; i < samples; ++i) {
      const double im = 0.1 + 0.9 * test::uniform(i, 50);
      const double value = std::pow(im, 1.5) * std::exp(0.4 * test::normal(i, 51));
      tally.add({i, im, 0, Outcome::moved, {&value, 1}, {}});
    }
    return tally;
  };
  const Options piloted = with_pilot(tally_of(o, 500));
  EXPECT_NEAR(piloted.pilot_slope[0][0], 1.5, 0.15);
  const BinFit bin = fit(tally_of(piloted, 5000)).edps[0].bins[0];
  EXPECT_NEAR(bin.slope, 1.5, 0.05);
  EXPECT_NEAR(bin.omega, 0.4, 0.02);
  EXPECT_NEAR(bin.lambda, 1.5 * std::log(bin.im_mean), 0.03);
  EXPECT_GT(bin.ks_p_estimated, 0.01);
  EXPECT_EQ(bin.status, BinStatus::fitted);
  EXPECT_LT(fit(tally_of(o, 5000)).edps[0].bins[0].ks_p_estimated, 0.01);  // without the pilot's line it is skew
  // From 0 on every sample has a ln IM.
  Options from_zero = o;
  from_zero.im_edge = {0, 1};
  EXPECT_EQ(with_pilot(tally_of(from_zero, 500)).pilot_slope[0][0], piloted.pilot_slope[0][0]);
  EXPECT_EQ(fit(tally_of(with_pilot(tally_of(from_zero, 500)), 5000)).edps[0].bins[0].ks_statistic, bin.ks_statistic);
}

// A bin that reaches below 0, where all stand still: what is used is what is tested, and is near to what is counted.
TEST(Surface, OfABinThatReachesBelowZeroIsThatOfTheWholeBin) {
  Options o = options(0, false);
  o.im_edge = {-0.5, 1};
  const auto tally_of = [](const Options& with, std::uint64_t samples) {
    Tally tally(with);
    for (std::uint64_t i = 0; i < samples; ++i) {
      const double im = -0.5 + 1.5 * test::uniform(i, 60);
      const double value = im > 0 ? im * std::exp(1.5 * test::normal(i, 61)) : 0;
      tally.add({i, im, 0, im > 0 ? Outcome::moved : Outcome::at_rest, {&value, 1}, {}});
    }
    return tally;
  };
  const Options piloted = with_pilot(tally_of(o, 500));
  EXPECT_EQ(piloted.pilot_slope[0][0], 0);
  const EdpResult edp = fit(tally_of(piloted, 20000)).edps[0];
  ASSERT_EQ(edp.bins[0].status, BinStatus::fitted);
  EXPECT_EQ(edp.bins[0].slope, 0);
  for (std::size_t c = 0; c < edp.capacity.size(); ++c)
    EXPECT_NEAR(edp.surface.probability[c], edp.surface.empirical[c], edp.bins[0].off_by + 0.001) << c;
}

// One sample in 37 has a tenth of the spread: the best lognormal is off by 0.01, which 10^6 samples see and nobody minds.
TEST(Surface, ALognormalThatIsOffByAHundredthIsUsedAndSaysSo) {
  Options o = options(0, false);
  Tally tally(o);
  for (std::uint64_t i = 0; i < 1000000; ++i) {
    const double value = std::exp((i % 37 ? 0.6 : 0.06) * test::normal(i, 52));
    tally.add({i, 0.5, 0, Outcome::moved, {&value, 1}, {}});
  }
  const Result result = fit(tally);
  const BinFit& bin = result.edps[0].bins[0];
  EXPECT_NEAR(bin.ks_statistic, 0.01, 0.003);
  EXPECT_EQ(bin.fdr_rejected, 1);
  EXPECT_EQ(bin.status, BinStatus::fitted);
  EXPECT_GT(bin.off_by, bin.ks_statistic);
  EXPECT_LT(bin.off_by, 0.015);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("off by at most")));
  EXPECT_NE(result.edps[0].surface.probability[2], result.edps[0].surface.empirical[2]);
}

TEST(Surface, FailedSamplesBoundTheShares) {
  Options o = options(0, false);
  Tally tally(o);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const double value = i % 4 ? 0.7 : 1.5;
    tally.add({i, 0.5, 0, i < 20 ? Outcome::step_limit : Outcome::moved, {&value, 1}, {}});
  }
  const Result result = fit(tally);
  EXPECT_EQ(result.edps[0].bins[0].n_failed, 20);
  EXPECT_EQ(result.edps[0].bins[0].n, 80);
  const Surface& surface = result.edps[0].surface;
  EXPECT_DOUBLE_EQ(surface.empirical[1], 20.0 / 80);
  EXPECT_DOUBLE_EQ(surface.least[1], 20.0 / 100);
  EXPECT_DOUBLE_EQ(surface.most[1], 40.0 / 100);
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("samples failed in 1 of 1 bins")));
}

TEST(Surface, OuterBinsAreOpenWhereTheyWereLaidOverTheFirstSamples) {
  Options o = options(0, false);
  o.im_edge = {0.5, 1, 2};
  for (const bool open : {false, true}) {
    o.open_ends = open;
    Tally tally(o);
    const double value = 0.7;
    for (const double im : {0.1, 0.7, 1.5, 40.0}) tally.add({0, im, 0, Outcome::moved, {&value, 1}, {}});
    EXPECT_EQ(tally.outside_im(), open ? 0 : 2);
    EXPECT_NEAR(tally.mean_im(0), open ? 0.4 : 0.7, 1e-11);
    EXPECT_NEAR(tally.mean_im(1), open ? 20.75 : 1.5, 1e-11);
  }
}

// 40 bins of a true lognormal: with the false discovery rate held at 5 %, a rejection anywhere is rare.
TEST(Surface, TrueLognormalBinsAreKept) {
  Options o = options(0, false);
  o.im_edge = equal_width_edges(0, 40, 40);
  o.resamples = 2;
  Tally tally(o);
  for (std::uint64_t i = 0; i < 8000; ++i) {
    const double value = std::exp(0.6 * test::normal(i, 30));
    tally.add({i, 40 * test::uniform(i, 31), 0, Outcome::moved, {&value, 1}, {}});
  }
  const Result result = fit(tally);
  int below = 0;
  for (const BinFit& bin : result.edps[0].bins) {
    EXPECT_EQ(bin.fdr_rejected, 0);
    below += bin.ks_p_estimated < 0.5;
  }
  EXPECT_NEAR(below, 20, 10);
}

TEST(Surface, SameBitsEveryTime) {
  const Result a = fit(three_bins()), b = fit(three_bins());
  const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
    return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), [](double p, double q) {
             return p == q || (std::isnan(p) && std::isnan(q));
           });
  };
  EXPECT_TRUE(same(a.edps[0].surface.lower, b.edps[0].surface.lower));
  EXPECT_TRUE(same(a.edps[0].axes[0].upper, b.edps[0].axes[0].upper));
  EXPECT_TRUE(same(a.overturning.lower, b.overturning.lower));
}

TEST(Surface, DistributionHoldsEverySampleThatMovedAndStood) {
  const Distribution d = fit(three_bins()).edps[0].distribution;
  const std::size_t cells = d.ln_edge.size() - 1;
  ASSERT_EQ(d.count.size(), 3 * cells);
  std::int64_t last = 0;
  for (std::size_t i = 2 * cells; i < 3 * cells; ++i) last += d.count[i];
  EXPECT_EQ(last, 2880);
  EXPECT_NEAR(d.ln_edge[1] - d.ln_edge[0], 1.0 / 32, 1e-12);
}

}  // namespace
}  // namespace freestand::fragility
