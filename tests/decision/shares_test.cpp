// First-order and total shares against closed forms and by simulation.
#include "decision/shares.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "base/random.hpp"
#include "decision/total_shares.hpp"

namespace freestand::decision::shares_test {
namespace {

using fragility::Estimate;
using fragility::LeaveOutGroups;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Answer ln_demand{.edp = "y", .capacity = nan};

LeaveOutGroups groups_of(int records) {
  fragility::Options options;
  for (int r = 0; r < records; ++r) options.motion_group.push_back(r);
  return LeaveOutGroups(fragility::MotionGroups(options));
}
LeaveOutGroups no_records() { return LeaveOutGroups(fragility::MotionGroups(fragility::Options{})); }

double uniform(std::uint64_t seed, std::uint64_t counter, std::string_view stream) {
  return random::uniform(seed, counter, random::stable_hash(stream));
}
double normal(std::uint64_t seed, std::uint64_t counter, std::string_view stream) {
  return gsl_cdf_ugaussian_Pinv(uniform(seed, counter, stream));
}
int class_of(double u, int classes = 64) { return static_cast<int>(u * classes); }

// sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1 over [-pi, pi]^3 (T. Ishigami & T. Homma, Proc. ISUMA 1990): with a = 7, b = 0.1
//   V1 = (1 + b pi^4/5)^2/2, V2 = a^2/8, V13 = b^2 pi^8 8/225, V = V1 + V2 + V13.
double ishigami(const double* u) {
  const auto x = [&](int i) { return std::numbers::pi * (2 * u[i] - 1); };
  return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}
struct Ishigami {
  double pi4 = std::pow(std::numbers::pi, 4);
  double v1 = std::pow(1 + 0.1 * pi4 / 5, 2) / 2, v2 = 49 / 8.0, v13 = 0.01 * pi4 * pi4 * 8 / 225, v = v1 + v2 + v13;
};

TEST(Shares, IshigamiFirstOrderAndTotal) {
  const Ishigami exact;
  const LeaveOutGroups groups = no_records();
  const char* names[] = {"x1", "x2", "x3"};
  ShareTally tally({{"x1"}, {"x2"}, {"x3"}}, {ln_demand}, groups);
  TotalTally totals(3, {ln_demand}, groups);
  for (std::uint64_t i = 0; i < 40000; ++i) {
    double u[3];
    for (int k = 0; k < 3; ++k) u[k] = uniform(5, i, names[k]);
    const int group = static_cast<int>(i % 64), of_class[] = {class_of(u[0]), class_of(u[1]), class_of(u[2])};
    const double y = ishigami(u);
    tally.add(group, of_class, {&y, 1});
    for (int k = 0; k < 3 && i < 10000; ++k) {
      double again[] = {u[0], u[1], u[2]};
      again[k] = uniform(6, i, names[k]);
      const double z = ishigami(again);
      totals.add(static_cast<std::size_t>(k), group, group, {&y, 1}, {&z, 1});
    }
  }
  const ShareRow row = tally.row(0, 0.95);
  EXPECT_NEAR(row.share[0].value, exact.v1 / exact.v, 4 * row.share[0].se);
  EXPECT_NEAR(row.share[1].value, exact.v2 / exact.v, 4 * row.share[1].se);
  EXPECT_NEAR(row.share[2].value, 0, 4 * row.share[2].se);
  EXPECT_NEAR(1 - row.together.value, exact.v13 / exact.v, 4 * row.together.se);
  EXPECT_LT(row.together.se, 0.02);
  EXPECT_EQ(row.samples, 40000);
  EXPECT_EQ(row.motions, 64);
  EXPECT_NEAR(row.variance, exact.v, 0.2);
  const double total[] = {exact.v1 + exact.v13, exact.v2, exact.v13};
  for (std::size_t k = 0; k < 3; ++k) {
    const TotalShare found = totals.share(k, 0, 0.95);
    EXPECT_EQ(found.pairs, 10000);
    EXPECT_NEAR(found.share.value, total[k] / exact.v, 4 * found.share.se);
    EXPECT_LT(found.share.se, 0.03);
  }
}

// y = record + slope_record x + e: share of x = 1/12 (E slope)^2/V; between records V(b + s/2)/V.
struct Recorded {
  int records = 40, per_record = 25;
  double slope = 2, slope_scatter = 0.6, between = 0.5, noise = 0.7;

