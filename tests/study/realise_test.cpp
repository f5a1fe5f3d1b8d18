#include "study/realise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <tuple>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "study/doubts.hpp"
#include "study/known.hpp"
#include "study/motion_bytes.hpp"
#include "study_text.hpp"
#include "support/data.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::realise_test {
namespace {

using namespace test;

Realiser realiser(const std::string& text) {
  const Study study = parse(text);
  return Realiser(study, load_motions(study));
}

double draw(const Realiser& realise, std::uint64_t sample, const std::string& column) {
  return realise(sample).draws.at(column_index(realise.draw_columns(), column));
}

// A folder of the test with two records of peak 2 and 4 m/s2; the second has a vertical channel.
class Records : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "records");
    std::ofstream(folder_ / "records" / "a.csv") << "time_s,floor_acceleration_mps2\n0,0\n0.1,-2\n0.2,1\n";
    std::ofstream(folder_ / "records" / "b.csv")
        << "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n0,0,1\n0.1,4,3\n0.2,0,0\n";
  }
  Study study(const std::string& motion, const std::string& more = "") const {
    return parse_study(block + friction + samples + fragility + "motions: [" + motion + "]\n" + more,
                       folder_ / "s.yaml", known());
  }
  freestand::test::Scratch folder_{"realise_records"};
};

TEST(Realiser, FixedNumbersGiveTheSpecimenOfTheStudy) {
  const Realiser realise =
      realiser(block + "friction: {mu_k: 0.2, static_ratio: 1.5}\nmodel: slide\nimpact: {factor: 0.9}\n" + samples +
               fragility + "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}]\n");
  const Realisation r = realise(17);
  EXPECT_DOUBLE_EQ(r.specimen.block.base_m(), 0.6);
  EXPECT_DOUBLE_EQ(r.specimen.block.height_m, 0.9);
  EXPECT_EQ(r.specimen.block.mass_kg, 150);
  EXPECT_DOUBLE_EQ(r.specimen.friction.mu_s, 0.3);
  EXPECT_EQ(r.specimen.friction.mu_k, 0.2);
  EXPECT_EQ(r.specimen.impact.factor, 0.9);
  EXPECT_EQ(r.specimen.model, Model::slide);
  EXPECT_EQ(r.shaking.motion->name, "B");
  EXPECT_EQ(r.shaking.stretch, 0.5);
  EXPECT_DOUBLE_EQ(r.shaking.scale, 0.6 * standard_gravity_mps2);
  EXPECT_DOUBLE_EQ(r.pta_g, 0.6);
  EXPECT_EQ(r.pulse_period_s, 0.5);
  EXPECT_EQ(r.shaking.vertical_scale, 0);
}

TEST(Realiser, SlendernessAndSizeAreTheSameBlockAsItsSides) {
  const Realiser realise =
      realiser("block: {slenderness_rad: 0.3, size_m: 1.1}\n" + friction + motions + samples + fragility);
  const Block block = realise(0).specimen.block;
  EXPECT_DOUBLE_EQ(block.alpha_rad(), 0.3);
  EXPECT_DOUBLE_EQ(block.size_m(), 1.1);
  EXPECT_DOUBLE_EQ(block.p_radps(), std::sqrt(0.75 * standard_gravity_mps2 / 1.1));
  EXPECT_DOUBLE_EQ(draw(realise, 0, "block_width_m"), 2.2 * std::sin(0.3));
  EXPECT_DOUBLE_EQ(draw(realise, 0, "block_alpha_rad"), 0.3);
  EXPECT_DOUBLE_EQ(draw(realise, 0, "block_slenderness_rad"), 0.3);
}

