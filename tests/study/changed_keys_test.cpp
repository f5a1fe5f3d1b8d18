#include "study/changed_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/study_text.hpp"

namespace freestand::study {
namespace {

const std::string sound = test::block + test::friction + test::motions + test::samples;

const std::string plain = sound + test::fragility;

std::string told(const std::string& now, const std::string& before) {
  return changes_told(test::parse(now), test::parse(before));
}

TEST(ChangedKeys, TheFirstIsNamedWithBothValues) {
  const std::string chain = "chain: {slack_m: 0.05, stiffness_npm: 4e5, strength_n: 2736}\n";
  const std::string longer = "chain: {slack_m: 0.07, stiffness_npm: 4e5, strength_n: 2736}\n";
  EXPECT_EQ(told(plain + longer, plain + chain), "chain.slack_m was 0.05, is 0.07");
  EXPECT_EQ(told(plain + longer + "seed: 3\n", plain + chain), "seed was 1, is 3; and 1 more");
  EXPECT_THAT(told(plain + chain, plain), testing::StartsWith("chain.slack_m was nothing, is 0.05; and "));
  EXPECT_THAT(told(plain, plain + chain), testing::StartsWith("chain.slack_m was 0.05, is nothing; and "));
  EXPECT_EQ(told(plain + "keep: none\n", plain), "keep was all, is none");
  EXPECT_EQ(told(plain, plain + "keep: none\n"), "keep was none, is all");
  EXPECT_EQ(told(test::block + "friction: {mu: 0.3}\n" + test::motions + test::samples + test::fragility, plain),
            "friction.mu was 0.25, is 0.3");
}

TEST(ChangedKeys, WhatIsAskedOfTheSamplesIsNoOtherStudy) {
  EXPECT_EQ(told(sound + "name: two\nfragility: {edp: [delta], bins: {count: 3}}\n", sound + test::fragility), "");
  EXPECT_EQ(told(sound + "fragility: {edp: [delta], im: pta_g}\n", sound + "fragility: {edp: [delta]}\n"), "");
}

}  // namespace
}  // namespace freestand::study
