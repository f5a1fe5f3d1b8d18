#include "fragility/fragility_function.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fragility/draws.hpp"
#include "fragility/fit.hpp"
#include "fragility/probit.hpp"

namespace freestand::fragility {
namespace {

TEST(Overturning, CurveOfATallyHasABandThatHoldsTheTruth) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0, 0.5, 1, 1.5, 2};
  options.edps = {{"overturned", "1", "", true, 0, {}}};
  options.resamples = 200;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double im = 2 * test::uniform(i, 500);
    const double p = 0.5 * std::erfc(-std::log(im / 0.9) / 0.45 / std::sqrt(2.0));
    const bool over = test::uniform(i, 501) < p;
    const double value = over;
    tally.add({i, im, 0, over ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
  }
  const Resampling resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1);
  const FragilityFunction curve = overturning_function(tally, resampling);
  EXPECT_NEAR(curve.median, 0.9, 4 * curve.median_se);
  EXPECT_NEAR(curve.dispersion, 0.45, 4 * curve.dispersion_se);
  EXPECT_LT(curve.median_se, 0.02);
  EXPECT_EQ(curve.grid.front(), 0.5);
  EXPECT_EQ(curve.grid.back(), 2);
  for (std::size_t i = 0; i < curve.grid.size(); ++i) {
    EXPECT_LE(curve.lower[i], curve.probability[i]);
    EXPECT_GE(curve.upper[i], curve.probability[i]);
    EXPECT_LT(curve.upper[i] - curve.lower[i], 0.1);
  }
}

// Studies of 40 motions with 25 samples each. The capacity of a sample is lognormal, by 0.35 from motion to motion and by
// 0.3 within one, so that the curve over all motions is exactly lognormal, with the dispersion hypot(0.35, 0.3).
constexpr int motions = 40, each = 25;
constexpr double truth_median = 0.9, between = 0.35, within = 0.3;

Options many_motions(bool group_by_motion) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0, 0.5, 1, 1.5, 2};
  options.edps = {{"overturned", "1", "", true, 0, {}}};
  options.resamples = 80;
  for (int i = 0; group_by_motion && i < motions; ++i) options.motion_group.push_back(i);
  return options;
}