TEST(Realiser, ColumnsHaveEveryQuantityAndWhatFollowsFromItOnce) {
  const Realiser realise = realiser(block + friction + motions + samples + fragility);
  std::vector<std::string> names;
  for (const auto& column : realise.draw_columns()) names.push_back(column.name);
  EXPECT_THAT(names,
              testing::ElementsAre("block_width_m", "block_height_m", "block_mass_kg", "friction_mu", "impact_factor",
                                   "block_alpha_rad", "block_size_m", "block_p_radps", "friction_mu_k", "friction_mu_s",
                                   "motion", "scale", "pta_g", "pulse_period_s"));
  EXPECT_EQ(realise(3).draws.size(), names.size());
  EXPECT_EQ(realise.draw_columns()[0].unit, "m");
  EXPECT_EQ(draw(realise, 3, "pta_g"), realise(3).pta_g);
  EXPECT_EQ(Realiser::column_of("friction.mu_k"), "friction_mu_k");
  EXPECT_EQ(Realiser::column_of("motion.period_s"), "pulse_period_s");
}

TEST(Realiser, StaticFrictionIsWrittenAsEffectsMakeIt) {
  const std::string rest = motions + samples + fragility;
  const Realiser realise =
      realiser(block + "friction: {mu: 0.2}\neffects: [{name: static_friction, ratio: 1.5}]\n" + rest);
  EXPECT_DOUBLE_EQ(draw(realise, 0, "friction_mu_s"), 1.5 * 0.2);
  EXPECT_DOUBLE_EQ(draw(realise, 0, "friction_mu_k"), 0.2);
}

// An effect, another distribution or a second source of motions changes no draw of the other numbers.
TEST(Realiser, OneMoreParameterChangesNoEarlierDraw) {
  const std::string mu = "friction: {mu_k: {lognormal: {median: 0.2, dispersion: 0.3}}";
  for (const char* design : {"sobol", "monte_carlo", "latin_hypercube"}) {
    const std::string rest = motions + samples + fragility + "design: " + design + "\n";
    const Realiser few = realiser(block + mu + "}\n" + rest);
    const Realiser more =
        realiser("block: {width_m: {uniform: [0.5, 0.7]}, height_m: 1.8, mass_kg: {uniform: [1, 2]}}\n" + mu +
                 ", static_ratio: {uniform: [1, 1.5]}}\nimpact: {factor: {uniform: [0.8, 1]}}\n" + rest);
    for (std::uint64_t i = 0; i < 50; ++i) {
      EXPECT_EQ(few(i).specimen.friction.mu_k, more(i).specimen.friction.mu_k);
      EXPECT_EQ(few(i).pta_g, more(i).pta_g);
    }
  }
}

TEST(Realiser, IsAPureFunctionOfTheSampleIndex) {
  const std::string text =
      "block: {width_m: {uniform: [0.5, 0.7]}, height_m: 1.8}\n" + friction + motions + samples + fragility;
  const Realiser one = realiser(text), other = realiser(text);
  std::vector<double> forward, backward;
  for (std::uint64_t i = 0; i < 20; ++i) forward.push_back(one(i).specimen.block.base_m());
  for (std::uint64_t i = 20; i-- > 0;) backward.push_back(other(i).specimen.block.base_m());
  EXPECT_TRUE(std::equal(forward.begin(), forward.end(), backward.rbegin()));
}

TEST(Realiser, PulsesAndSourcesComeWithTheirWeights) {
  const Realiser realise =
      realiser(block + friction + fragility +
               "samples: 4096\nmotions:\n"
               "  - {pulse: {choice: [A, B], weights: [1, 3]}, period_s: 1, peak_acceleration_g: 0.3, weight: 3}\n"
               "  - {pulse: [B, C1], period_s: {uniform: [1, 2]}, peak_acceleration_g: -0.5}\n");
  EXPECT_THAT(realise.motions().names(), testing::ElementsAre("A", "B", "C1"));
  std::map<std::string, int> counts;
  for (std::uint64_t i = 0; i < 4096; ++i) {
    const Realisation r = realise(i);
    ++counts[r.shaking.motion->name + (r.shaking.scale < 0 ? " mirrored" : "")];
    EXPECT_EQ(&realise.motions().motion(r.motion), r.shaking.motion);
  }
  EXPECT_NEAR(counts["A"], 4096 * 3 / 16, 8);
  EXPECT_NEAR(counts["B"], 4096 * 9 / 16, 8);
  EXPECT_NEAR(counts["B mirrored"], 512, 8);
  EXPECT_NEAR(counts["C1 mirrored"], 512, 8);
  EXPECT_EQ(counts.size(), 4U);
}

