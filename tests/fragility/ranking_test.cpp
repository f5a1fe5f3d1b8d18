#include "fragility/ranking.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>

#include "base/random.hpp"
#include "fragility/probit.hpp"

namespace freestand::fragility::ranking_test {
namespace {

// Standard normal numbers by counter.
double normal(std::uint64_t seed, std::uint64_t i, std::uint64_t stream) {
  return std::sqrt(-2 * std::log(random::uniform(seed, i, stream))) *
         std::cos(6.283185307179586 * random::uniform(seed, i, stream + 1));
}

constexpr int motions = 40, samples_each = 25;

struct Made {
  double scatter = 0.2, of_motion = 0.3;  // of ln demand: between samples, and between motions
  double on_period = 0;                   // slope of ln demand over ln period
  bool pulses = false;                    // every sample a motion, with a period of its own
};

RankingOptions options(const std::vector<std::string>& ims, bool pulses, std::uint64_t seed) {
  RankingOptions options{ims, {{"peak_slip_m", false, 1e-4, true}, {"overturned", true, 0, false}}, {}, {}};
  MotionProperty period{.name = "period_s", .of_pulses = pulses, .value = {}};
  for (int m = 0; m < (pulses ? 1 : motions); ++m) {
    options.motion_group.push_back(pulses ? -1 : m);
    if (!pulses) period.value.push_back(std::exp(0.5 * normal(seed, static_cast<std::uint64_t>(m), 70)));
  }
  options.properties.push_back(period);
  return options;
}

// ln demand = 2 + 1.5 ln im[0] + what Made says; the other intensities are im[0] times more and more noise. A block
// overturns by chance at a probability that rises with im[0].
RankingTally made(std::size_t ims, const Made& made, std::uint64_t seed) {
  const std::vector<std::string> names = {"first", "second", "third"};
  RankingTally tally(options({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(ims)}, made.pulses, seed));
  for (std::uint64_t i = 0; i < motions * samples_each; ++i) {
    const auto m = made.pulses ? i : i % motions;
    const double ln_period = made.pulses ? 0.5 * normal(seed, i, 50) : 0.5 * normal(seed, m, 70);
    const double x = 0.8 * normal(seed, i, 10);
    std::vector<double> im;
    for (std::size_t k = 0; k < ims; ++k)
      im.push_back(std::exp(x + 0.3 * static_cast<double>(k) * normal(seed, i, 20 + 2 * k)));
    const double y = 2 + 1.5 * x + made.scatter * normal(seed, i, 30) + made.of_motion * normal(seed, m, 40) +
                     made.on_period * ln_period;
    const bool over = x + 0.4 * normal(seed, i, 60) > 0.7;
    const double edp[] = {std::exp(y), over ? 1.0 : 0.0};
    tally.add({i, made.pulses ? 0 : static_cast<int>(m), over, made.pulses ? std::exp(ln_period) : unknown, im, edp});
  }
  return tally;
}

TEST(Ranking, TheIntensityThatTheDemandFollowsComesFirstAndClearly) {
  const std::vector<RankedDemand> ranked = rank(made(3, {}, 1));
  ASSERT_EQ(ranked.size(), 2u);
  for (const RankedDemand& demand : ranked) {
    EXPECT_EQ(demand.ims[0].im, "first") << demand.edp;
    EXPECT_EQ(demand.ims[1].im, "second") << demand.edp;
    EXPECT_EQ(demand.ims[0].behind, 0);
    EXPECT_GT(demand.ims[1].behind, 2 * demand.ims[1].behind_se) << demand.edp;
    EXPECT_GT(demand.ims[2].behind, demand.ims[1].behind) << demand.edp;
  }
  const RankedIm& best = ranked[0].ims[0];
  EXPECT_NEAR(best.slope, 1.5, 0.1);
  EXPECT_NEAR(best.value, std::hypot(0.2, 0.3), 4 * best.value_se);
  EXPECT_GT(ranked[1].ims[0].parts, ranked[1].ims[1].parts);
}

// The line through the same numbers, by the formulas of a textbook.
// Of two that differ by a constant neither foretells better: round-off had put either first, and some clearly.
TEST(Ranking, AnIntensityTimesAConstantIsAsGood) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RankingTally tally(options({"plain", "in other units"}, true, 1));
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const double im = std::exp(normal(seed, i, 10)), over = im > 2 + normal(seed, i, 20);
      const double ims[] = {im, 2.54 * im}, edps[] = {im * std::exp(0.2 * normal(seed, i, 30)), over};
      tally.add({i, 0, over > 0, 1.0, ims, edps});
    }
    const RankedDemand slip = rank(tally)[0];
    ASSERT_EQ(slip.ims.size(), 2u);
    EXPECT_EQ(slip.ims[0].im, "plain") << seed;
    EXPECT_EQ(slip.ims[1].behind, 0) << seed;
    EXPECT_EQ(slip.ims[1].behind_se, 0) << seed;
  }
}

