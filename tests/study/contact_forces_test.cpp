// The study key `contact_forces`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_text.hpp"

namespace freestand::study::contact_forces_test {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(StudyForces, AreFollowedWhereTheyAreKnown) {
  EXPECT_THAT(problems(block + friction + samples + motions + fragility +
                       "contact_forces: true\nmodel: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 2}\n"),
              HasSubstr("contact_forces does not go with model bouc_wen"));
  EXPECT_THAT(
      problems(block + friction + samples + motions + "contact_forces: true\nfragility: {edp: [peak_chain_force_n]}\n"),
      HasSubstr("no chain holds"));
  const Study study = parse("contact_forces: true\n" + block + friction + samples + motions + fragility);
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_THAT(expanded(study), HasSubstr("contact_forces: true"));
}

}  // namespace
}  // namespace freestand::study::contact_forces_test