TEST(Realiser, PlainScaleOfAPulseMultipliesItsAmplitude) {
  const Realiser realise = realiser(block + friction + samples + fragility +
                                    "motions: [{pulse: A, period_s: 1, peak_acceleration_g: 0.5, scale: -1.2}]\n");
  EXPECT_DOUBLE_EQ(realise(0).shaking.scale, -0.6 * standard_gravity_mps2);
  EXPECT_DOUBLE_EQ(realise(0).pta_g, 0.6);
}

// The peak velocity of the floor, from the exact integral of the scaled motion, is the one that the study asks for.
TEST(Realiser, PeakVelocityIsThatOfTheFloor) {
  for (const char* pulse : {"A", "B", "C1", "ricker"}) {
    const Realiser realise = realiser(block + friction + samples + fragility + "motions: [{pulse: " + pulse +
                                      ", period_s: 0.8, peak_velocity_mps: 0.7}]\n");
    const Realisation r = realise(0);
    const auto peaks = motion::scaled(motion::peaks(*r.shaking.motion), r.shaking.scale, r.shaking.stretch);
    EXPECT_NEAR(peaks.pgv_mps, 0.7, 1e-9) << pulse;
    EXPECT_NEAR(peaks.pga_mps2, r.pta_g * standard_gravity_mps2, 1e-9) << pulse;
  }
}

TEST_F(Records, AreScaledToTheirPeakOrByAFactor) {
  const Study to_peak = study("{records: \"records/*.csv\", scale_to: {pta_g: 0.5}}");
  const Realiser realise(to_peak, load_motions(to_peak));
  EXPECT_THAT(realise.motions().names(), testing::ElementsAre("records/a.csv", "records/b.csv"));
  std::map<std::string, double> scales;
  for (std::uint64_t i = 0; i < 16; ++i) {
    const Realisation r = realise(i);
    scales[r.shaking.motion->name] = r.shaking.scale;
    EXPECT_DOUBLE_EQ(r.pta_g, 0.5);
    EXPECT_TRUE(std::isnan(r.pulse_period_s));
    EXPECT_EQ(r.shaking.stretch, 1);
  }
  EXPECT_DOUBLE_EQ(scales["records/a.csv"], 0.5 * standard_gravity_mps2 / 2);
  EXPECT_DOUBLE_EQ(scales["records/b.csv"], 0.5 * standard_gravity_mps2 / 4);

  const Study factor =
      study("{records: records/b.csv, scale: -1.5}", "effects: [{name: vertical_shaking, scale: 0.5}]\n");
  const Realisation r = Realiser(factor, load_motions(factor))(0);
  EXPECT_EQ(r.shaking.scale, -1.5);
  EXPECT_EQ(r.specimen.effects.at(0).parameters, std::vector{0.5});
  EXPECT_DOUBLE_EQ(r.pta_g, 6 / standard_gravity_mps2);
}