  double variance() const {
    return slope * slope / 12 + slope_scatter * slope_scatter / 3 + between * between + noise * noise;
  }
  double share_x() const { return slope * slope / 12 / variance(); }
  double share_motion() const {  // of record + slope/2
    return (between * between + slope_scatter * slope_scatter / 4) / variance();
  }
  double b(std::uint64_t seed, int r) const { return between * normal(seed, static_cast<std::uint64_t>(r), "b"); }
  double s(std::uint64_t seed, int r) const {
    return slope + slope_scatter * normal(seed, static_cast<std::uint64_t>(r), "s");
  }
  double y(std::uint64_t seed, int r, double x, std::uint64_t i) const {
    return b(seed, r) + s(seed, r) * x + noise * normal(seed, i, "e");
  }
};

// Share of stated 90 % intervals that hold the truth.
struct Coverage {
  double x = 0, motion = 0, mean_x = 0, mean_motion = 0;
};
Coverage coverage(const Recorded& model, int repeats, double confidence) {
  Coverage found;
  const LeaveOutGroups groups = groups_of(model.records);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto seed = static_cast<std::uint64_t>(repeat + 1);
    ShareTally tally({{"x"}, {.name = "motion", .classes = model.records, .ordered = false}}, {ln_demand}, groups);
    for (int r = 0, i = 0; r < model.records; ++r)
      for (int k = 0; k < model.per_record; ++k, ++i) {
        const double x = uniform(seed, static_cast<std::uint64_t>(i), "x");
        const double y = model.y(seed, r, x, static_cast<std::uint64_t>(i));
        const int of_class[] = {class_of(x), r};
        tally.add(groups.of(r), of_class, {&y, 1});
      }
    const ShareRow row = tally.row(0, confidence);
    const auto holds = [](const Estimate& e, double truth) { return e.lower <= truth && truth <= e.upper; };
    found.x += holds(row.share[0], model.share_x()) / static_cast<double>(repeats);
    found.motion += holds(row.share[1], model.share_motion()) / static_cast<double>(repeats);
    found.mean_x += row.share[0].value / repeats;
    found.mean_motion += row.share[1].value / repeats;
  }
  return found;
}

TEST(Shares, IntervalsHoldTheTruthWhereRecordsAreShared) {
  const Recorded model;
  const Coverage found = coverage(model, 1500, 0.90);
  RecordProperty("coverage_x", std::to_string(found.x));
  RecordProperty("coverage_motion", std::to_string(found.motion));
  // 1500 repeats know a coverage of 0.90 to 0.008.
  EXPECT_NEAR(found.x, 0.90, 0.03);
  EXPECT_NEAR(found.motion, 0.90, 0.03);
  EXPECT_NEAR(found.mean_x, model.share_x(), 0.01);
  EXPECT_NEAR(found.mean_motion, model.share_motion(), 0.01);
}

TEST(Shares, WhatHasNoPartIsZeroOnTheAverage) {
  Recorded model;
  model.slope = model.slope_scatter = 0;
  const Coverage found = coverage(model, 300, 0.90);
  EXPECT_NEAR(found.mean_x, 0, 0.002);
  EXPECT_GT(found.x, 0.86);
}

// Sobol points that are shifted at random. y = 2 x0 + x1 has shares of 4/5 and 1/5, and 1 together; x2 to x5 have none. Taking away
// what independent draws would scatter, 31/1599 of each, would leave 0.88 together. What the points leave on the average, which shifts do not change, is within the error
// that is told.
TEST(Shares, OfAnEvenDesignAreNotTakenForThoseOfIndependentDraws) {
  constexpr int samples = 1600, dimensions = 14, used = 6, repeats = 40;
  constexpr double by_independent_draws = 31 / 1599.0;
  const LeaveOutGroups groups = no_records();
  std::vector<Parameter> parameters;
  for (int d = 0; d < dimensions; ++d)
    parameters.push_back({.name = "x" + std::to_string(d), .design = 1, .idle = d >= used});
  double mean[used] = {}, own[used] = {}, together = 0, error = 0;
  int held = 0;
  for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
    ShareTally tally(parameters, {ln_demand}, groups, true);
    const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> points(gsl_qrng_alloc(gsl_qrng_sobol, dimensions),
                                                                     gsl_qrng_free);
    for (std::uint64_t i = 0; i < samples; ++i) {
      int of_class[dimensions];
      double u[dimensions];
      gsl_qrng_get(points.get(), u);
      for (std::uint64_t d = 0; d < dimensions; ++d) {
        u[d] = std::fmod(u[d] + uniform(repeat, d, "shift"), 1.0);
        of_class[d] = class_of(u[d]);
      }
      const double y = 2 * u[0] + u[1];
      tally.add(static_cast<int>(uniform(repeat, i, "group") * 64), of_class, {&y, 1});
    }
    const ShareRow row = tally.row(0, 0.95);
    ASSERT_EQ(row.share.size(), std::size_t{used});
    for (std::size_t p = 0; p < used; ++p) {
      mean[p] += row.share[p].value / repeats;
      own[p] += row.share[p].se / repeats;
    }
    together += row.together.value / repeats;
    held += row.together.lower <= 1 && row.together.upper >= 1 - 1.0 / (64 * 64);  // which the classes lose
    error += row.together.se / repeats;
  }
  RecordProperty("held", held);
  RecordProperty("together", std::to_string(together));
  EXPECT_NEAR(mean[0], 0.8, 0.004);
  EXPECT_NEAR(mean[1], 0.2, 0.004);
  for (int p = 2; p < used; ++p) EXPECT_NEAR(mean[p], 0, own[p]) << p;
  EXPECT_NEAR(together, 1, 0.005);
  EXPECT_LT(error, by_independent_draws);
  EXPECT_GE(held, 35);
}

