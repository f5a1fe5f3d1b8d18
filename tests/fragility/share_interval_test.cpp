#include "fragility/share_interval.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/keyed_random.hpp"

namespace freestand::fragility {
namespace {

TEST(ShareInterval, OfIndependentSamplesIsTheExactBinomialOne) {
  const std::vector<GroupShare> none{{50, 0}, {50, 0}}, single{{100, 0}};
  EXPECT_NEAR(share_interval(none, 0, 0.95).upper, 1 - std::pow(0.025, 1 / 100.0), 1e-12);
  // Of two records nothing more is known than that it did not happen in two.
  EXPECT_NEAR(share_interval(none, 2, 0.95).upper, 1 - std::pow(0.025, 1 / 2.0), 1e-12);
  EXPECT_EQ(share_interval({}, 0, 0.95).upper, 1);
}

double odds_limit(double p, double distance) { return 1 / (1 + (1 - p) / p * std::exp(-distance)); }

// Twenty records of ten, all of a record alike: worth twenty samples. Two values scatter less than normal ones, so with 19 degrees of
// freedom.
TEST(ShareInterval, OfRecordsThatAreAllAlikeCountsRecords) {
  std::vector<GroupShare> groups;
  for (int g = 0; g < 20; ++g) groups.push_back({10, g < 6 ? 10.0 : 0.0});
  const Interval found = share_interval(groups, 20, 0.9), exact = exact_interval(6, 20, 0.9);
  const double reach = gsl_cdf_tdist_Qinv(0.05, 19) / std::sqrt(0.21 * 19);
  EXPECT_NEAR(found.lower, odds_limit(0.3, -reach), 1e-12);
  EXPECT_NEAR(found.upper, odds_limit(0.3, reach), 1e-12);
  EXPECT_LT(found.upper - found.lower, exact.upper - exact.lower);  // those hold the truth oftener than they say
}

// Two pairs that are alike show no scatter at all: as independent samples.
TEST(ShareInterval, OfRecordsWithoutScatterIsThatOfIndependentSamples) {
  const std::vector<GroupShare> groups(8, {10, 5});
  const double reach = gsl_cdf_ugaussian_Qinv(0.05) / std::sqrt(80 * 0.25);
  EXPECT_NEAR(share_interval(groups, 8, 0.9).upper, odds_limit(0.5, reach), 1e-12);
}

// One sample of one record exceeds. Of Student's t with the freedom of one outlier among fourteen, 2/(2/13 + 14/14), the upper limit is at
// most that of none, which takes its place; the lower limit has what the upper one leaves of both tails.
TEST(ShareInterval, OfOneRecordHasTheUpperLimitOfNone) {
  std::vector<GroupShare> groups(14, {1000, 0});
  groups[3].hits = 1;
  const Interval found = share_interval(groups, 14, 0.9);
  const double of_none = 1 - std::pow(0.05, 1 / 14.0), p = 1 / 14e3, freedom = 2 / (2 / 13.0 + 1), se = 1;
  EXPECT_NEAR(found.upper, of_none, 1e-12);
  const double reached = gsl_cdf_tdist_Q(std::log(of_none / (1 - of_none) * (1 - p) / p) / se, freedom);
  EXPECT_NEAR(found.lower / odds_limit(p, -gsl_cdf_tdist_Qinv(0.1 - reached, freedom)), 1, 2e-3);
  groups[3].hits = 0;
  EXPECT_NEAR(share_interval(groups, 14, 0.9).upper, of_none, 1e-12);
}

// One record of ten shows all of it. Its error has hardly a degree of freedom, by which anything up to 0.97 would be within; but what nine
// records show nothing of is rarer than a record that shows something.
TEST(ShareInterval, IsNoMoreThanThatOfRecordsThatShowAnything) {
  std::vector<GroupShare> groups(10, {100, 0});
  groups[3].hits = 80;
  EXPECT_NEAR(share_interval(groups, 10, 0.9).upper, exact_interval(1, 10, 0.9).upper, 1e-12);
  for (GroupShare& g : groups) g.hits = g.n - g.hits;
  EXPECT_NEAR(share_interval(groups, 10, 0.9).lower, exact_interval(9, 10, 0.9).lower, 1e-12);
}

TEST(ShareInterval, OfMissesIsTheMirror) {
  const std::vector<std::vector<GroupShare>> sets{
      {{10, 1}, {20, 3}, {10, 0}, {5, 2}}, {{10, 0}, {20, 13}, {10, 0}, {5, 0}}, {{4, 4}, {4, 0}}, {{9, 9}, {9, 9}}};
  for (std::vector<GroupShare> groups : sets) {
    const std::size_t records = groups.size();
    const Interval found = share_interval(groups, records, 0.9);
    for (GroupShare& g : groups) g.hits = g.n - g.hits;
    const Interval mirrored = share_interval(groups, records, 0.9);
    EXPECT_NEAR(found.lower, 1 - mirrored.upper, 1e-9);
    EXPECT_NEAR(found.upper, 1 - mirrored.lower, 1e-9);
    EXPECT_LE(found.lower, found.upper);
  }
}

// Records, and beside them samples that are motions of their own: each by its limits, which add as errors do.
TEST(ShareInterval, OfRecordsAndOfSamplesOfTheirOwnLimitsAddAsErrors) {
  std::vector<GroupShare> groups;
  for (int g = 0; g < 20; ++g) groups.push_back({10, g < 10 ? 10.0 : 0.0});
  const Interval records = share_interval(groups, 20, 0.9), own = exact_interval(100, 400, 0.9);
  for (int g = 0; g < 4; ++g) groups.push_back({100, 25});
  const Interval both = share_interval(groups, 20, 0.9);
  const double p = 200.0 / 600;
  EXPECT_NEAR(both.upper, p + std::hypot((records.upper - 0.5) / 3, 2 * (own.upper - 0.25) / 3), 1e-12);
  EXPECT_NEAR(both.lower, p - std::hypot((records.lower - 0.5) / 3, 2 * (own.lower - 0.25) / 3), 1e-12);
}

// Four records of three quarters of all samples, in which nothing happened: at 90 % a record may show it with probability 0.527, whatever
// the pulses beside them tell.
TEST(ShareInterval, FewRecordsInWhichNothingHappenedTellLittle) {
  std::vector<GroupShare> groups;
  for (int g = 0; g < 4; ++g) groups.push_back({188, 0});
  groups.push_back({250, 0});
  const Interval found = share_interval(groups, 4, 0.9);
  EXPECT_EQ(found.lower, 0);
  EXPECT_NEAR(found.upper, 0.75 * 0.527, 0.01);
}

TEST(ShareInterval, OfOneRecordNothingIsKnown) {
  const std::vector<GroupShare> alone{{30, 12}}, beside{{30, 12}, {30, 12}};
  EXPECT_EQ(share_interval(alone, 1, 0.9).lower, 0);
  EXPECT_EQ(share_interval(alone, 1, 0.9).upper, 1);
  EXPECT_GT(share_interval(beside, 1, 0.9).upper, 0.4 + 0.5 * 0.6);
}

// One record of weight 60 beside 19 of weight 1: what it shows is one record, not the mean of all. Intervals hold their estimate.
TEST(ShareInterval, ARecordThatOutweighsTheOthersIsOneRecord) {
  std::vector<GroupShare> groups{{600, 500}};
  for (int g = 0; g < 19; ++g) groups.push_back({10, g % 2 ? 10.0 : 0.0});
  const Interval found = share_interval(groups, 20, 0.9);
  EXPECT_GT(found.upper - found.lower, 0.3);
  std::vector<GroupShare> rare{{600, 300}};
  for (int g = 0; g < 19; ++g) rare.push_back({10, 0});
  const Interval of_rare = share_interval(rare, 20, 0.9);
  EXPECT_LE(of_rare.lower, 300.0 / 790);
  EXPECT_GE(of_rare.upper, 300.0 / 790);
}

// Sixteen designs of 64 samples, of which each two answer alike: worth 512 independent ones. Limits by all 1024 hold the truth in 0.83 of
// such sets where 0.95 are meant.
TEST(ShareInterval, DesignsTellWhatTheirSamplesAreWorth) {
  constexpr int sets = 1000, designs = 16, pairs = 32;
  test::KeyedRandom random(19, 0);
  int held = 0, held_as_independent = 0;
  for (int set = 0; set < sets; ++set) {
    std::vector<GroupShare> groups(designs, {2.0 * pairs, 0});
    for (GroupShare& design : groups)
      for (int k = 0; k < pairs; ++k) design.hits += random.chance(0.5) ? 2 : 0;
    const Interval found = share_interval(groups, 0, 0.95, true), plain = share_interval(groups, 0, 0.95);
    held += found.lower <= 0.5 && 0.5 <= found.upper;
    held_as_independent += plain.lower <= 0.5 && 0.5 <= plain.upper;
    EXPECT_LE(found.lower, plain.lower);
    EXPECT_GE(found.upper, plain.upper);
  }
  const double error = std::sqrt(0.95 * 0.05 / sets);
  EXPECT_GT(held, sets * (0.95 - 3 * error));
  EXPECT_LT(held_as_independent, 0.88 * sets);
}

// Of a count that two designs make nothing is said but that it is one.
TEST(ShareInterval, DesignsOfWhichFewCountTellNothing) {
  std::vector<GroupShare> groups(16, {64, 0});
  groups[3].hits = 2;
  groups[7].hits = 1;
  EXPECT_EQ(share_interval(groups, 0, 0.95, true).upper, exact_interval(3, 1024, 0.95).upper);
}

}  // namespace
}  // namespace freestand::fragility