TEST_F(Records, EveryUnusableOneIsReported) {
  std::ofstream(folder_ / "records" / "c.csv") << "time_s,floor_acceleration_mps2\n0,0\n0.1,oops\n";
  std::ofstream(folder_ / "records" / "d.csv") << "time_s,floor_acceleration_mps2\n0,0\n0.1,0\n";
  try {
    load_motions(study("{records: \"records/*.csv\", scale_to: {pta_g: 0.5}}"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::data);
    EXPECT_THAT(error.what(), testing::HasSubstr("c.csv:3"));
    EXPECT_THAT(error.what(), testing::HasSubstr("d.csv: its horizontal acceleration is zero throughout"));
  }
}

TEST_F(Records, ATableSaysWhatBelongsTogetherAndBringsItsNumbers) {
  std::ofstream(folder_ / "records" / "c.csv") << "0\n1\n0.5\n";
  std::ofstream(folder_ / "records" / "INDEX.csv") << "file,dt_s,unit,group,pga_g,magnitude_mw\n"
                                                      "c.csv,0.02,g,loma,0.3,6.9\nb.csv,,,loma,,6.9\na.csv,,,,0.1,\n";
  std::ofstream(folder_ / "records" / "two.csv") << "file,distance_km\nb.csv,12\n";
  const MotionSet motions = load_motions(study(
      "{records: records/INDEX.csv}, {records: records/two.csv}, {pulse: A, period_s: 1, peak_acceleration_g: 1}, "
      "{records: records/a.csv, group: northridge}"));
  EXPECT_THAT(motions.names(), testing::ElementsAre("records/c.csv", "records/b.csv", "records/a.csv", "records/b.csv",
                                                    "A", "records/a.csv"));
  // A record that stands in a group is in it wherever it stands.
  EXPECT_THAT(motions.groups(), testing::ElementsAre(0, 0, 2, 0, -1, 2));
  EXPECT_DOUBLE_EQ((*motions.entries)[0].peak_mps2, standard_gravity_mps2);
  EXPECT_DOUBLE_EQ(motions.motion(0).knot_s.at(1), 0.02);
  ASSERT_EQ(motions.numbers.size(), 3U);
  EXPECT_EQ(motions.numbers[2].name, "distance_km");
  const double nan = std::nan("");
  const auto numbers = [&](std::size_t i) { return (*motions.entries)[i].numbers; };
  EXPECT_THAT(numbers(0), testing::Pointwise(testing::NanSensitiveDoubleEq(), {0.3, 6.9, nan}));
  EXPECT_THAT(numbers(3), testing::Pointwise(testing::NanSensitiveDoubleEq(), {nan, nan, 12.0}));
  EXPECT_THAT(numbers(4), testing::Pointwise(testing::NanSensitiveDoubleEq(), {nan, nan, nan}));
}

// Two names of one record, or a copy of it, are no more motions than one.
TEST_F(Records, ACopyIsNoMotionOfItsOwn) {
  std::filesystem::copy_file(folder_ / "records" / "a.csv", folder_ / "copy.csv");
  const MotionSet motions =
      load_motions(study("{records: records/a.csv}, {records: records/b.csv}, {records: copy.csv}, {records: \"" +
                         (folder_ / "records" / ".." / "records" / "b.csv").string() + "\"}"));
  EXPECT_THAT(motions.groups(), testing::ElementsAre(0, 1, 0, 1));
}

// What one rank has read and another takes over: the same motions and samples, to the bit, with all that stands beside them.
TEST_F(Records, TravelAsBytes) {
  std::ofstream(folder_ / "records" / "INDEX.csv")
      << "file,group,pga_g,magnitude_mw,pulse_type,pulse_period_s,weight\na.csv,loma,0.3,6.9,B,1.5,2\nb.csv,,,,,,1\n";
  const Study swept = study(
      "{records: records/INDEX.csv, scale: 2}, {pulse: [A, B], period_s: 1, peak_acceleration_g: 1}, "
      "{records: records/a.csv, cross_records: records/b.csv, scale: 1}",
      "model: slide\n");
  MotionSet read = load_motions(swept);
  std::vector<MotionSet::Entry> entries = *read.entries;
  entries.back().ground = 1;
  entries.back().storey = 2;
  read.entries = std::make_shared<const std::vector<MotionSet::Entry>>(std::move(entries));
  const MotionBytes bytes = bytes_of(read);
  const std::shared_ptr<std::byte> rows(static_cast<std::byte*>(::operator new(bytes.row_bytes, std::align_val_t(64))),
                                        [](std::byte* p) { ::operator delete(p, std::align_val_t(64)); });
  bytes.write_rows(rows.get());
  const MotionSet taken = motions_of(bytes.words, rows);
  EXPECT_EQ(taken.fingerprint(), read.fingerprint());
  EXPECT_EQ(taken.names(), read.names());
  EXPECT_EQ(taken.groups(), read.groups());
  EXPECT_EQ(taken.of_source, read.of_source);
  ASSERT_EQ(taken.numbers.size(), read.numbers.size());
  EXPECT_EQ(taken.numbers[0].name, read.numbers[0].name);
  EXPECT_EQ(taken.numbers[0].power, read.numbers[0].power);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const MotionSet::Entry &a = (*read.entries)[i], &b = (*taken.entries)[i];
    EXPECT_EQ(a.motion.cross_mps2, b.motion.cross_mps2) << i;
    EXPECT_EQ(a.motion.horizontal_run_mps2, b.motion.horizontal_run_mps2) << i;
    EXPECT_EQ(a.motion.table == nullptr, b.motion.table == nullptr) << i;
    EXPECT_EQ(std::tie(a.pulse, a.peak_mps2, a.peak_mps, a.group, a.ground, a.storey, a.known_pulse, a.weight),
              std::tie(b.pulse, b.peak_mps2, b.peak_mps, b.group, b.ground, b.storey, b.known_pulse, b.weight));
    EXPECT_THAT(b.numbers, testing::Pointwise(testing::NanSensitiveDoubleEq(), a.numbers));
  }
}

