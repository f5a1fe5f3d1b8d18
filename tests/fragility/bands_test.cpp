// Do bands hold the truth as often as they say?
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fragility/bin_fit.hpp"
#include "fragility/lognormal.hpp"
#include "fragility/made_study.hpp"
#include "fragility/surface.hpp"

namespace freestand::fragility {
namespace {

using test::counted, test::error_of_share, test::options, test::repeats_asked, test::Study;

// Share of repeats whose band at capacity 2 holds the truth.
double coverage(const Study& study, bool group_by_record, double& mean_width) {
  const int repeats = repeats_asked(100);
  const double truth = lognormal_exceedance(2, 0, std::hypot(study.between, study.within));
  double covered = 0;
  mean_width = 0;
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(repeats); ++r) {
    Options o = options(study.records, group_by_record);
    o.empirical_fallback = false;
    o.seed = r + 1;
    const Tally tally = counted(o, study, r);
    std::vector<BinFit> bins = fit_bins(tally, 0);
    const Resampling resampling(tally.groups(), tally.groups_with_samples(), o.resamples, o.seed);
    const Surface surface = fragility::surface(tally, 0, resampling, bins);
    if (surface.lower[2] <= truth && truth <= surface.upper[2]) covered += 1.0 / repeats;
    mean_width += (surface.upper[2] - surface.lower[2]) / repeats;
  }
  return covered;
}

// Nominal 95 %, of which 40 motions fall short by one or two; over 100 repeats the standard deviation of the share is 0.022 to 0.026.
TEST(Bands, CoverWhenSamplesShareMotions) {
  const Study study{40, 25, 0.5, 0.4};
  double width = 0, naive_width = 0;
  const double grouped = coverage(study, true, width), naive = coverage(study, false, naive_width);
  RecordProperty("grouped", std::to_string(grouped));
  RecordProperty("naive", std::to_string(naive));
  EXPECT_GT(grouped, 0.86);  // three of them below 0.93
  EXPECT_LT(naive, 0.65);
  EXPECT_GT(width, 2 * naive_width);
}

TEST(Bands, CoverWhenEverySampleIsItsOwnMotion) {
  double width = 0;
  const double covered = coverage({400, 1, 0, 0.6}, false, width);
  RecordProperty("independent", std::to_string(covered));
  EXPECT_GT(covered, 0.88);
  EXPECT_LT(width, 0.1);
}

TEST(Bands, StandardErrorsByMotionSeeWhatTheOthersDoNot) {
  const Study study{20, 25, 0.5, 0.4};
  const BinFit shared = fit(counted(options(20), study, 5)).edps[0].bins[0];
  EXPECT_NEAR(shared.lambda_se, 0.113, 0.05);  // sqrt(0.25/20 + 0.16/500); of independent samples it were 0.029
  EXPECT_NEAR(shared.correlation, 0.25 / (0.25 + 0.16), 0.25);
  EXPECT_EQ(shared.motions, 20);
  const BinFit independent = fit(counted(options(400, false), {400, 1, 0, 0.6}, 6)).edps[0].bins[0];
  EXPECT_NEAR(independent.lambda_se / (0.6 / std::sqrt(400)), 1, 0.25);
  EXPECT_NEAR(independent.omega_se / (0.6 / std::sqrt(800)), 1, 0.3);
  EXPECT_EQ(independent.correlation, 0);
}

// Wanted: 87 to 93 %. That is two errors of the simulation about 0.90 at 400 repeats; where there are fewer, two are as much more.
void expect_ninety(double held, int repeats, const char* what) {
  const double covered = held / repeats, off = std::max(0.03, 2 * error_of_share(0.9, repeats));
  testing::Test::RecordProperty(what, std::to_string(covered));
  EXPECT_NEAR(covered, 0.9, off + 1e-9) << what;
}

struct Rows {
  Surface fitted, counted;
  BinFit bin;
};

// The row of one study by its fit and by its counts, nominal 90 %.
Rows rows(const Study& study, std::uint64_t repeat) {
  Options o = options(study.records);
  o.confidence = 0.9;
  o.empirical_fallback = false;
  o.seed = repeat + 1;
  const Tally tally = counted(o, study, 70000 + repeat);
  std::vector<BinFit> bins = fit_bins(tally, 0);
  const Resampling resampling(tally.groups(), tally.groups_with_samples(), o.resamples, o.seed);
  Rows found;
  found.fitted = surface(tally, 0, resampling, bins);
  found.bin = bins[0];
  bins[0].status = BinStatus::counts_only;
  found.counted = surface(tally, 0, resampling, bins);
  return found;
}

bool holds(const Surface& s, std::size_t c, const Study& study) {
  const double truth =
      study.overturned + (1 - study.overturned) * lognormal_exceedance(options(1).edps[0].capacities[c], 0,
                                                                       std::hypot(study.between, study.within));
  return s.lower[c] <= truth && truth <= s.upper[c];
}

// Nominal 90 %, of fitted and of counted rows. The draws are fixed. FREESTAND_REPEATS for more.
TEST(Bands, NinetyPercentAreNinetyPercentWithSharedRecords) {
  const Study study{40, 25, 0.5, 0.5};
  const int repeats = repeats_asked(200);
  double fitted_rows = 0, counted_rows = 0, counted_high = 0, medians = 0;
  for (int r = 0; r < repeats; ++r) {
    const Rows found = rows(study, static_cast<std::uint64_t>(r));
    fitted_rows += holds(found.fitted, 2, study);
    medians += std::fabs(found.bin.lambda) < 1.645 * found.bin.lambda_se;
    counted_rows += holds(found.counted, 1, study);
    counted_high += holds(found.counted, 2, study);
  }
  expect_ninety(fitted_rows, repeats, "fitted");
  expect_ninety(counted_rows, repeats, "counted");
  expect_ninety(counted_high, repeats, "counted_high");
  expect_ninety(medians, repeats, "lambda");
}

// The same where a record overturns with a chance at which among 40 none does in all, 60, 37 and 13 % of the studies.
TEST(Bands, NinetyPercentAreNinetyPercentWhereARecordMayOverturn) {
  const int repeats = repeats_asked(100);
  for (const double records : {0.0, 0.5, 1.0, 2.0}) {
    const Study study{40, 25, 0.5, 0.5, records / 40};
    double fitted_rows = 0;
    for (int r = 0; r < repeats; ++r) fitted_rows += holds(rows(study, static_cast<std::uint64_t>(r)).fitted, 2, study);
    expect_ninety(fitted_rows, repeats, fmt::format("fitted_{}", records).c_str());
  }
}

// A capacity that the fit says is exceeded by 0.06, less than the 0.072 that 40 records of which none overturned allow: 0.90 where none
// can. Where a record may, no interval can come to 0.90: one record more or less moves P by 0.025, as much as the whole band of the fit on
// one side, and while none was seen (60 % of the studies where half a record is expected) the band holds each P from the fit's to the
// limit, among them the truth. By simulation 0.96, 0.97 and 0.92 (300 repeats, error 0.01) where half a record, one and two are expected.
TEST(Bands, NinetyPercentBelowTheLimitOfNoneOverturned) {
  const int repeats = repeats_asked(100);
  for (const double records : {0.0, 1.0}) {
    const Study study{40, 25, 0.3, 0.3, records / 40};
    double fitted_rows = 0;
    for (int r = 0; r < repeats; ++r) fitted_rows += holds(rows(study, static_cast<std::uint64_t>(r)).fitted, 2, study);
    if (records == 0)
      expect_ninety(fitted_rows, repeats, "fitted_0");
    else
      EXPECT_NEAR(fitted_rows / repeats, 0.967, 3 * error_of_share(0.967, repeats));
  }
}

// Where nothing overturned, a capacity that the fit says is never exceeded has the limit of what was not seen; a demand that goes by its
// own value whether overturned or not has none.
TEST(Bands, WhatWasNotSeenLimitsOnlyDemandsThatItWouldCensor) {
  Options o = options(40);
  o.edps[0].capacities = {100};
  o.empirical_fallback = false;
  for (const bool censored : {true, false}) {
    o.edps[0].censored = censored;
    const Surface found = fit(counted(o, {40, 25, 0.5, 0.5}, 5)).edps[0].surface;
    if (censored)
      EXPECT_NEAR(found.upper[0], 1 - std::pow(0.025, 1.0 / 40), 1e-3);
    else
      EXPECT_LT(found.upper[0], 1e-3);
  }
}

TEST(Bands, OfOneRecordSaySo) {
  const Result result = fit(counted(options(1), {1, 300, 0.5, 0.4}, 7));
  EXPECT_TRUE(std::isfinite(result.edps[0].surface.lower[1]));
  EXPECT_THAT(result.warnings, testing::Contains(testing::HasSubstr("only one record")));
  const Result few = fit(counted(options(4), {4, 100, 0.5, 0.4}, 7));
  EXPECT_THAT(few.warnings, testing::Contains(testing::HasSubstr("only 4 motions")));
}

}  // namespace
}  // namespace freestand::fragility