// y = x0 with x0 normal: few draws far out make much of the variance, which few classes lose. All of it is x0's; x1 has none.
TEST(Shares, IntervalsHoldWhatFewClassesLoseAndTheEstimateItself) {
  constexpr int dimensions = 12, used = 2;
  const LeaveOutGroups groups = no_records();
  for (const int samples : {512, 1000, 2048}) {
    int held = 0, least_held = 0;
    constexpr int repeats = 20;
    for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
      std::vector<Parameter> parameters;
      for (int d = 0; d < dimensions; ++d)
        parameters.push_back({.name = "x" + std::to_string(d), .design = 1, .idle = d >= used});
      ShareTally tally(parameters, {ln_demand}, groups, true);
      const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> points(gsl_qrng_alloc(gsl_qrng_sobol, dimensions),
                                                                       gsl_qrng_free);
      for (int i = 0; i < samples; ++i) {
        int of_class[dimensions];
        double u[dimensions];
        gsl_qrng_get(points.get(), u);
        for (std::uint64_t d = 0; d < dimensions; ++d) {
          u[d] = std::fmod(u[d] + uniform(repeat, d, "shift"), 1.0);
          of_class[d] = class_of(u[d]);
        }
        const double y = gsl_cdf_ugaussian_Pinv(std::clamp(u[0], 1e-9, 1 - 1e-9));
        tally.add(static_cast<int>(uniform(repeat, static_cast<std::uint64_t>(i), "group") * 64), of_class, {&y, 1});
      }
      const ShareRow row = tally.row(0, 0.95);
      for (const Estimate& share : row.share) {
        EXPECT_LE(share.lower, share.value) << samples;
        EXPECT_GE(share.upper, share.value) << samples;
      }
      held += row.share[0].upper >= 1;
      least_held += row.share[1].lower <= 0;
    }
    EXPECT_GE(held, 18) << samples;
    EXPECT_GE(least_held, 18) << samples;
  }
}

// All that scatters is x's, and half of the samples, those below 0.47, say nothing: straight lines and a step, of few samples and of many.
TEST(Shares, OfTheOnlyParameterIsAll) {
  for (const int samples : {300, 600, 1000, 4000}) {
    int held[2] = {};
    double mean[2] = {};
    constexpr int repeats = 40;
    for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
      ShareTally tally({{"x"}}, {ln_demand, {.edp = "y", .capacity = 1, .yes_or_no = true}}, no_records());
      for (int i = 0; i < samples; ++i) {
        const double x = uniform(50 + repeat, static_cast<std::uint64_t>(i), "x");
        const double answers[] = {x > 0.47 ? std::log(x - 0.46) : nan, x > 0.71 ? 1.0 : 0.0};
        const int of_class[] = {class_of(x)};
        tally.add(static_cast<int>(uniform(repeat, static_cast<std::uint64_t>(i), "group") * 64), of_class, answers);
      }
      for (std::size_t k = 0; k < 2; ++k) {
        const Estimate share = tally.row(k, 0.95).share[0];
        EXPECT_LE(share.value, 1) << samples;
        mean[k] += share.value / repeats;
        held[k] += share.upper >= 0.999;
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(mean[k], 1, samples == 300 ? 0.035 : 0.02) << samples << " " << k;
      EXPECT_GE(held[k], 30) << samples << " " << k;
    }
  }
}

