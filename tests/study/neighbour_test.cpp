// The study key `neighbour`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/realise.hpp"
#include "study_text.hpp"

namespace freestand::study::neighbour_test {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string beside =
    "neighbour: {gap_m: {uniform: [0.01, 0.05]}, mass_kg: 300, mu_k: 0.3, restitution: 0.4, side: left}\n";
const std::string light = "block: {width_m: 0.6, height_m: 1.8}\n";  // without its mass

std::string told(const std::string& more) { return problems(block + friction + samples + motions + beside + more); }

TEST(StudyNeighbour, ComesToTheSpecimenWithItsDrawsAndIsWrittenBack) {
  const Study study = parse("model: slide\n" + block + friction + samples + motions + beside +
                            "fragility: {edp: [delta, wall_hit], axes: [neighbour.gap_m]}\n");
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  const Realiser realise(study, load_motions(study));
  double least = 1, most = 0;
  for (std::uint64_t sample = 0; sample < 64; ++sample) {
    const auto& neighbour = realise(sample).specimen.neighbour;
    ASSERT_TRUE(neighbour);
    EXPECT_EQ(neighbour->side, -1);
    EXPECT_EQ(neighbour->mass_kg, 300);
    EXPECT_EQ(neighbour->friction.mu_s, 0.3);
    EXPECT_EQ(neighbour->friction.mu_k, 0.3);
    EXPECT_EQ(neighbour->restitution, 0.4);
    least = std::min(least, neighbour->gap_m);
    most = std::max(most, neighbour->gap_m);
  }
  EXPECT_GE(least, 0.01);
  EXPECT_LE(most, 0.05);
  EXPECT_GT(most - least, 0.03);
}

TEST(StudyNeighbour, WhatDoesNotGoWithItIsRefusedWithTheReason) {
  EXPECT_THAT(told("model: slide_rock\n"), HasSubstr("two blocks side by side are followed where they only slide"));
  EXPECT_THAT(told("model: slide\neffects: [{name: viscous_drag, rate_per_s: 0.5}]\n"),
              HasSubstr("effect viscous_drag is of a block that stands alone"));
  EXPECT_THAT(told("model: slide\neffects: [{name: vertical_shaking}]\n"), HasSubstr("effect vertical_shaking"));
  EXPECT_THAT(told("model: slide\nchain: {stiffness_npm: 1e5, strength_n: 1000}\n"), HasSubstr("chain is of a block"));
  EXPECT_THAT(told("model: slide\nstart: {slip_m: 0.1}\n"), HasSubstr("begins at rest"));
  EXPECT_THAT(told("model: slide\ncontact_forces: true\n"), HasSubstr("contact_forces does not go with neighbour"));
  EXPECT_THAT(told("model: slide\nacceleration_height_m: 1\n"), HasSubstr("acceleration_height_m does not go with"));
  EXPECT_THAT(problems("model: slide\n" + light + friction + samples + motions + beside),
              HasSubstr("add block.mass_kg"));
  const std::string poor = problems("model: slide\n" + block + friction + samples + motions +
                                    "neighbour: {restitution: 1.2, static_ratio: 0.9}\n");
  for (const char* what : {"neighbour.gap_m is missing", "neighbour.mass_kg is missing", "neighbour.mu_k is missing",
                           "it must lie between 0 and 1", "it must be at least 1"})
    EXPECT_THAT(poor, HasSubstr(what));
}

}  // namespace
}  // namespace freestand::study::neighbour_test