// capacity(motion, sample) in logarithms
template <class Capacity>
FragilityFunction curve_of(const Options& options, std::uint64_t stream, const Capacity& ln_capacity) {
  Tally tally(options);
  std::uint64_t i = 0;
  for (std::uint64_t m = 0; m < motions; ++m)
    for (int k = 0; k < each; ++k, ++i) {
      const double im = 2 * test::uniform(i, stream + 1);
      const bool over = std::log(im) > ln_capacity(m, i);
      const double value = over;
      tally.add({i, im, static_cast<int>(m), over ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
    }
  return overturning_function(tally,
                              Resampling(tally.groups(), tally.groups_with_samples(), options.resamples, stream));
}

FragilityFunction true_curve(bool group_by_motion, std::uint64_t repeat) {
  const std::uint64_t stream = 9000 + 10 * repeat;
  return curve_of(many_motions(group_by_motion), stream, [&](std::uint64_t m, std::uint64_t i) {
    return std::log(truth_median) + between * test::normal(m, stream + 2) + within * test::normal(i, stream + 3);
  });
}

// Nominal 95 %, of which 1.96 standard errors from 40 motions fall short by one or two; of 200 repeats the standard deviation
// of a share is 0.02. Samples counted as independent cover about 0.6.
TEST(FragilityFunction, StandardErrorsTakeMotionsAsTheUnit) {
  constexpr int repeats = 200, naive_repeats = 50;
  double median = 0, dispersion = 0, naive = 0;
  for (std::uint64_t r = 0; r < repeats; ++r) {
    const FragilityFunction curve = true_curve(true, r);
    median += std::fabs(curve.median - truth_median) < 1.96 * curve.median_se;
    dispersion += std::fabs(curve.dispersion - std::hypot(between, within)) < 1.96 * curve.dispersion_se;
    if (r >= naive_repeats) continue;
    const FragilityFunction samples = true_curve(false, r);
    naive += std::fabs(samples.median - truth_median) < 1.96 * samples.median_se;
  }
  RecordProperty("median", std::to_string(median / repeats));
  RecordProperty("dispersion", std::to_string(dispersion / repeats));
  RecordProperty("naive", std::to_string(naive / naive_repeats));
  EXPECT_GT(median / repeats, 0.88);
  EXPECT_GT(dispersion / repeats, 0.85);
  EXPECT_LT(naive / naive_repeats, 0.8);
}

// Of 200 true curves a 5 % test rejects 10 +- 3; resampling 40 motions lets pass a little more.
TEST(FragilityFunction, MisfitOfATrueCurveIsRarelyCalledOne) {
  int rejected = 0, by_rates = 0;
  for (std::uint64_t r = 0; r < 200; ++r) {
    const FragilityFunction curve = true_curve(true, r);
    EXPECT_GT(curve.misfit, 0);
    rejected += curve.misfit_p < 0.05;
    by_rates += rates_differ(curve);
  }
  RecordProperty("rejected", rejected);
  RecordProperty("by_rates", by_rates);
  EXPECT_LE(rejected, 20);
  EXPECT_LE(by_rates, 16);  // 10 + 2 sqrt(10)
}

// Forty motions cannot tell the true shares to 0.05: that a test does not refute the curve is no proof that it may stand for them.
TEST(FragilityFunction, WhatIsMerelyNotRefutedIsNotAdequate) {
  int not_refuted_ones = 0;
  for (std::uint64_t r = 0; r < 20; ++r) {
    const FragilityFunction curve = true_curve(true, r);
    EXPECT_EQ(curve.adequate, curve.off_by <= Options{}.adequate && !rates_differ(curve));
    EXPECT_EQ(not_refuted(curve), !curve.adequate && curve.misfit_p > 0.05 && !rates_differ(curve));
    not_refuted_ones += not_refuted(curve);
  }
  EXPECT_GE(not_refuted_ones, 15);
}

// Of shares that stay small every curve is within 0.05. 6000 pulses, intensities spread evenly from 0.05 to 2: of those above `onset` a share
// overturns, of the others none. A lognormal through that is so wide that it has many times the events at low intensities.
FragilityFunction small_curve(double share, double onset, double median, std::uint64_t repeat) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.05, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2};
  options.edps = {{"overturned", "1", "", true, 0, {}}};
  options.resamples = 60;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const double im = 0.05 + 1.95 * test::uniform(i, 700 + 10 * repeat), u = test::uniform(i, 701 + 10 * repeat);
    const bool over = std::isnan(median) ? im > onset && u < share
                                         : u < 0.5 * std::erfc(-std::log(im / median) / 0.5 / std::sqrt(2.0));
    const double value = over;
    tally.add({i, im, 0, over ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
  }
  return overturning_function(tally, Resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1));
}

// What happens at middle intensities has no curve that grows; how its shares rise within the first bin is known all the same.
TEST(FragilityFunction, OfWhatFallsTheCellsAreKept) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.02, 0.5, 1, 1.5, 2};
  options.edps = {{"moved_a_little", "1", "", true, 0, {}}};
  options.resamples = 20;
  Tally tally(options);
  const auto share = [](double im) {
    return im < 0.2 ? 0 : im < 0.4 ? 4 * (im - 0.2) : 0.8 * std::exp(-3 * (im - 0.4));
  };
  for (std::uint64_t i = 0; i < 40000; ++i) {
    const double im = 0.02 + 1.98 * test::uniform(i, 910), value = test::uniform(i, 911) < share(im);
    tally.add({i, im, 0, Outcome::moved, {&value, 1}, {}});
  }
  const FragilityFunction curve =
      fragility_function(tally, 0, 0, Resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1));
  ASSERT_TRUE(std::isnan(curve.median));
  ASSERT_GT(curve.cell_im.size(), 16U);
  const std::size_t cells = curve.cell_share.size();
  ASSERT_EQ(curve.resampled_cell_share.size(), 20 * cells);
  double square = 0,
         expected = 0;  // of what resamples change about the shares, and what chance of as many samples does
  for (std::size_t r = 0; r < 20; ++r)
    for (std::size_t k = 0; k < cells; ++k) {
      square += std::pow(curve.resampled_cell_share[r * cells + k] - curve.cell_share[k], 2);
      expected += curve.cell_share[k] * (1 - curve.cell_share[k]) * static_cast<double>(cells) / 40000;
    }
  EXPECT_NEAR(square / expected, 1, 0.4);
  for (std::size_t k = 0; k < curve.cell_im.size(); ++k)
    EXPECT_NEAR(curve.cell_share[k], share(curve.cell_im[k]), 0.08) << curve.cell_im[k];
}

