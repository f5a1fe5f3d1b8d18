// Two programs that share no line, one physics, over every effect in every mode.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "judge/known_gaps.hpp"
#include "judge/tally.hpp"
#include "support/repeats.hpp"

namespace freestand::test {
namespace {

// A case of every recipe (FREESTAND_LONG_TESTS: two), and those of walls five times.
TEST(Judge, AgreesWithTheKernelOnEveryEffectInEveryMode) {
  Tally tally;
  const std::vector<Recipe> all = recipes();
  for (std::uint64_t number = 0; number < 5 * all.size(); ++number) {
    const std::vector<std::string>& about = all[number % all.size()].effects;
    const bool with_wall = std::find(about.begin(), about.end(), "wall_impact") != about.end();
    if (number >= (test::long_tests() ? 2 : 1) * all.size() && !with_wall) continue;
    const JudgedCase c = judged_case(1, number);
    const Judgement judgement = judge(c);
    tally.add(c, judgement);
    EXPECT_NE(judgement.finding, Finding::disagrees) << c.text() << "\n  " << judgement.what;
  }
  std::printf("%s", tally.table().c_str());
  EXPECT_THAT(tally.empty_cells(), testing::IsEmpty());
  EXPECT_GT(tally.total().compared, tally.total().samples * 9 / 10);
}

// Laws of no catalogue, in every setting and with every other effect: of position, time, speed, and time at rest.
TEST(Judge, AgreesWithTheKernelOnLawsThatAreFormulas) {
  int compared = 0;
  const std::uint64_t count = recipes(Family::formulas).size();
  for (std::uint64_t number = 0; number < count; ++number) {
    const JudgedCase c = judged_case(4, number, Family::formulas);
    const Judgement judgement = judge(c);
    compared += judgement.finding == Finding::agrees;
    EXPECT_NE(judgement.finding, Finding::disagrees) << c.text() << "\n  " << judgement.what;
  }
  EXPECT_GT(compared, 0.9 * static_cast<double>(count));
}

// The same walls on the left at gap 0, and on both sides, which the cases above do not have.
TEST(Judge, AgreesOnWallsOnTheLeftAndOnBothSides) {
  const std::vector<Recipe> all = recipes();
  int judged = 0, compared = 0, struck = 0;
  for (std::uint64_t number = 0; number < all.size(); ++number) {
    const std::vector<std::string>& about = all[number].effects;
    if (std::count(about.begin(), about.end(), "wall_impact") != 1) continue;
    JudgedCase c = judged_case(7, number);
    const auto wall = std::find_if(c.truth.effects.begin(), c.truth.effects.end(),
                                   [](const TruthEffect& effect) { return effect.name == "wall_impact"; });
    const bool both = judged % 2 == 1;
    wall->parameters["gap_m"] = both ? 0.03 : 0;
    wall->parameters["side"] = -1;
    if (both) wall->parameters["other_gap_m"] = judged % 4 == 1 ? 0 : 0.02;
    const Judgement judgement = judge(c);
    ++judged;
    compared += judgement.finding == Finding::agrees;
    struck +=
        (judgement.deeds & (struck_by_face | struck_by_lower_edge | struck_by_upper_edge | struck_in_flight)) != 0;
    EXPECT_NE(judgement.finding, Finding::disagrees) << number << ' ' << c.text() << "\n  " << judgement.what;
  }
  EXPECT_GE(judged, 15);
  EXPECT_GE(compared, judged * 9 / 10);
  EXPECT_GE(struck, judged / 2);
}

// Bouc-Wen's contact, with every effect that goes with it, alone and in pairs. Every second pair without a chain, and pairs on the stiffest
// contact, which takes two thirds of the time for its tiny steps, only with FREESTAND_LONG_TESTS; each effect alone meets it, as its number
// draws it, in any case.
TEST(Judge, AgreesWithTheKernelOnABoucWenContact) {
  const bool all = test::long_tests();
  Tally tally;
  int stiffest = 0;
  for (std::uint64_t number = 0; number < recipes(Family::bouc_wen).size(); ++number) {
    const JudgedCase c = judged_case(1, number, Family::bouc_wen);
    const bool stiff = c.truth.contact.yield_m < 1e-6, alone = c.recipe.effects.size() < 2;
    const bool chained = std::ranges::find(c.recipe.effects, "chain") != c.recipe.effects.end();
    if ((stiff || (number % 3 && !chained)) && !alone && !all) continue;
    stiffest += stiff;
    const Judgement judgement = judge(c);
    tally.add(c, judgement);
    EXPECT_NE(judgement.finding, Finding::disagrees) << c.text() << "\n  " << judgement.what;
  }
  std::printf("%s", tally.table().c_str());
  EXPECT_GE(stiffest, 3);
  EXPECT_THAT(tally.empty_cells(Family::bouc_wen), testing::IsEmpty());
  EXPECT_GT(tally.total().compared, tally.total().samples * 9 / 10);
}

// Legs and a throw: SUNDIALS looks for the root on which it stands, finds none of its own on either side, and gives up.
TEST(Judge, TheReferenceGoesOnFromTheRoundOffOfASlipThatStarts) {
  const Judgement judgement = judge(judged_case(2, 208));
  EXPECT_EQ(judgement.finding, Finding::agrees) << judgement.what;
}

// A foot under legs that stops for less than a step of the stepper; a row of hops whose end slides for less than one; a hop that the
// reference passed over, down and up again within one step; a foot under legs that slips on while its block tips; hops
// of microseconds, which the tolerance of a sweep does not go through: in them blocks are felt to accelerate by 4.93 and 5.22 m/s2, and by no
// more than 3.21 and 5.06 without them; a corner that begins to rise under the floor by round-off, 1e-54 rad, and struck it; a block beside
// a wall that slips briefly before it strikes the floor; a chain that grows slack at the very wall that its block strikes, upright or
// tipping; a foot under legs that comes down where it could as well slide on as stick, which the blow stops; a face that comes to its
// wall upright but for round-off; a row of hops at which the floor changes while it lasts; friction that grows so much as the pressure falls
// that it alone holds a corner down, or that a floor that pulls would solve it too; a small blow at which only a larger one of the other corner
// could end the slip; a row of hops in which a blow stops the slip, which goes on after it; friction that sees no force any more as the
// floor lets go of its corner, on legs and without, where the reference took that leap for a bend of the law.
TEST(Judge, LooksAsCloselyAsACaseAsks) {
  for (const auto& [seed, number] :
       {std::pair(2, 2123), std::pair(2, 359), std::pair(4, 871), std::pair(105, 140), std::pair(2, 209),
        std::pair(8, 330), std::pair(303, 234), std::pair(301, 304), std::pair(4711, 471), std::pair(4711, 4568),
        std::pair(4711, 1060), std::pair(4711, 2155), std::pair(112613, 2058), std::pair(900001, 3537),
        std::pair(900002, 571), std::pair(900003, 4993), std::pair(900003, 4588), std::pair(180001, 165),
        std::pair(261126, 377)}) {
    const Judgement judgement = judge(judged_case(seed, number));
    EXPECT_EQ(judgement.finding, Finding::agrees) << judgement.what;
  }
}

// Friction that grows as the pressure falls lets a corner carry or leave, a block that comes down beside a wall strikes both at
// once, a hinge turns first or flies first: what is none of these is told.
TEST(Judge, ExcusesOnlyWhatNobodyCanDecide) {
  for (const auto& [seed, number] : {std::pair(101, 413), std::pair(105, 349)}) {
    const Judgement judgement = judge(judged_case(seed, number));
    EXPECT_EQ(judgement.finding, Finding::agrees) << judgement.what;
  }
  for (const auto& [seed, number] : {std::pair(115, 168), std::pair(117, 468)}) {
    const Judgement judgement = judge(judged_case(seed, number));
    EXPECT_EQ(judgement.finding, Finding::on_an_edge) << judgement.what;
  }
  const JudgedCase hinge = judged_case(109, 377);
  Judgement parted = judge(hinge);
  EXPECT_EQ(parted.finding, Finding::disagrees);
  EXPECT_NE(known_gap(hinge, parted), "");
  parted.parted_s = 0.45;  // before the floor falls away
  EXPECT_EQ(known_gap(hinge, parted), "");
}

TEST(Judge, MakesTheSameCaseAgain) {
  EXPECT_EQ(judged_case(3, 77).text(), judged_case(3, 77).text());
  EXPECT_EQ(judged_case(3, 77).floor.horizontal_mps2, judged_case(3, 77).floor.horizontal_mps2);
  EXPECT_NE(judged_case(3, 77).text(), judged_case(4, 77).text());
}

}  // namespace
}  // namespace freestand::test
