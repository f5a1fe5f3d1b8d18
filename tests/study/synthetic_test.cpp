// Synthetic motions in a study: what it says of them, how their parameters are drawn, and that each is a motion of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "study/doubts.hpp"
#include "study/intensities.hpp"
#include "study/known.hpp"
#include "study/motion_summaries.hpp"
#include "study/synthetic_set.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::synthetic_test {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string shaking =
    "arias_mps: {lognormal: {median: 0.5, dispersion: 0.4}}, duration_s: {uniform: [3, 6]}, middle_s: {uniform: [3, "
    "4]}, "
    "frequency_hz: {uniform: [2, 4]}, bandwidth: 0.3, corner_hz: 0.3, step_s: 0.02";
const std::string pulse = ", pulse: {type: [B, C1], period_s: 1.5, peak_velocity_mps: 0.4, middle_s: 4}";

std::string text(const std::string& set, const std::string& more = "", const std::string& im = "report") {
  return block + friction + samples + "motions:\n  - {synthetic: " + set + more +
         "}\nfragility: {edp: [delta], im: " + im + "}\n";
}
Study study(int count, const std::string& set = shaking, const std::string& more = "",
            const std::string& im = "report") {
  return parse(text("{count: " + std::to_string(count) + ", " + set + "}", more, im));
}
std::vector<double> column(const MotionSet& motions, const std::string& name) {
  const auto at =
      std::find_if(motions.numbers.begin(), motions.numbers.end(), [&](const auto& n) { return n.name == name; });
  std::vector<double> values;
  for (const auto& entry : *motions.entries) values.push_back(entry.numbers.at(at - motions.numbers.begin()));
  return values;
}

TEST(SyntheticMotions, AreMotionsOfTheirOwnThatBringTheirParameters) {
  const Study swept =
      study(12, shaking + pulse, ", scale_to: {pga_g: {uniform: [0.1, 1]}}", "record.significant_5_95_expected_s");
  const MotionSet motions = load_motions(swept);
  ASSERT_EQ(motions.size(), 12U);
  EXPECT_EQ(motions.names()[11], "synthetic 11");
  std::vector<int> own(12);
  for (int i = 0; i < 12; ++i) own[i] = i;
  EXPECT_EQ(motions.groups(), own);  // the unit of the statistics
  const MotionSummaries summaries = summarize(motions, {1.0});
  for (const double duration : column(motions, "significant_5_95_expected_s"))
    EXPECT_TRUE(duration > 3 && duration < 6);
  const Realiser realise(swept, motions);
  std::set<std::size_t> taken;
  for (std::uint64_t sample = 0; sample < 64; ++sample) {
    const Realisation one = realise(sample);
    taken.insert(one.motion);
    EXPECT_TRUE(one.pta_g > 0.1 && one.pta_g < 1);
    EXPECT_NEAR(one.pta_g * standard_gravity_mps2,
                one.shaking.scale * motion::peaks(motions.motion(one.motion)).pga_mps2, 1e-9);
  }
  EXPECT_EQ(taken.size(), 12U);
  const auto& known = (*motions.entries)[0].known_pulse;
  EXPECT_TRUE(known.type == "B" || known.type == "C1");
  EXPECT_EQ(known.period_s, 1.5);
  EXPECT_TRUE(summaries[0].pulse.period_given);
  EXPECT_EQ(summaries[0].given_value("significant_5_95_expected_s"), column(motions, "significant_5_95_expected_s")[0]);
}

TEST(SyntheticMotions, ADrawIsAFunctionOfSeedNameAndNumber) {
  const MotionSet few = load_motions(study(3)), many = load_motions(study(9));
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_EQ(few.motion(n).horizontal_mps2, many.motion(n).horizontal_mps2);  // more motions change none before
  const Study set = study(9);
  EXPECT_EQ(realisation(*set.motions[0].synthetic, 1, 8).horizontal_mps2, many.motion(8).horizontal_mps2);  // alone
  EXPECT_NE(realisation(*set.motions[0].synthetic, 2, 8).horizontal_mps2, many.motion(8).horizontal_mps2);
  EXPECT_NE(load_motions(study(1, "name: other, " + shaking)).motion(0).horizontal_mps2, few.motion(0).horizontal_mps2);
  // Another parameter that is drawn, and a pulse, change no other draw.
  std::string wider = shaking;
  wider.replace(wider.find("bandwidth: 0.3"), 14, "bandwidth: {uniform: [0.2, 0.4]}");
  const MotionSet more = load_motions(study(9, wider + pulse));
  for (const char* name : {"arias_expected_mps", "significant_5_95_expected_s", "middle_s", "frequency_hz"})
    EXPECT_EQ(column(more, name), column(many, name)) << name;
  EXPECT_NE(column(more, "bandwidth"), column(many, "bandwidth"));
}

// Kolmogorov's distance of n independent draws from the distribution stays below 1.95/sqrt(n) in 999 of 1000 cases; the correlation of
// two independent parameters below 3.3/sqrt(n).
TEST(SyntheticMotions, ParametersFollowTheirDistributions) {
  const Study set = study(400);
  const SyntheticPart& part = *set.motions[0].synthetic;
  std::vector<double> duration, arias;
  for (std::uint64_t n = 0; n < 400; ++n) {
    const auto p = synthetic_parameters(part, 1, n);
    duration.push_back((p.duration_s - 3) / 3);
    arias.push_back(0.5 * std::erfc(-std::log(p.arias_mps / 0.5) / 0.4 / std::sqrt(2)));
  }
  double together = 0;
  for (std::size_t n = 0; n < 400; ++n) together += 12 * (duration[n] - 0.5) * (arias[n] - 0.5) / 400;
  EXPECT_LT(std::abs(together), 3.3 / 20);
  for (auto* values : {&duration, &arias}) {
    std::sort(values->begin(), values->end());
    double distance = 0;
    for (std::size_t n = 0; n < 400; ++n)
      distance = std::max({distance, std::abs((*values)[n] - n / 400.0), std::abs((*values)[n] - (n + 1) / 400.0)});
    EXPECT_LT(distance, 1.95 / 20);
  }
}