// A lognormal meets the shares of any two bins, whatever lies between: no bound comes of that.
TEST(FragilityFunction, OfTwoBinsNoBoundIsKnown) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.05, 1, 2};
  options.edps = {{"overturned", "1", "", true, 0, {}}};
  options.resamples = 60;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const double im = 0.05 + 1.95 * test::uniform(i, 900), value = im > 0.9 && test::uniform(i, 901) < 0.5;
    tally.add({i, im, 0, value > 0 ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
  }
  const FragilityFunction curve =
      overturning_function(tally, Resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1));
  ASSERT_TRUE(std::isfinite(curve.median));
  EXPECT_TRUE(std::isnan(curve.off_by)) << curve.off_by;
  EXPECT_FALSE(curve.adequate);
}

TEST(FragilityFunction, SmallSharesThatAreNotTheCurvesRefuteIt) {
  const FragilityFunction curve = small_curve(0.03, 0.5, NAN, 0);
  ASSERT_LT(curve.off_by, Options{}.adequate);
  EXPECT_TRUE(rates_differ(curve));
  EXPECT_FALSE(curve.adequate);
  EXPECT_FALSE(not_refuted(curve));
}

// With the median at 5.5, of which 2 per cent have overturned at 2: true, and hardly anything is counted below 1.
TEST(FragilityFunction, SmallSharesOfATrueCurveRarelyDo) {
  int refuted = 0, off_by_little = 0;
  constexpr int repeats = 100;
  for (std::uint64_t r = 0; r < repeats; ++r) {
    const FragilityFunction curve = small_curve(0, 0, 5.5, r + 1);
    refuted += rates_differ(curve);
    off_by_little += curve.off_by < Options{}.adequate;
  }
  RecordProperty("refuted", refuted);
  EXPECT_EQ(off_by_little, repeats);
  EXPECT_LE(refuted, 9);  // 5 + 2 sqrt(5 * 0.95)
}

// Half of the samples fall at 0.4 and half never: no lognormal rises to one half and stays there.
TEST(FragilityFunction, MisfitIsFoundWhereOneCurveIsTooSimple) {
  int rejected = 0;
  for (std::uint64_t r = 0; r < 20; ++r) {
    const FragilityFunction curve = curve_of(many_motions(true), 40000 + 10 * r, [](std::uint64_t, std::uint64_t i) {
      return i % 2 ? std::log(0.4) + 0.1 * test::normal(i, 77) : 10.0;
    });
    rejected += curve.misfit_p < 0.05;
    EXPECT_GT(curve.misfit, 0.05);
    EXPECT_GT(curve.misfit_im, 0);
  }
  EXPECT_GE(rejected, 18);
}

// ln EDP = ln 0.1 + 1.5 ln IM + 0.6 z: half lie above C at IM = (C/0.1)^(1/1.5), with the dispersion 0.6/1.5.
TEST(FragilityFunction, OfADemandAboveACapacityFollowsFromItsLaw) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.1, 0.5, 1, 2};
  options.edps = {{"slip", "m", "", false, 0, {0.05, 0.1}}};
  options.resamples = 100;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double im = 0.1 * std::exp(std::log(20.0) * test::uniform(i, 600));
    const double slip = 0.1 * std::pow(im, 1.5) * std::exp(0.6 * test::normal(i, 601));
    tally.add({i, im, 0, Outcome::moved, {&slip, 1}, {}});
  }
  const Resampling resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1);
  for (std::size_t c = 0; c < 2; ++c) {
    const FragilityFunction curve = fragility_function(tally, 0, c, resampling);
    EXPECT_NEAR(curve.median, std::pow(options.edps[0].capacities[c] / 0.1, 1 / 1.5), 4 * curve.median_se);
    EXPECT_NEAR(curve.dispersion, 0.4, 4 * curve.dispersion_se);
    EXPECT_LT(curve.dispersion_se, 0.02);
    EXPECT_TRUE(curve.adequate);
    EXPECT_LT(curve.off_by, 0.05);
    EXPECT_EQ(curve.resampled_median.size(), 100u);
  }
}

