// The study key `legs`, chains at an angle to the floor, and friction that differs between directions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/effect.hpp"
#include "study/realise.hpp"
#include "study_text.hpp"

namespace freestand::study::legs_test {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string on_legs = "legs: {vertical_frequency_hz: {uniform: [2, 6]}, vertical_damping: 0.1}\n";
std::string told(const std::string& more) {
  return problems(block + friction + samples + motions + fragility + on_legs + more);
}

TEST(StudyLegs, ComeToTheSpecimenWithTheirDrawsAndAreWrittenBack) {
  const Study study = parse(block + friction + samples + motions + on_legs +
                            "fragility: {edp: [overturned], axes: [legs.vertical_frequency_hz]}\n");
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  const Realiser realise(study, load_motions(study));
  double least = 10, most = 0;
  for (std::uint64_t sample = 0; sample < 64; ++sample) {
    const auto& legs = realise(sample).specimen.legs;
    ASSERT_TRUE(legs);
    EXPECT_EQ(legs->damping, 0.1);
    least = std::min(least, legs->frequency_hz);
    most = std::max(most, legs->frequency_hz);
  }
  EXPECT_GE(least, 2);
  EXPECT_LE(most, 6);
  EXPECT_GT(most - least, 3);
}

TEST(StudyLegs, WhatDoesNotGoWithThemIsRefusedWithTheReason) {
  EXPECT_EQ(told("effects: [{name: static_friction, ratio: 1.2}, {name: vertical_shaking}]\n"), "");
  EXPECT_THAT(told("model: slide\n"), HasSubstr("legs does not go with this block"));
  EXPECT_THAT(told("effects: [{name: viscous_drag, rate_per_s: 0.5}]\n"),
              HasSubstr("the law of effect viscous_drag is of a block on rigid edges"));
  EXPECT_THAT(told("effects: [{name: impact_loss, factor: 0.9}]\n"), HasSubstr("effect impact_loss is of blows"));
  EXPECT_THAT(told("effects: [{name: floor_tilt, angle_rad: 0.01}]\n"), HasSubstr("floor_tilt"));
  EXPECT_THAT(told("chain: {stiffness_npm: 1e5, strength_n: 1000}\n"),
              HasSubstr("a chain is of a block on rigid edges"));
  EXPECT_THAT(told("start: {slip_m: 0.1}\n"), HasSubstr("begins at rest"));
  EXPECT_EQ(told("impact: {law: housner, factor: 1}\n"), "");
  for (const char* impact : {"{law: coulomb}", "{law: housner, factor: 0.5}", "{factor: {uniform: [0.5, 1]}}"})
    EXPECT_THAT(told(std::string("impact: ") + impact + "\n"), HasSubstr("impact is of blows"));
  const std::string poor = problems(block + friction + samples + motions + "legs: {vertical_damping: -1}\n");
  for (const char* what : {"legs.vertical_frequency_hz is missing", "must not be negative"})
    EXPECT_THAT(poor, HasSubstr(what));
}

// All that is drawn of a chain may be an axis; a number that is fixed is told to have one value.
TEST(StudyChain, WhatIsDrawnOfItMayBeAnAxis) {
  const std::string held =
      "chain: {stiffness_npm: {uniform: [1e4, 1e5]}, strength_n: {uniform: [500, 1000]}, slack_m: {uniform: [0, "
      "0.02]}, "
      "number: {choice: [1, 2]}, elevation_rad: {uniform: [-0.5, 0.5]}, damping_nspm: {uniform: [0, 50]}, wall_gap_m: "
      "0.1}\n";
  for (const char* axis : {"stiffness_npm", "strength_n", "slack_m", "number", "elevation_rad", "damping_nspm"})
    EXPECT_EQ(problems(block + friction + samples + motions + held + "fragility: {edp: [overturned], axes: [chain." +
                       axis + "]}\n"),
              "");
  EXPECT_THAT(problems(block + friction + samples + motions + held +
                       "fragility: {edp: [overturned], axes: [chain.wall_gap_m]}\n"),
              HasSubstr("has one value only"));
}

TEST(StudyChain, ItsAngleToTheFloorComesToTheSpecimen) {
  const std::string held = "chain: {stiffness_npm: 1e5, strength_n: 1000, elevation_rad: {uniform: [-0.5, 0.5]}}\n";
  const Study study = parse(block + friction + samples + motions + fragility + held);
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_THAT(expanded(study), HasSubstr("elevation_rad"));
  const Realiser realise(study, load_motions(study));
  const Specimen specimen = realise(0).specimen;
  ASSERT_EQ(specimen.effects.size(), 1u);
  EXPECT_TRUE(specimen.effects[0].effect->lift);
  EXPECT_THAT(
      problems(block + friction + samples + motions + "chain: {stiffness_npm: 1e5, strength_n: 1, elevation_rad: 2}\n"),
      HasSubstr("less than a right angle to the floor"));
}

TEST(StudyFriction, ThatDiffersBetweenDirectionsNeedsThemBoth) {
  EXPECT_THAT(
      problems("model: slide\n" + block + "friction: {mu: 0.3, ratio_across: 0.7}\n" + samples + motions),
      HasSubstr(
          "friction.ratio_across is of sliding in both horizontal directions (motions move the floor along one line)"));
  EXPECT_THAT(problems("model: slide\n" + block + "friction: {mu: 0.3, axis_rad: 0.7}\n" + samples + motions),
              HasSubstr("add friction.ratio_across"));
}

}  // namespace
}  // namespace freestand::study::legs_test