TEST(SyntheticMotions, AreWrittenBackAsTheyAre) {
  for (const std::string& set : {shaking, shaking + pulse, "name: \"a: b\", frequency_slope_hzps: -0.1, " + shaking}) {
    const Study once =
        study(4, set, ", building: {storeys: 3, period_s: 0.5}, storey: {choice: [0, 2]}", "ground.pga_g");
    const Study again = parse(expanded(once));
    EXPECT_EQ(expanded(again), expanded(once));
    EXPECT_EQ(load_motions(again).fingerprint(), load_motions(once).fingerprint());
    EXPECT_THAT(load_motions(once).groups(),
                testing::ElementsAre(0, 0, 2, 2, 4, 4, 6, 6));  // floors of one are one motion
  }
}

TEST(SyntheticMotions, AFileAndAMappingAreTheSameSet) {
  const freestand::test::Scratch folder("synthetic");
  std::ofstream(folder / "near.yaml")
      << "count: 2\narias_mps: 0.5\nduration_s: 5\nmiddle_s: 4\nfrequency_hz: 3\nbandwidth: 0.3\n";
  const Study by_file = parse_study(text("near.yaml"), folder / "s.yaml", known(), Files::look);
  const Study inlined = parse(
      text("{name: near, count: 2, arias_mps: 0.5, duration_s: 5, middle_s: 4, frequency_hz: 3, bandwidth: 0.3}"));
  EXPECT_EQ(expanded(by_file).substr(expanded(by_file).find("seed")),
            expanded(inlined).substr(expanded(inlined).find("seed")));
  std::ofstream(folder / "bad.yaml") << "count: 2\narias: 0.5\n";
  const std::string told = freestand::test::error_text(
      Exit::usage, [&] { parse_study(text("bad.yaml"), folder / "s.yaml", known(), Files::look); });
  EXPECT_THAT(told, HasSubstr("s.yaml:5: motions[0].synthetic: "));
  EXPECT_THAT(told, HasSubstr("bad.yaml:2: "));
  EXPECT_THAT(told, HasSubstr("arias_mps"));
}

TEST(SyntheticMotions, WhatIsWrongIsTold) {
  const auto told = [](const std::string& set, const std::string& more = "") { return problems(text(set, more)); };
  EXPECT_THAT(told("{}"), testing::AllOf(HasSubstr("add arias_mps: 0.5"), HasSubstr("add duration_s: 12"),
                                         HasSubstr("add middle_s"), HasSubstr("add frequency_hz"),
                                         HasSubstr("add bandwidth: 0.3")));
  EXPECT_THAT(told("{" + shaking + ", pulse: {}}"), HasSubstr("synthetic.pulse.type is missing"));
  EXPECT_THAT(told("{" + shaking + ", pulse: {type: Q, period_s: 1, peak_velocity_mps: 1, middle_s: 3}}"),
              HasSubstr("synthetic.pulse.type"));
  EXPECT_THAT(told("{" + shaking + ", damping: 0.2}"), HasSubstr("damping"));
  EXPECT_THAT(told("{count: 0, " + shaking + "}"), HasSubstr("count"));
  EXPECT_THAT(told("{name: a/b, " + shaking + "}"), HasSubstr("files are named by it"));
  EXPECT_THAT(told("{" + shaking + "}", ", period_s: 1"), HasSubstr("does not go with synthetic"));
  EXPECT_THAT(told("{" + shaking + "}", ", pulse: B"), HasSubstr("are both given"));
  EXPECT_THAT(told("{" + shaking + "}", ", records: \"*\""), HasSubstr("are both given"));
  std::string longer = shaking;
  longer.replace(longer.find("[3, 6]"), 6, "[12, 40]");
  EXPECT_THAT(told("{count: 20, " + longer + "}"),
              testing::AllOf(HasSubstr("some.yaml:4: synthetic 0 is a shaking of"), HasSubstr("of 20")));
  EXPECT_THAT(problems(block + friction + samples + fragility + "motions:\n  - {synthetic: {" + shaking +
                       "}}\n  - {synthetic: {" + shaking + "}}\n"),
              HasSubstr("two sets of synthetic motions are called synthetic"));
  EXPECT_THAT(case_problems(block + friction + "motion: {synthetic: {" + shaking + "}}\n"),
              HasSubstr("--number 0 --convert"));
}

TEST(SyntheticMotions, APulseOfOneSignBesideAWallIsDoubted) {
  const auto doubted = [](const std::string& set) {
    Study one = study(2, set);
    one.fragility.edp = {"peak_slip_right_m"};
    return testing::PrintToString(doubts(one));
  };
  EXPECT_THAT(doubted(shaking + pulse), HasSubstr("synthetic shakes with one sign only"));
  EXPECT_THAT(doubted(shaking), testing::Not(HasSubstr("one sign")));  // noise has both
}

}  // namespace
}  // namespace freestand::study::synthetic_test