// Of samples of which one in seventy never moves at high intensities the curve is wrong by 0.013: with few samples that is chance.
TEST(FragilityFunction, OffByLittleIsAdequateHoweverManySamplesTellIt) {
  const auto curve_to = [](double ceiling, double above, double adequate) {
    Options options;
    options.im_name = "pga";
    options.im_edge = {0.1, 0.5, 1, 1.5, 2, 3};
    options.edps = {{"overturned", "1", "", true, 0, {}}};
    options.resamples = 100;
    options.adequate = adequate;
    Tally tally(options);
    for (std::uint64_t i = 0; i < 100000; ++i) {
      const double im = 0.1 + 2.9 * test::uniform(i, 610);
      const double law = 0.5 * std::erfc(-std::log(im / 0.9) / 0.45 / std::sqrt(2.0));
      const double p = im > above ? ceiling * law : law;
      const double over = test::uniform(i, 611) < p;
      tally.add({i, im, 0, over > 0 ? Outcome::overturned : Outcome::moved, {&over, 1}, {}});
    }
    return overturning_function(tally, Resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1));
  };
  const FragilityFunction slightly = curve_to(0.985, 2.5, 0.05), badly = curve_to(0.6, 0, 0.05);
  EXPECT_LT(slightly.misfit_p, 0.05);
  EXPECT_TRUE(slightly.adequate);
  EXPECT_LT(slightly.off_by, 0.05);
  EXPECT_GT(slightly.off_by, slightly.misfit);
  EXPECT_FALSE(curve_to(0.985, 2.5, 0.005).adequate);
  // Off by 0.015 as well, but where 0.02 are counted, which is half as many again.
  const FragilityFunction low = curve_to(0.96, 0, 0.05);
  EXPECT_LT(low.off_by, 0.05);
  EXPECT_FALSE(low.adequate);
  EXPECT_FALSE(badly.adequate);
  EXPECT_GT(badly.off_by, 0.05);
}

TEST(FragilityFunction, MedianBeyondWhatWasSweptIsAnExtrapolation) {
  const auto at = [](double median) {
    return curve_of(many_motions(true), 50000,
                    [median](std::uint64_t, std::uint64_t i) { return std::log(median) + 0.6 * test::normal(i, 78); });
  };
  const FragilityFunction inside = at(1.2), beyond = at(3.5);
  EXPECT_FALSE(inside.extrapolated);
  EXPECT_TRUE(beyond.extrapolated);
  EXPECT_GT(beyond.median, 2);
  EXPECT_GT(beyond.im_least, 0);
  EXPECT_LT(beyond.im_least, 0.05);
  EXPECT_GT(beyond.im_most, 1.95);
  EXPECT_LT(beyond.im_most, 2);
}

// Beyond the largest demands seen a median is a guess, of whatever demand and capacity.
TEST(FragilityFunction, WarningsNameCapacitiesWhoseMediansLieBeyondWhatWasSwept) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.1, 0.5, 1, 2};
  options.edps = {{"slip", "m", "", false, 0, {0.05, 0.6, 1}}};
  options.resamples = 50;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double im = 0.1 * std::exp(std::log(20.0) * test::uniform(i, 620));
    const double slip = 0.1 * std::pow(im, 1.5) * std::exp(0.6 * test::normal(i, 621));
    tally.add({i, im, 0, Outcome::moved, {&slip, 1}, {}});
  }
  const Result result = fit(tally);
  // (C/0.1)^(1/1.5): 0.63, 3.3 and 4.6.
  const auto& functions = result.edps[0].functions;
  EXPECT_FALSE(functions[0].extrapolated);
  EXPECT_TRUE(functions[1].extrapolated && functions[2].extrapolated);
  std::string told;
  for (const std::string& warning : result.warnings)
    if (warning.find("outside the intensities swept") != std::string::npos) told += warning;
  EXPECT_NE(told.find("slip: "), std::string::npos) << told;
  EXPECT_NE(told.find("slip > 0.6 m"), std::string::npos) << told;
  EXPECT_NE(told.find("slip > 1 m"), std::string::npos) << told;
  EXPECT_EQ(told.find("slip > 0.05 m"), std::string::npos) << told;
}

// Of what happens or not there is no capacity to name.
TEST(FragilityFunction, WarningsNameWhatHappensOrNot) {
  Options options;
  options.im_name = "pga";
  options.im_edge = {0.1, 0.5, 1, 2};
  options.edps = {{.name = "wall_hit", .binary = true, .censored = false}};
  options.resamples = 50;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double im = 0.1 * std::exp(std::log(20.0) * test::uniform(i, 622));
    const double hit = im > 0.4 && test::uniform(i, 623) < 0.5;  // no lognormal
    tally.add({i, im, 0, Outcome::moved, {&hit, 1}, {}});
  }
  std::string told;
  for (const std::string& warning : fit(tally).warnings) told += warning;
  EXPECT_NE(told.find("for wall_hit (by"), std::string::npos) << told;
}

}  // namespace
}  // namespace freestand::fragility
