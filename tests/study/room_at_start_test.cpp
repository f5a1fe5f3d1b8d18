// No block begins within a wall: refused before the first sample, by the ranges of what is drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_text.hpp"

namespace freestand::study::room_at_start_test {
namespace {

using namespace test;
using testing::HasSubstr;

// A block of 0.6 by 1.8 m.
std::string told(const std::string& start, const std::string& wall) {
  return problems(block + friction + samples + motions + fragility + "start: {" + start + "}\n" + wall + "\n");
}
std::string beside(const std::string& start, const std::string& wall) {
  return told(start, "effects: [{name: wall_impact, " + wall + "}]");
}

TEST(RoomAtStart, ASlipUpToTheWallAndNoFarther) {
  EXPECT_EQ(beside("slip_m: 0.05", "gap_m: 0.05"), "");
  EXPECT_THAT(
      beside("slip_m: 0.1", "gap_m: 0.05"),
      HasSubstr("start sets the block down to 0.1 m to the right, and the wall of wall_impact stands 0.05 m there"));
  EXPECT_EQ(beside("slip_m: -0.1", "gap_m: 0.05"), "");
  EXPECT_THAT(beside("slip_m: -0.1", "gap_m: -0.05"), HasSubstr("to the left"));
  EXPECT_THAT(beside("slip_m: -0.1", "gap_m: 0.05, side: -1"), HasSubstr("to the left"));
  EXPECT_THAT(beside("slip_m: -0.1", "gap_m: 0.2, other_gap_m: 0.05"), HasSubstr("to the left"));
  EXPECT_THAT(beside("slip_m: 0.1", "gap_m: 0.2, side: -1, other_gap_m: 0.05"), HasSubstr("to the right"));
  EXPECT_EQ(beside("slip_m: 0.1", "gap_m: 0.05, side: -1"), "");
}

TEST(RoomAtStart, OfWhatIsDrawnTheEndsOfTheRangesDecide) {
  EXPECT_EQ(beside("slip_m: {uniform: [-0.1, 0.02]}", "gap_m: {uniform: [0.02, 0.1]}"), "");
  EXPECT_THAT(beside("slip_m: {uniform: [-0.1, 0.03]}", "gap_m: {uniform: [0.02, 0.1]}"), HasSubstr("to the right"));
}

// 1.8 sin 0.1 = 0.1797 m.
TEST(RoomAtStart, TheUpperEdgeOfATippedBlockLeads) {
  EXPECT_EQ(beside("rotation_rad: 0.1", "gap_m: 0.18"), "");
  EXPECT_THAT(beside("rotation_rad: 0.1", "gap_m: 0.179"), HasSubstr("down to 0.1797 m to the right"));
  EXPECT_EQ(beside("rotation_rad: -0.1", "gap_m: 0.02"), "");
  EXPECT_THAT(beside("rotation_rad: -0.1, slip_m: 0.05", "gap_m: -0.1"), HasSubstr("down to 0.1297 m to the left"));
}

TEST(RoomAtStart, TheWallBehindAChainIsOnItsOtherSide) {
  const std::string chain = "chain: {stiffness_npm: 1e5, strength_n: 1000, slack_m: 0.2, wall_gap_m: 0.05}";
  EXPECT_EQ(told("slip_m: 0.1", chain), "");
  EXPECT_THAT(told("slip_m: -0.1", chain), HasSubstr("the wall of chain stands 0.05 m there"));
}

}  // namespace
}  // namespace freestand::study::room_at_start_test