TEST_F(Records, WhatATableSaysOtherwiseThanTheFileIsRefusedWithItsRow) {
  std::ofstream(folder_ / "records" / "INDEX.csv") << "file,dt_s,unit\nb.csv,0.1,\na.csv,0.05,\nb.csv,0.1,g\n";
  const Study swept = study("{records: records/INDEX.csv}");
  const std::string found = freestand::test::error_text(Exit::data, [&] { load_motions(swept); });
  EXPECT_THAT(found, testing::HasSubstr("INDEX.csv:3: " + (folder_ / "records" / "a.csv").string() +
                                        ": dt_s 0.05 contradicts the file (it says 0.1)"));
  EXPECT_THAT(found, testing::HasSubstr("INDEX.csv:4: "));
  EXPECT_THAT(found, testing::HasSubstr("unit g contradicts the file"));
  std::ofstream(folder_ / "records" / "INDEX.csv") << "file,event\ngone.csv,loma\n";
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { study("{records: records/INDEX.csv}"); }),
              testing::HasSubstr("motions[0].records: " + (folder_ / "records" / "INDEX.csv").string() +
                                 ":2: file gone.csv is not there"));
  std::ofstream(folder_ / "records" / "INDEX.csv") << "file,event\na.csv,loma\nb.csv,loma\n";
  EXPECT_THAT(doubts(study("{records: records/INDEX.csv}")),
              testing::ElementsAre(testing::HasSubstr("is group: event meant?")));
  EXPECT_THAT(load_motions(study("{records: records/INDEX.csv, group: event}")).groups(), testing::ElementsAre(0, 0));
  EXPECT_THAT(expanded(study("{records: records/INDEX.csv, group: event}")), testing::HasSubstr("group: event"));
}

// The guests' own table: suites in folders, events by name, vertical components in rows of their own.
TEST(RealRecords, TheTableOfThemIsRead) {
  FREESTAND_NEEDS_RECORDS();
  const std::string text =
      block + friction + samples + fragility + "motions: [{records: INDEX.csv, group: event, unit: g, dt_s: 0.01}]\n";
  const auto read = [&](const std::string& more) {
    return parse_study(text + more, freestand::test::records_dir() / "s.yaml", known()).motions.at(0);
  };
  const MotionSource source = read("");
  EXPECT_GT(source.files.size(), 200U);
  EXPECT_THAT(source.left_out, testing::Contains(testing::HasSubstr("TLM1_UD.acc (its component is UD)")));
  const auto paired = [](const MotionSource& from) {
    return std::count_if(from.files.begin(), from.files.end(), [](const auto& row) { return !row.vertical.empty(); });
  };
  EXPECT_EQ(paired(source), 0);
  EXPECT_GT(paired(read("effects: [{name: vertical_shaking}]\n")), 50);
}