TEST(Ranking, ScatterAndSlopeAreThoseOfALeastSquaresLine) {
  const std::uint64_t seed = 4;
  const std::vector<RankedDemand> ranked = rank(made(2, {}, seed));
  std::vector<double> xs, ys;
  for (std::uint64_t i = 0; i < motions * samples_each; ++i) {
    const double x = 0.8 * normal(seed, i, 10);
    if (x + 0.4 * normal(seed, i, 60) > 0.7) continue;  // overturned: no slip
    xs.push_back(x);
    ys.push_back(2 + 1.5 * x + 0.2 * normal(seed, i, 30) + 0.3 * normal(seed, i % motions, 40));
  }
  double mx = 0, my = 0, xx = 0, xy = 0, rest = 0;
  const auto n = static_cast<double>(xs.size());
  for (std::size_t i = 0; i < xs.size(); ++i) mx += xs[i] / n, my += ys[i] / n;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    xx += (xs[i] - mx) * (xs[i] - mx);
    xy += (xs[i] - mx) * (ys[i] - my);
  }
  for (std::size_t i = 0; i < xs.size(); ++i) rest += std::pow(ys[i] - my - xy / xx * (xs[i] - mx), 2);
  EXPECT_EQ(ranked[0].ims[0].samples, static_cast<std::int64_t>(xs.size()));
  EXPECT_NEAR(ranked[0].ims[0].slope, xy / xx, 1e-8);
  EXPECT_NEAR(ranked[0].ims[0].value, std::sqrt(rest / (n - 2)), 1e-8);
}

// 400 sets without any dependence: a test of 5 % that takes motions as the unit finds one in 20 of them, within three
// standard errors of that count (sqrt(400 * 0.05 * 0.95) = 4.4). Over samples it would find more than half.
TEST(Sufficiency, FindsNothingWhereThereIsNothing) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    found += rank(made(1, {}, 1000 + seed))[0].ims[0].sufficiency[0].p < 0.05;
  EXPECT_NEAR(found, 20, 14);
}

TEST(Sufficiency, FindsWhatIsThereOnRecordsAndOnPulses) {
  for (const bool pulses : {false, true}) {
    const std::vector<RankedDemand> ranked = rank(made(1, {.on_period = 0.6, .pulses = pulses}, 5));
    const Sufficiency& left = ranked[0].ims[0].sufficiency[0];
    EXPECT_EQ(left.motions, pulses ? ranked[0].ims[0].samples : motions);
    EXPECT_LT(left.p, 1e-3);
    EXPECT_NEAR(left.slope, 0.6, 4 * left.slope_se);
    EXPECT_LT(left.slope_se, 0.2);
  }
}

// Records of one group count once: 40 motions in 10 groups are 10.
TEST(Sufficiency, GroupsOfRecordsAreOneUnit) {
  RankingOptions grouped = options({"first"}, false, 5);
  for (int& group : grouped.motion_group) group %= 10;
  RankingTally tally(grouped);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double im[] = {std::exp(normal(5, i, 1))}, edp[] = {std::exp(normal(5, i, 3)), 0.0};
    tally.add({i, static_cast<int>(i % motions), false, unknown, im, edp});
  }
  EXPECT_EQ(rank(tally)[0].ims[0].sufficiency[0].motions, 10);
}

TEST(Ranking, AnySplitOfTheSamplesGivesTheSameBits) {
  const RankingOptions opts = options({"first"}, false, 3);
  RankingTally whole(opts), odd(opts), even(opts);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double im[] = {std::exp(normal(3, i, 1))}, edp[] = {std::exp(-5 + normal(3, i, 3)), i % 7 == 0 ? 1.0 : 0.0};
    const RankedSample sample{i, static_cast<int>(i % motions), false, unknown, im, edp};
    whole.add(sample);
    (i % 2 ? odd : even).add(sample);
  }
  std::vector<std::int64_t> words = odd.words();
  const std::vector<std::int64_t> more = even.words();
  for (std::size_t i = 0; i < words.size(); ++i) words[i] += more[i];
  EXPECT_EQ(RankingTally::from_words(opts, words).words(), whole.words());
  words.pop_back();
  EXPECT_THROW(RankingTally::from_words(opts, words), Error);
}

