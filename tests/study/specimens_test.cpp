// Specimens as they are: centre of mass and inertia, a start on the way, several chains, a height at which accelerations are
// followed: what a study says of them reaches the samples, comes back from the expanded study, and is refused where it cannot be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "study/realise.hpp"
#include "study_text.hpp"

namespace freestand::study::specimens_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

const std::string rest = friction + samples + fragility + motions;

TEST(Specimens, CentreOfMassAndInertiaReachTheSample) {
  const Study study = parse(
      "block: {width_m: 0.6, height_m: 1.8, mass_kg: 150, centre_height_m: {uniform: [0.5, 0.8]}, inertia_kgm2: 60}\n" +
      rest);
  const Realisation sample = Realiser(study, load_motions(study))(3);
  const Block& b = sample.specimen.block;
  EXPECT_GT(b.height_m, 0.5);
  EXPECT_LT(b.height_m, 0.8);
  EXPECT_DOUBLE_EQ(b.gyration2_m2, 60.0 / 150);
  EXPECT_EQ(b.full_height_m(), 1.8);
  EXPECT_DOUBLE_EQ(b.alpha_rad(), std::atan(0.3 / b.height_m));
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
}

TEST(Specimens, AMassThatCannotLieSoIsRefused) {
  const auto told = [](const std::string& keys) {
    return problems("block: {width_m: 0.6, height_m: 1.8, mass_kg: 150, " + keys + "}\n" + rest);
  };
  EXPECT_THAT(told("centre_height_m: 1.8"), HasSubstr("the centre of mass lies within the block"));
  EXPECT_THAT(told("centre_height_m: {lognormal: {median: 0.9, dispersion: 0.2}}"), HasSubstr("by min and max"));
  EXPECT_EQ(told("centre_height_m: {lognormal: {median: 0.9, dispersion: 0.2, max: 1.5}}"), "");
  EXPECT_THAT(told("gyration_radius_m: 1.1"), HasSubstr("no point of the block is farther than 0.9487 m"));
  EXPECT_THAT(told("gyration_radius_m: 0.5, inertia_kgm2: 40"), HasSubstr("one determines the other"));
  EXPECT_THAT(problems("block: {width_m: 0.6, height_m: 1.8, inertia_kgm2: 40}\n" + rest), HasSubstr("needs the mass"));
  EXPECT_THAT(problems("block: {slenderness_rad: 0.3, size_m: 1, centre_height_m: 0.5}\n" + rest),
              HasSubstr("give width_m and height_m"));
}

TEST(Specimens, AStartReachesTheSample) {
  const Study study = parse(block + "start: {rotation_rad: {uniform: [-0.1, 0.1]}, slip_velocity_mps: 0.2}\n" + rest);
  const Realisation sample = Realiser(study, load_motions(study))(5);
  EXPECT_NE(sample.specimen.start.rotation_rad, 0);
  EXPECT_EQ(sample.specimen.start.slip_velocity_mps, 0.2);
  EXPECT_EQ(sample.specimen.start.slip_m, 0);
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_TRUE(Realiser(parse(block + rest), load_motions(study))(5).specimen.start.upright_at_rest());
}

TEST(Specimens, AStartThatAModelDoesNotKnowIsRefused) {
  EXPECT_THAT(problems(block + "start: {rotation_rad: 1.6}\n" + rest), HasSubstr("has fallen"));
  EXPECT_THAT(problems(block + "model: slide\nstart: {rotation_rad: 0.1}\n" + rest), HasSubstr("does not tip"));
  EXPECT_THAT(problems(block + "model: rock\nstart: {slip_velocity_mps: 0.1}\n" + rest), HasSubstr("does not slip"));
  EXPECT_THAT(problems(block +
                       "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 2}\n"
                       "start: {slip_m: 0.1}\n" +
                       rest),
              HasSubstr("does not go with model bouc_wen"));
  EXPECT_THAT(problems(block +
                       "effects: [{name: flexible_legs, frequency_hz: 5, damping: 0.1}]\n"
                       "start: {slip_m: 0.1}\n" +
                       rest),
              HasSubstr("flexible_legs"));
  EXPECT_THAT(problems(block + "start: {rotation: 0.1}\n" + rest), HasSubstr("rotation_rad"));
}

TEST(Specimens, ChainsComeInNumbersAtAnAngleWithDamping) {
  const std::string chain =
      "chain: {stiffness_npm: 4e5, strength_n: 2736, number: 2, plan_angle_rad: 0.26, damping_nspm: 900}\n";
  const Study study = parse(block + chain + rest);
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_THAT(expanded(study),
              AllOf(HasSubstr("number: 2"), HasSubstr("plan_angle_rad: 0.26"), HasSubstr("damping_nspm: 900")));
  EXPECT_THAT(problems(block + "chain: {stiffness_npm: 4e5, strength_n: 2736, number: 0.5}\n" + rest),
              HasSubstr("chain.number"));
  EXPECT_THAT(problems(block + "chain: {stiffness_npm: 4e5, strength_n: 2736, plan_angle_rad: 15}\n" + rest),
              HasSubstr("less than a right angle"));
}

TEST(Specimens, AccelerationsAreFollowedAtAHeightOfTheBlock) {
  const Study study = parse("acceleration_height_m: 1.5\n" + block + rest);
  EXPECT_EQ(integration_settings(study).acceleration_height_m, 1.5);
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_TRUE(std::isnan(integration_settings(parse(block + rest)).acceleration_height_m));
  EXPECT_THAT(problems("acceleration_height_m: 2\n" + block + rest), HasSubstr("the block as low as 1.8 m"));
}

}  // namespace
}  // namespace freestand::study::specimens_test
