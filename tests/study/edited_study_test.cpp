#include "study/edited_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/known.hpp"
#include "study/study_text.hpp"

namespace freestand::study::edited_study_test {
namespace {

const std::string sound = "name: one\n" + test::block + "friction: {mu_k: {uniform: [0.1, 0.3]}}\n" + test::motions +
                          "samples: 1000\nfragility:\n  edp: [delta, overturned]\n  axes: [friction.mu_k]\n";

std::string swept() { return expanded(parse_study(sound, "some.yaml", registries())); }

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string problem(const std::string& text) {
  try {
    edited_study(swept(), text, "out/study.yaml");
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::usage);
    return error.what();
  }
  return "";
}

TEST(EditedStudy, WhatWasSweptIsNoChange) {
  EXPECT_THAT(edited_study(swept(), swept(), "study.yaml").changed, testing::IsEmpty());
  EXPECT_THAT(edited_study(swept(), sound, "study.yaml").changed, testing::IsEmpty());  // however it is written
  EXPECT_EQ(edited_study(swept(), changed(sound, "one", "two"), "study.yaml").study.name, "two");
}

TEST(EditedStudy, KeysOfTheFragilityBlockAreUsed) {
  const EditedStudy edited = edited_study(
      swept(), sound + "  confidence: 0.9\n  bins: {edges: [0, 1, 2]}\n  capacities: {delta: [1]}\n", "study.yaml");
  EXPECT_THAT(edited.changed, testing::ElementsAre("fragility.bins", "fragility.capacities", "fragility.confidence"));
  EXPECT_EQ(edited.study.fragility.confidence, 0.9);
  EXPECT_THAT(edited.study.fragility.bins.edges, testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(edited_study(swept(), sound + "  im: pga_g\n", "study.yaml").changed,
              testing::ElementsAre("fragility.im"));
  const EditedStudy without = edited_study(swept(), changed(sound, "[friction.mu_k]", "[]"), "study.yaml");
  EXPECT_THAT(without.changed, testing::ElementsAre("fragility.axes"));
  EXPECT_TRUE(without.study.fragility.axes.empty());
}

TEST(EditedStudy, WhatTheSamplesWereMadeWithCannotChange) {
  EXPECT_THAT(
      problem(changed(sound, "0.3", "0.4")),
      testing::StartsWith("out/study.yaml:3: friction.mu_k.uniform[1] is 0.4, and the samples were made with 0.3"));
  EXPECT_THAT(problem(changed(sound, "samples: 1000", "samples: 2000")), testing::HasSubstr(":5: samples is 2000"));
  EXPECT_THAT(problem(changed(sound, "period_s: 0.5", "period_s: 1")),
              testing::HasSubstr(":4: motions[0].period_s is 1"));
  EXPECT_THAT(problem("seed: 3\n" + sound), testing::HasSubstr(":1: seed is 3, and the samples were made with 1"));
  EXPECT_THAT(problem("effects: [{name: floor_tilt, angle_rad: 0.01}]\n" + sound),
              testing::HasSubstr("effects[0].name is floor_tilt"));
}

TEST(EditedStudy, MistakesAreToldAsOfAnyStudy) {
  EXPECT_THAT(problem(sound + "  resamples: 0\n"), testing::HasSubstr("study.yaml:9: fragility.resamples is 0"));
  EXPECT_THAT(problem(changed(sound, "[friction.mu_k]", "[friction.mu]")), testing::HasSubstr("study.yaml:8: axis"));
}

}  // namespace
}  // namespace freestand::study::edited_study_test