TEST(Ranking, AnIntensityThatPartsAllHasAllTheDevianceAndAllPairs) {
  RankingTally tally(options({"perfect", "blind"}, true, 1));
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double x = random::uniform(1, i, 1);
    const double im[] = {0.1 + x, 0.1 + random::uniform(1, i, 2)}, edp[] = {unknown, x > 0.6 ? 1.0 : 0.0};
    tally.add({i, 0, x > 0.6, 1, im, edp});
  }
  const std::vector<RankedDemand> ranked = rank(tally);
  ASSERT_EQ(ranked.size(), 1u);  // no demand that moved
  EXPECT_EQ(ranked[0].ims[0].im, "perfect");
  EXPECT_GT(ranked[0].ims[0].parts, 0.99);
  EXPECT_GT(ranked[0].ims[0].value, 0.95);
  EXPECT_NEAR(ranked[0].ims[1].parts, 0.5, 0.05);
  EXPECT_NEAR(ranked[0].ims[1].value, 0, 0.01);
}

// "over" is 0 below a threshold, and above it follows the demand as badly as "whole" does there: demands scatter more where it is 0. Judged
// on its own samples alone it would come out first.
RankingTally over_a_threshold(bool one_more, std::vector<double>* left = nullptr) {
  RankingOptions opts = options({"whole", "over"}, false, 7);
  if (one_more) opts.ims.push_back("nothing");
  RankingTally tally(opts);
  double sums[2][6] = {};  // below, above: n, x, y, xx, xy, yy
  for (std::uint64_t i = 0; i < motions * samples_each; ++i) {
    const double x = 0.8 * normal(7, i, 10), excess = std::exp(x) - 1;
    const double y = x + (excess > 0 ? 0.3 : 1.2) * normal(7, i, 30);
    const double im[] = {std::exp(x), std::max(0.0, excess), 0.0}, edp[] = {std::exp(y), 0.0};
    tally.add({i, static_cast<int>(i % motions), false, unknown, std::span(im, one_more ? 3 : 2), edp});
    const double ln = excess > 0 ? std::log(excess) : 0, terms[] = {1, ln, y, ln * ln, ln * y, y * y};
    for (int k = 0; k < 6; ++k) sums[excess > 0][k] += terms[k];
  }
  if (left) {
    const auto& [n0, x0, y0, xx0, xy0, yy0] = sums[0];
    const auto& [n, x, y, xx, xy, yy] = sums[1];
    const double sxx = xx - x * x / n, sxy = xy - x * y / n, syy = yy - y * y / n;
    *left = {n0 + n, std::sqrt((syy - sxy * sxy / sxx + yy0 - y0 * y0 / n0) / (n0 + n - 3))};
  }
  return tally;
}

TEST(Ranking, IntensitiesAreJudgedOnTheSameSamplesWhereOneIsZero) {
  std::vector<double> left;
  const RankedDemand slip = rank(over_a_threshold(false, &left))[0];
  EXPECT_EQ(slip.ims[0].im, "whole");
  EXPECT_EQ(slip.ims[0].samples, motions * samples_each);
  EXPECT_EQ(slip.ims[1].samples, motions * samples_each);
  // A line where it is above 0, a mean where it is not.
  EXPECT_EQ(slip.ims[1].samples, left[0]);
  EXPECT_NEAR(slip.ims[1].value, left[1], 1e-8);
}

TEST(Ranking, AnIntensityThatIsAlwaysZeroComesLastAndChangesNoOther) {
  const RankedDemand without = rank(over_a_threshold(false))[0], with = rank(over_a_threshold(true))[0];
  ASSERT_EQ(with.ims.size(), 3u);
  EXPECT_EQ(with.ims[2].im, "nothing");
  EXPECT_TRUE(std::isnan(with.ims[2].value));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(with.ims[k].im, without.ims[k].im);
    EXPECT_EQ(with.ims[k].value, without.ims[k].value);
    EXPECT_EQ(with.ims[k].behind_se, without.ims[k].behind_se);
  }
}

// What happens where an intensity is 0 has a share of its own: a curve over its logarithm cannot hold it, and what it knows above is kept.
TEST(Ranking, WhatHappensWhereAnIntensityIsZeroSpoilsNoCurve) {
  RankingTally tally(options({"excess"}, true, 1));
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double x = random::uniform(1, i, 1);  // below 0.5 one in two, whatever x is; above, from 0.8 on
    const double happens = x < 0.5 ? random::uniform(1, i, 2) < 0.5 : x > 0.8;
    const double im[] = {std::max(0.0, x - 0.5)}, edp[] = {unknown, happens};
    tally.add({i, 0, happens > 0, 1, im, edp});
  }
  // 0.25 + 0.2 happen; of the deviance of all, what is left is that of the half at one in two.
  const double p = 0.45, all = -p * std::log(p) - (1 - p) * std::log(1 - p), left = 0.5 * std::log(2.0);
  EXPECT_NEAR(rank(tally)[0].ims[0].value, 1 - left / all, 0.02);
}

