// Sound study and case files: what is read, the defaults, the expanded text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/random.hpp"
#include "study/doubts.hpp"
#include "study/known.hpp"
#include "study_text.hpp"
#include "support/data.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::study_test {
namespace {

using namespace test;
using sampling::Fixed;

double fixed(const std::optional<Quantity>& quantity) { return std::get<Fixed>(quantity.value().value).value; }

TEST(Study, DefaultsAreFilledIn) {
  const Study study = parse(block + friction + motions + samples + fragility);
  EXPECT_EQ(study.name, "some");
  EXPECT_EQ(study.folder, "folder");
  EXPECT_EQ(study.seed, 1U);
  EXPECT_EQ(study.samples, 1000U);
  EXPECT_EQ(study.design, sampling::Design::sobol);
  EXPECT_EQ(study.block_size, 256U);
  EXPECT_EQ(study.model.model, Model::slide_rock);
  EXPECT_EQ(study.model.impact.law, ImpactLaw::housner);
  EXPECT_EQ(fixed(study.model.impact.factor), 1);
  EXPECT_TRUE(study.model.effects.empty());
  EXPECT_EQ(study.motions.at(0).weight, 1);
  EXPECT_EQ(study.fragility.im.name, "report");
  EXPECT_EQ(study.fragility.bins.count, 12);
  EXPECT_EQ(study.fragility.bins.spacing, Spacing::equal_count);
  EXPECT_THAT(study.fragility.edp, testing::ElementsAre("delta", "overturned"));
  ASSERT_EQ(study.fragility.capacities.size(), 1U);  // overturned is binary
  EXPECT_THAT(study.fragility.capacities[0].values, testing::ElementsAre(0.5, 1, 2));
}

TEST(Study, EverythingThatIsGivenIsRead) {
  const Study study = parse(
      "name: \"a: b\"\n"
      "seed: 18446744073709551\n"
      "until: {half_width: 0.05, at_most: 5e5}\n"
      "design: monte_carlo\n"
      "tolerance: 1e-7\n"
      "block: {slenderness_rad: {uniform: [0.2, 0.4]}, size_m: {triangular: [0.5, 1, 2]}, mass_kg: 100}\n"
      "friction: {mu_k: {lognormal: {median: 0.2, dispersion: 0.3, max: 1}}, static_ratio: {choice: [1, 1.2], weights: "
      "[1, 3]}}\n"
      "model: rock\n"
      "impact: {law: housner, factor: {normal: {mean: 0.9, standard_deviation: 0.05, min: 0, max: 1}}}\n"
      "effects: [{name: vertical_shaking, scale: {log_uniform: [0.5, 2]}}]\n"
      "motions:\n"
      "  - {pulse: {choice: [A, c2], weights: [1, 2]}, period_s: 1, peak_velocity_mps: -0.5, scale: 1.2, weight: 3}\n"
      "  - {pulse: sine, period_s: {uniform: [0.3, 2]}, peak_acceleration_g: 0.5}\n"
      "fragility: {im: {name: sa_g, period_s: 0.7}, bins: {edges: [0, 1, 4]}, edp: peak_slip_m,\n"
      "            capacities: {peak_slip_m: [0.1]}, resamples: 200, confidence: 0.9, empirical_fallback: false,\n"
      "            axes: [block.alpha_rad, {name: motion.period_s, bins: {count: 3, spacing: log}}]}\n");
  EXPECT_EQ(study.name, "a: b");
  EXPECT_EQ(study.samples, 500000U);
  EXPECT_EQ(study.until.value().half_width, 0.05);
  EXPECT_EQ(study.block_size, 256U);
  EXPECT_EQ(study.model.block.slenderness.value().unit, "rad");
  EXPECT_EQ(study.model.friction.static_ratio.value().name, "friction.static_ratio");
  EXPECT_EQ(study.model.effects.at(0).parameters.at(0).name, "effects.vertical_shaking.scale");
  ASSERT_EQ(study.motions.size(), 2U);
  EXPECT_THAT(study.motions[0].pulses.values, testing::ElementsAre("A", "C2"));
  EXPECT_THAT(study.motions[0].pulses.weights, testing::ElementsAre(1, 2));
  EXPECT_EQ(study.motions[0].amplitude.value().name, "motion.peak_velocity_mps");
  EXPECT_EQ(study.motions[0].pulse_scale, 1.2);
  EXPECT_THAT(study.motions[1].pulses.values, testing::ElementsAre("A"));  // goes by "sine" too
  EXPECT_EQ(study.fragility.im.period_s, 0.7);
  EXPECT_THAT(study.fragility.bins.edges, testing::ElementsAre(0, 1, 4));
  EXPECT_EQ(study.fragility.axes.at(1).bins.count, 3);
  EXPECT_FALSE(study.fragility.empirical_fallback);
}

TEST(Study, EdpDefaultsToAllThatHaveCapacities) {
  const Known known = {.edps = {{"delta", false, {1}}, {"overturned", true, {}}}, .intensities = {{"report", "", 0}}};
  const Study study = parse_study(block + friction + motions + samples, "x.yaml", known);
  EXPECT_THAT(study.fragility.edp, testing::ElementsAre("delta", "overturned"));
}

// The expanded text of a study reads back to a study with the same expanded text, and to the same numbers.
TEST(Study, ExpandedTextReadsBackToTheSameStudy) {
  const std::vector<std::string> texts = {
      block + friction + motions + samples + fragility,
      "name: 'yes: 1'\n" + block + friction + motions + fragility + "until: {half_width: 0.1}\nseed: 7\n",
      "block: {slenderness_rad: {uniform: [0.1, 0.30000000000000004]}, size_m: 1}\n"
      "friction: {mu_k: 0.1, mu_s: {choice: [0.1, 0.2]}}\nimpact: {law: coulomb}\n"
      "effects: [{name: vertical_shaking, scale: 0.5}]\nsamples: 7\n"
      "motions:\n  - {pulse: [A, C3], period_s: {normal: {mean: 1, standard_deviation: 0.1, min: 0.2}}, "
      "peak_velocity_mps: 1e-3}\n  - {pulse: ricker, period_s: 1, peak_acceleration_g: 0.3333333333333333, weight: 2}\n"
      "fragility: {im: {name: sa_g}, edp: [peak_slip_m, overturned], capacities: {peak_slip_m: [0.1, 0.2]},\n"
      "  bins: {width: 0.5}, axes: [block.alpha_rad, {name: motion.period_s, bins: {edges: [0, 1, 2]}}]}\n"};
  for (const auto& text : texts) {
    const Study study = parse(text);
    const std::string full = expanded(study);
    const Study again = parse(full);
    EXPECT_EQ(expanded(again), full);
    EXPECT_EQ(fingerprint(again), fingerprint(study));
    EXPECT_EQ(again.name, study.name);
    for (const char* key : {"seed: ", "design: ", "block_size: ", "tolerance: ", "resamples: ", "impact: ", "weight: "})
      EXPECT_THAT(full, testing::HasSubstr(key));
  }
}

TEST(Study, FingerprintChangesWithWhatDeterminesTheNumbersAndNotWithTheName) {
  const std::string base = block + friction + motions + fragility;
  const auto print = [&](const std::string& more) { return fingerprint(parse(base + more)); };
  EXPECT_EQ(print("samples: 10\n"), print("samples: 10\nname: other\ndesign: sobol\n"));
  EXPECT_NE(print("samples: 10\n"), print("samples: 11\n"));
  EXPECT_NE(print("samples: 10\n"), print("samples: 10\nseed: 2\n"));
  EXPECT_NE(print("samples: 10\n"), print("samples: 10\ntolerance: 1e-8\n"));
  EXPECT_EQ(print("samples: 10\n").size(), 16U);
  // The samples are the same whatever is asked of them.
  const auto asked = [&](const std::string& text) {
    return samples_fingerprint(parse(block + friction + motions + "samples: 10\nfragility: " + text));
  };
  const std::string whole = samples_fingerprint(parse(base + "samples: 10\n"));
  EXPECT_EQ(whole, asked("{edp: [delta], bins: {count: 3}, capacities: {delta: [9]}, resamples: 7}"));
  EXPECT_EQ(whole, asked("{im: pta_g, edp: [delta, overturned]}"));
}

TEST(Study, RecordsAreFoundBesideTheStudyFileAndMayBeGoneForStoredStudies) {
  const freestand::test::Scratch folder("study_records");
  std::filesystem::create_directories(folder / "records");
  for (const char* name : {"b.csv", "a.csv"})
    std::ofstream(folder / "records" / name) << "time_s,floor_acceleration_mps2\n0,0\n0.1,1\n0.2,0\n";
  const std::string text = block + friction + samples + fragility +
                           "motions: [{records: \"records/*.csv\", scale_to: {pta_g: {uniform: [0.1, 1]}}}]\n";
  const Study study = parse_study(text, folder / "s.yaml", known());
  ASSERT_EQ(study.motions.at(0).files.size(), 2U);
  EXPECT_EQ(study.motions[0].files[0].file.filename(), "a.csv");
  EXPECT_EQ(study.motions[0].amplitude.value().name, "motion.pta_g");
  std::filesystem::remove_all(folder / "records");
  EXPECT_THROW(parse_study(text, folder / "s.yaml", known()), Error);
  const Study stored = parse_study(expanded(study), folder / "s.yaml", known(), Files::ignore);
  EXPECT_EQ(expanded(stored), expanded(study));
}

// Beside the records of a folder lie notes, tables and binary files; a pattern that names files is believed.
TEST(Study, WhatIsNoRecordInAFolderIsLeftOutAndTold) {
  const freestand::test::Scratch folder("study_folder");
  std::filesystem::create_directories(folder / "records" / "more");
  const auto put = [&](const char* name, const std::string& text) { std::ofstream(folder / "records" / name) << text; };
  put("b.csv", "time_s,floor_acceleration_mps2\n0,0\n0.1,1\n0.2,0\n");
  put("a.csv", "time_s,floor_acceleration_mps2\n0,0\n0.1,1x\n0.2,0\n");  // a record with a mistake stays one
  put("README.md", "# Records\nfrom somewhere\n");
  put("stations.csv", "station,vs30_mps\nPET,713\n");
  put("map.png", std::string("\x89PNG\r\n\0\1", 8));
  put("empty.AT2", "");
  const auto read = [&](const std::string& pattern) {
    return parse_study(block + friction + samples + fragility + "motions: [{records: \"" + pattern + "\"}]\n",
                       folder / "s.yaml", known())
        .motions.at(0);
  };
  for (const char* pattern : {"records", "records/", "records/*"}) {
    const MotionSource source = read(pattern);
    ASSERT_EQ(source.files.size(), 2U) << pattern;
    EXPECT_EQ(source.files[0].file.filename(), "a.csv");
    EXPECT_THAT(source.no_records,
                testing::ElementsAre("README.md (no record format)", "empty.AT2 (no record in the file)",
                                     "map.png (no text but a binary file)", "stations.csv (no record format)"));
  }
  EXPECT_EQ(read("records/*.csv").files.size(), 3U);
  const Study told = parse_study(block + friction + samples + fragility + "motions: [{records: records}]\n",
                                 folder / "s.yaml", known());
  EXPECT_THAT(doubts(told),
              testing::Contains(testing::HasSubstr("what is no record in records is left out: README.md")));
  for (const char* name : {"a.csv", "b.csv"}) std::filesystem::remove(folder / "records" / name);
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { read("records"); }),
              testing::AllOf(testing::HasSubstr("records holds no record (README.md (no record format), "),
                             testing::HasSubstr("name the folder of the records")));
}