TEST_F(Records, VerticalOnesAreLeftOutOfAPatternAndRefusedByName) {
  std::ofstream(folder_ / "records" / "c-UP.txt") << "0 0\n0.1 1\n0.2 -1\n";
  std::ofstream(folder_ / "records" / "c-NS.txt") << "0 0\n0.1 1\n0.2 -1\n";
  const Study swept = study("{records: \"records/c*\", unit: g}");
  EXPECT_EQ(load_motions(swept).names(), std::vector<std::string>{"records/c-NS.txt"});
  EXPECT_THAT(doubts(swept), testing::ElementsAre(testing::AllOf(testing::HasSubstr("c-UP.txt (its name ends in UP)"),
                                                                 testing::HasSubstr("left out"))));
  EXPECT_EQ(load_motions(study("{records: \"records/c*\", vertical_records: \"records/*UP.txt\", unit: g}")).size(),
            1u);
  try {
    study("{records: records/c-UP.txt, unit: g}");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("c-UP.txt (its name ends in UP) is a vertical component"),
                               testing::HasSubstr("vertical_records")));
  }
}

TEST_F(Records, VerticalShakingNeedsAVerticalChannel) {
  const std::string effect = "effects: [{name: vertical_shaking}]\n";
  EXPECT_THROW(load_motions(study("{records: records/a.csv}", effect)), Error);
  EXPECT_NO_THROW(load_motions(study("{records: records/b.csv}", effect)));
  const Study paired = study("{records: records/a.csv, vertical_records: records/b.csv}", effect);
  EXPECT_EQ(paired.motions.at(0).files.at(0).vertical.filename(), "b.csv");
  EXPECT_FALSE(load_motions(paired).motion(0).vertical_mps2.empty());
  EXPECT_THROW(study("{records: records/a.csv, vertical_records: \"records/*.csv\"}", effect), Error);
}

TEST_F(Records, FingerprintFollowsTheContents) {
  const Study all = study("{records: \"records/*.csv\"}");
  const std::string before = load_motions(all).fingerprint();
  EXPECT_EQ(load_motions(all).fingerprint(), before);
  std::ofstream(folder_ / "records" / "a.csv") << "time_s,floor_acceleration_mps2\n0,0\n0.1,-2\n0.2,1.0001\n";
  EXPECT_NE(load_motions(all).fingerprint(), before);
}

TEST(RealRecords, AFolderOfThemIsSwept) {
  FREESTAND_NEEDS_RECORDS();
  const auto folder = freestand::test::records_dir() / "slammer";
  const Study study = parse_study(block + friction + samples + fragility +
                                      "motions: [{records: \"slammer/Cape_Mendocino_1992/*\", scale_to: {pta_g: 0.4}, "
                                      "unit: g, dt_s: 0.02}]\n",
                                  freestand::test::records_dir() / "s.yaml", known());
  const Realiser realise(study, load_motions(study));
  EXPECT_GT(realise.motions().size(), 2U);
  for (std::uint64_t i = 0; i < 20; ++i)
    EXPECT_NEAR(motion::peaks(*realise(i).shaking.motion).pga_mps2 * realise(i).shaking.scale,
                0.4 * standard_gravity_mps2, 1e-12);
}

TEST(Configs, QuickstartDrawsSoundSamples) {
  const auto file = freestand::test::source_dir() / "configs" / "quickstart.yaml";
  const Study study = read_study(file, registries());
  const Realiser realise(study, load_motions(study));
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Realisation r = realise(i);
    EXPECT_TRUE(r.specimen.friction.mu_s >= r.specimen.friction.mu_k && r.specimen.friction.mu_k > 0);
    EXPECT_TRUE(r.pta_g >= 0.05 && r.pta_g <= 3 && r.pulse_period_s >= 0.2 && r.pulse_period_s <= 3);
    for (const double value : r.draws) EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace freestand::study::realise_test