TEST(Ranking, WithoutWhatItNeedsThereIsNone) {
  RankingTally tally(options({"first"}, true, 1));
  EXPECT_TRUE(rank(tally).empty());
  const double im[] = {1.0}, edp[] = {1.0, 0.0};
  EXPECT_THROW(tally.add({0, 3, false, 1, im, edp}), Error);
  EXPECT_THROW(tally.add({0, 0, false, 1, im, std::span(edp, 1)}), Error);
}

// The least numbers of folds, events and motions of ranking.cpp.

TEST(LeastNumbers, FiveFoldsKnowAnErrorWithinAFactorOfTwo) {
  const auto share = [](int folds) {  // of standard errors that are told between half and twice the true one
    const double freedom = folds - 1;
    return gsl_cdf_chisq_P(4 * freedom, freedom) - gsl_cdf_chisq_P(0.25 * freedom, freedom);
  };
  EXPECT_GE(share(5), 0.9);
  EXPECT_LT(share(4), 0.9);
}

// Ten events among many samples, dispersion 0.5, by simulation: the slope's bias, over the true one.
TEST(LeastNumbers, TenEventsKeepTheBiasOfACurveSmall) {
  const auto bias_with = [](double median) {
    double sum = 0, events = 0;
    int fits = 0;
    for (std::uint64_t set = 0; set < 1500; ++set) {
      std::vector<ProbitPoint> points;
      double hits = 0;
      for (std::uint64_t i = 0; i < 150; ++i) {
        const double ln_im = 0.6 * normal(set, i, 10), p = 0.5 * std::erfc(-2 * (ln_im - median) / std::sqrt(2.0));
        const double hit = random::uniform(set, i, 20) < p;
        points.push_back({std::exp(ln_im), 1, hit});
        hits += hit;
      }
      if (hits < 8 || hits > 12) continue;
      events += hits;
      sum += fit_probit(points).b / 2 - 1;
      ++fits;
    }
    std::printf("%d sets with %.1f events: bias %.3f\n", fits, events / fits, sum / fits);
    return sum / fits;
  };
  EXPECT_LT(std::abs(bias_with(1.15)), 0.15);
}

// Samples of the records in turn; ln demand = ln IM and noise.
RankingTally shaken(const RankingOptions& options, std::uint64_t samples) {
  RankingTally tally(options);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double im = 0.1 + random::uniform(3, i, 1), edp = std::exp(0.2 * normal(3, i, 5)) * im;
    tally.add({.index = i,
               .motion = static_cast<int>(i % options.motion_group.size()),
               .overturned = false,
               .pulse_period_s = unknown,
               .im = {&im, 1},
               .edp = {&edp, 1}});
  }
  return tally;
}

// The property is known of a few records alone: a line through three leaves one degree of freedom, through two none.
TEST(LeastNumbers, ThreeMotionsHaveAChance) {
  for (const int known : {2, 3}) {
    constexpr int records = 12;
    RankingOptions few{{"pga_g"}, {{"peak_slip_m", false, 1e-4, true}}, {}, {}};
    MotionProperty period{.name = "period_s", .of_pulses = false, .value = {}};
    for (int m = 0; m < records; ++m) {
      few.motion_group.push_back(m);
      period.value.push_back(m < known ? 0.5 + m * m : unknown);
    }
    few.properties.push_back(period);
    const auto ranked = rank(shaken(few, 600));
    ASSERT_EQ(ranked.size(), 1U);
    const Sufficiency& found = ranked[0].ims[0].sufficiency.at(0);
    EXPECT_EQ(found.motions, known);
    EXPECT_EQ(std::isfinite(found.p), known == 3);
  }
}

// Too few folds for an error: four records are ranked by nothing.
TEST(LeastNumbers, WithoutAnErrorNothingIsRanked) {
  for (const int records : {4, 5}) {
    RankingOptions few{{"pga_g"}, {{"peak_slip_m", false, 1e-4, true}}, {}, {}};
    for (int m = 0; m < records; ++m) few.motion_group.push_back(m);
    EXPECT_EQ(rank(shaken(few, 400)).size(), records == 5 ? 1U : 0U);
  }
}

}  // namespace
}  // namespace freestand::fragility::ranking_test