TEST(Case, IsReadWithItsDefaults) {
  const Case one = parse_case(block +
                                  "friction: {mu_k: 0.25, mu_s: 0.3}\nmotion: {pulse: B, period_s: 0.5, "
                                  "peak_acceleration_g: 0.6, scale: 1.2}\n",
                              "one.yaml");
  EXPECT_EQ(one.output_step_s, 0.005);
  EXPECT_EQ(one.study.motions.at(0).pulse_scale, 1.2);
  EXPECT_EQ(fixed(one.study.model.friction.mu_s), 0.3);
}

// Whatever is done to the text, the answer is a study or an Error, nothing else.
TEST(Study, DamagedTextsNeverDoWorseThanAnError) {
  const std::string sound = block + friction + motions + samples + fragility;
  const std::string pieces = "{}[]:,-#\n\t '\"&*!|>%@0a\\";
  int errors = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    std::string text = sound;
    for (std::uint64_t j = 0; j <= i % 3; ++j) {
      const auto [where, what] = random::bits(i, j, 1);
      const std::size_t at = where % text.size();
      if (what % 3 == 0)
        text.erase(at, 1 + what / 3 % 5);
      else if (what % 3 == 1)
        text.insert(at, 1, pieces[what / 3 % pieces.size()]);
      else
        text[at] = pieces[what / 3 % pieces.size()];
    }
    try {
      parse(text);
    } catch (const Error& error) {
      ++errors;
      EXPECT_STRNE(error.what(), "");
    }
  }
  EXPECT_GT(errors, 1000);
}

