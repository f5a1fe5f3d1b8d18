#include "study/intensities.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/units.hpp"
#include "motion/spectrum.hpp"
#include "study/evaluator.hpp"
#include "study/fragility_changes.hpp"
#include "study/known.hpp"
#include "study/study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double g = standard_gravity_mps2;

// Two records and two pulses, over blocks and frictions that differ.
class SweptIntensities : public testing::Test {
 protected:
  SweptIntensities() {
    for (const double beat : {3.0, 7.0}) {
      std::ofstream file(scratch / fmt::format("r{}.csv", beat));
      file << "time_s,floor_acceleration_mps2\n";
      for (int i = 0; i <= 500; ++i)
        file << 0.01 * i << "," << 3 * std::sin(beat * 0.01 * i * (1 + 0.002 * i)) * std::exp(-0.004 * i) << "\n";
    }
    study = parse_study(text("report"), scratch / "study.yaml", registries());
    motions = load_motions(study);
    summaries = summarize_together({}, study, motions, nullptr);
  }

  static std::string text(const std::string& im) {
    return "samples: 64\nblock: {width_m: {uniform: [0.4, 0.7]}, height_m: 1.8, mass_kg: 100}\nmodel: slide\n"
           "friction: {mu_k: {uniform: [0.1, 0.3]}}\nmotions:\n"
           "  - {pulse: [A, C1], period_s: {uniform: [0.4, 1.2]}, peak_acceleration_g: {uniform: [-1, 1]}}\n"
           "  - {records: \"*.csv\", scale_to: {pta_g: {uniform: [0.2, 1]}}}\n"
           "fragility: {im: " +
           im + ", edp: [peak_slip_m]}\n";
  }

  const freestand::test::Scratch scratch{"intensities"};
  Study study;
  MotionSet motions;
  MotionSummaries summaries;
};

// Every measure, from the row and what is kept, beside a calculation from the sample itself: the floor's motion, scaled and
// stretched, and the block.
TEST_F(SweptIntensities, FollowFromTheRowAsFromTheMotionItself) {
  const Evaluator evaluator(study, motions, summaries);
  const Realiser realise(study, motions);
  Table rows{evaluator.columns(), {}};
  evaluator.append(0, 64, rows.values);
  const auto values = [&](const IntensityPart& part) { return SampleIntensity(part, summaries)(rows); };
  const auto pga = values({"pga_g"}), pgv = values({"pgv_mps"}), pgd = values({"pgd_m"}), report = values({"report"}),
             sa = values({"sa_g", "period_s", 0.5}), housner = values({"housner_m"}),
             over_tan = values({"pga_over_g_tan_alpha"});
  for (std::uint64_t i = 0; i < 64; ++i) {
    const Realisation sample = realise(i);
    const Shaking& shaking = sample.shaking;
    const double scale = std::abs(shaking.scale), s = shaking.stretch;
    const motion::MotionPeaks peaks = motion::peaks(*shaking.motion);
    const auto near = [](double found, double expected, double tolerance) {
      EXPECT_NEAR(found, expected, tolerance * std::abs(expected));
    };
    near(pga[i], scale * peaks.pga_mps2 / g, 1e-12);
    near(pgv[i], scale * s * peaks.pgv_mps, 1e-12);
    near(pgd[i], scale * s * s * peaks.pgd_m, 1e-12);
    near(report[i], sample.pta_g / sample.specimen.friction.mu_k - 1, 1e-9);
    near(over_tan[i], sample.pta_g / std::tan(sample.specimen.block.alpha_rad()), 1e-12);
    EXPECT_EQ(sa[i], scale * motion::spectral_acceleration_mps2(*shaking.motion, 0.5 / s) / g);  // to the bit
    const double spectrum = motion::housner_intensity_m(
        [&](double T) { return scale * motion::spectral_acceleration_mps2(*shaking.motion, T / s); });
    near(housner[i], spectrum, 1e-4);  // of pulses from a table; its error: tests/motion/spectrum_test.cpp
  }
}

TEST_F(SweptIntensities, WhatIsKeptComesBackFromTheFileToTheBit) {
  const MotionSummaries back = motion_summaries(motion_rows(motions, summaries));
  ASSERT_EQ(back.size(), summaries.size());
  const Evaluator evaluator(study, motions, summaries);
  Table rows{evaluator.columns(), {}};
  evaluator.append(0, 64, rows.values);
  for (const intensity::Measure* measure : intensity::all()) {
    const IntensityPart part{measure->name};
    EXPECT_EQ(SampleIntensity(part, back)(rows), SampleIntensity(part, summaries)(rows)) << measure->name;
  }
}