TEST(Shares, OfAProbability) {
  // Y = 1 where x + z > 1: P(Y | x) = x, so that the share of x is (1/12)/(1/4) = 1/3; 1/64^2 of it is lost in the classes.
  const LeaveOutGroups groups = no_records();
  ShareTally tally({{"x"}, {"z"}}, {{.edp = "y", .capacity = 1, .yes_or_no = true}}, groups);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double x = uniform(1, i, "x"), z = uniform(1, i, "z"), y = x + z > 1;
    const int of_class[] = {class_of(x), class_of(z)};
    tally.add(static_cast<int>(i % 64), of_class, {&y, 1});
  }
  const ShareRow row = tally.row(0, 0.95);
  EXPECT_NEAR(row.share[0].value, 1 / 3.0, 4 * row.share[0].se);
  EXPECT_LT(row.share[0].se, 0.01);
  EXPECT_NEAR(row.mean, 0.5, 0.02);
}

TEST(Shares, NothingIsSaidOfWhatDoesNotVary) {
  ShareTally tally({{"x"}}, {{.edp = "overturned", .capacity = nan, .yes_or_no = true}, ln_demand}, no_records());
  for (int i = 0; i < 1000; ++i) {
    const int of_class[] = {i % 32};
    const double value[] = {0, nan};
    tally.add(i % 64, of_class, value);
  }
  EXPECT_TRUE(std::isnan(tally.row(0, 0.95).share[0].value));
  EXPECT_TRUE(std::isnan(tally.row(1, 0.95).share[0].value));
  EXPECT_EQ(tally.row(1, 0.95).samples, 0);
}

TEST(Shares, TheOrderOfSamplesAndTheirSplitDoNotMatter) {
  const std::vector<Parameter> parameters = {{"x"}};
  ShareTally forward(parameters, {ln_demand}, no_records()), first = forward, second = forward;
  for (std::uint64_t i = 0; i < 500; ++i) {
    for (auto* one : {&forward, i % 3 ? &first : &second}) {
      const double x = uniform(1, i, "x"), y = x + uniform(1, i, "e");
      const int of_class[] = {class_of(x)};
      one->add(static_cast<int>(i % 64), of_class, {&y, 1});
    }
  }
  for (std::size_t i = 0; i < first.words().size(); ++i) first.words()[i] += second.words()[i];
  EXPECT_EQ(first.words(), forward.words());
}

TEST(TotalShares, OfTheMotionItselfWithItsError) {
  Recorded model;
  model.records = 30;
  const double truth =
      (model.slope_scatter * model.slope_scatter / 3 + model.between * model.between) / model.variance();
  const LeaveOutGroups groups = groups_of(model.records);
  int held = 0;
  constexpr int repeats = 400, pairs = 1500;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto seed = static_cast<std::uint64_t>(repeat + 1);
    TotalTally totals(1, {ln_demand}, groups);
    for (int i = 0; i < pairs; ++i) {
      const auto at = static_cast<std::uint64_t>(i);
      const int a = class_of(uniform(seed, at, "a"), model.records),
                b = class_of(uniform(seed, at, "b2"), model.records);
      const double x = uniform(seed, at, "x"), y = model.y(seed, a, x, at), z = model.y(seed, b, x, at);
      totals.add(0, a, b, {&y, 1}, {&z, 1});
    }
    const Estimate found = totals.share(0, 0, 0.90).share;
    held += found.lower <= truth && truth <= found.upper;
  }
  EXPECT_NEAR(held / static_cast<double>(repeats), 0.90, 0.05);
}

}  // namespace
}  // namespace freestand::decision::shares_test