TEST(Configs, EveryReadyStudyIsSoundButForRecordsThatTheUserBrings) {
  for (const char* name : {"quickstart.yaml", "kelvinator.yaml", "records.yaml", "every_key.yaml"}) {
    const auto file = freestand::test::source_dir() / "configs" / name;
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    EXPECT_NO_THROW(parse_study(text.str(), file, registries(), Files::ignore)) << name;
  }
  EXPECT_NO_THROW(read_case(freestand::test::source_dir() / "configs" / "case.yaml"));
}

// The page of all keys tells the defaults: leaving out every key that has one changes nothing.
TEST(Configs, EveryKeyShowsTheDefaults) {
  const auto file = freestand::test::source_dir() / "configs" / "every_key.yaml";
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  Study shown = parse_study(text.str(), file, registries(), Files::ignore);
  const Study least = parse_study(
      "name: every key\nsamples: 20000\nblock: {width_m: 0.6, height_m: 1.8, mass_kg: 1}\nfriction: {mu_k: {uniform: "
      "[0.1, 0.3]}}\n"
      "effects:\n  - {name: vertical_shaking}\n  - {name: my_seam, friction: 'mu*(1 + a*sin(2*pi*u/l))', parameters: "
      "{a: 0.3, l_m: 0.05}}\nchain: {stiffness_npm: 4e5, strength_n: 2736}\nmotions:\n"
      "  - {pulse: [A, B], period_s: 0.5, peak_acceleration_g: {uniform: [0.1, 2]}}\n"
      "  - {records: records/*, scale_to: {pta_g: {uniform: [0.1, 2]}}, building: {storeys: 5, period_s: 0.6}, storey: "
      "3}\n"
      "  - {synthetic: {arias_mps: {lognormal: {median: 0.5, dispersion: 0.4}}, duration_s: {uniform: [8, 14]}, "
      "middle_s: "
      "{uniform: [6, 9]}, frequency_hz: {uniform: [2, 5]}, bandwidth: 0.3, pulse: {type: [B, C1], period_s: {uniform: "
      "[1, 3]}, peak_velocity_mps: 0.6, middle_s: 6}}}\n"
      "fragility:\n  axes: [friction.mu_k]\n"
      "  damage:\n    blocked_door: peak_slip_m > 0.1 or overturned\n    leaves_table: {when: residual_slip_m > edge_m "
      "and "
      "not overturned, parameters: {edge_m: {lognormal: {median: 0.05, dispersion: 0.4}}}}\n"
      "  target: {friction.mu_k: {lognormal: {median: 0.2, dispersion: 0.2, min: 0.1, max: 0.3}}}\n",
      file, registries(), Files::ignore);
  EXPECT_THAT(shown.fragility.edp, testing::UnorderedElementsAreArray(least.fragility.edp));
  EXPECT_EQ(std::get<Fixed>(shown.model.friction.static_ratio.value().value).value, 1);
  shown.model.friction.static_ratio.reset();
  shown.model.chain->height.reset();
  shown.fragility.edp = least.fragility.edp;  // the order of the list is the user's
  shown.fragility.capacities = least.fragility.capacities;
  EXPECT_EQ(expanded(shown), expanded(least));
}

}  // namespace
}  // namespace freestand::study::study_test