TEST_F(SweptIntensities, ThePeriodOfTheStudyIsKeptAndOthersMustLieWithin) {
  const Study odd = parse_study(text("{name: sa_g, period_s: 0.4567}"), scratch / "s.yaml", registries());
  const MotionSummaries kept = summarize_together({}, odd, motions, nullptr);
  for (const motion::MotionSummary& summary : kept) EXPECT_TRUE(summary.is_pulse || summary.spectrum.holds(0.4567));
  EXPECT_THAT(freestand::test::error_text(Exit::usage,
                                          [&] {
                                            SampleIntensity({"sa_g", "period_s", 20}, summaries);
                                          }),
              HasSubstr("kept from 0.02 to 10 s"));
}

TEST_F(SweptIntensities, StandInAColumnOfTheirOwn) {
  const Evaluator evaluator(study, motions, summaries);
  Table rows{evaluator.columns(), {}};
  evaluator.append(0, 3, rows.values);
  const Table wider = SampleIntensity({"pga_g"}, summaries).beside(rows);
  ASSERT_EQ(wider.rows(), 3u);
  EXPECT_EQ(wider.columns.back().name, "im_pga_g");
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t c = 0; c < rows.columns.size(); ++c)
      EXPECT_TRUE(std::isnan(rows.at(row, c)) || wider.at(row, c) == rows.at(row, c));
    EXPECT_NEAR(wider.at(row, wider.columns.size() - 1), rows.at(row, column_index(rows.columns, "pta_g")), 1e-12);
  }
}

class Changes : public testing::Test {
 protected:
  const Study study = parse_study(test::block + test::friction + test::motions +
                                      "samples: 100\nfragility: {edp: [delta, overturned], bins: {edges: [0, 1, 2]}, "
                                      "capacities: {delta: [1, 2]}}\n",
                                  "some.yaml", registries());

  std::string refused(const FragilityChanges& changes) const {
    return freestand::test::error_text(Exit::usage, [&] { with_changes(study, changes); });
  }
};

TEST_F(Changes, AreWrittenAsOnTheCommandLine) {
  const FragilityPart part =
      with_changes(study, {"sa_g:0.5", "", {"peak_slip_m", "delta"}, {"peak_slip_m=0.1,0.2"}}).fragility;
  EXPECT_EQ(part.im.name, "sa_g");
  EXPECT_EQ(part.im.period_s, 0.5);
  EXPECT_EQ(described(part.im), "sa_g at 0.5 s");
  EXPECT_EQ(part.bins.count, 12);  // edges of another intensity give way
  EXPECT_THAT(part.edp, ElementsAre("peak_slip_m", "delta"));
  EXPECT_THAT(part.capacities[0].values, ElementsAre(0.1, 0.2));
  EXPECT_THAT(part.capacities[1].values, ElementsAre(1, 2));  // as they were
  const FragilityPart as_a_study =
      with_changes(study, {.edp = {"peak_slip_m", "delta"}, .capacities = {"{peak_slip_m: [0.3], delta: [3, 4]}"}})
          .fragility;
  EXPECT_THAT(as_a_study.capacities[0].values, ElementsAre(0.3));
  EXPECT_THAT(as_a_study.capacities[1].values, ElementsAre(3, 4));
  EXPECT_THAT(with_changes(study, {.edp = {"overturned"}}).fragility.bins.edges, ElementsAre(0, 1, 2));
  EXPECT_EQ(with_changes(study, {.bins = "7"}).fragility.bins.count, 7);
  EXPECT_THAT(with_changes(study, {.bins = "0.1,0.5"}).fragility.bins.edges, ElementsAre(0.1, 0.5));
  EXPECT_EQ(with_changes(study, {.bins = "{count: 5, spacing: log}"}).fragility.bins.spacing, Spacing::log);
  EXPECT_EQ(expanded(with_changes(study, {})), expanded(study));
}

TEST_F(Changes, MistakesAreToldAsInAStudy) {
  EXPECT_THAT(refused({.im = "pgx"}), HasSubstr("command line: intensity measure pgx is not known"));
  EXPECT_THAT(refused({.im = "pga_g:0.5"}), HasSubstr("only sa_g takes one"));
  EXPECT_THAT(refused({.im = "sa_g:soon"}), HasSubstr("soon"));
  EXPECT_THAT(refused({.bins = "1,0.5"}), HasSubstr("does not increase"));
  EXPECT_THAT(refused({.bins = "{count: 5"}), HasSubstr("--bins {count: 5 cannot be read"));
  EXPECT_THAT(refused({.edp = {"slip"}}), HasSubstr("demand parameter slip is not known"));
  EXPECT_THAT(refused({.edp = {"wall_hit"}}), HasSubstr("command line: fragility.edp: wall_hit would be 0"));
  EXPECT_THAT(refused({.capacities = {"0.1,0.2"}}), HasSubstr("names no demand"));
  EXPECT_THAT(refused({.capacities = {"{delta: [1"}}), HasSubstr("cannot be read"));
  EXPECT_THAT(refused({.capacities = {"peak_slip_m=0.1"}}), HasSubstr("peak_slip_m"));
}

}  // namespace
}  // namespace freestand::study
