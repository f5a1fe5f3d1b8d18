// Two programs that share no line, one physics, over every effect in every mode.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "judge/known_gaps.hpp"
#include "judge/tally.hpp"

namespace freestand::test {
namespace {

// Two cases of every recipe, and those of walls five times.
TEST(Judge, AgreesWithTheKernelOnEveryEffectInEveryMode) {
  Tally tally;
  std::map<std::string, int> known;
  const std::vector<Recipe> all = recipes();
  for (std::uint64_t number = 0; number < 5 * all.size(); ++number) {
    const std::vector<std::string>& about = all[number % all.size()].effects;
    const bool with_wall = std::find(about.begin(), about.end(), "wall_impact") != about.end();
    if (number >= 2 * all.size() && !with_wall) continue;
    const JudgedCase c = judged_case(1, number);
    const Judgement judgement = judge(c);
    tally.add(c, judgement);
    if (judgement.finding != Finding::disagrees) continue;
    const std::string gap = known_gap(c, judgement);
    if (gap.empty())
      ADD_FAILURE() << c.text() << "\n  " << judgement.what;
    else
      ++known[gap];
  }
  std::printf("%s", tally.table().c_str());
  for (const auto& [gap, count] : known) std::printf("excused, %d: %s\n", count, gap.c_str());
  int excused = 0;
  for (const auto& [gap, count] : known) excused += count;
  EXPECT_LE(excused, 1);  // they may not grow
  EXPECT_THAT(tally.empty_cells(), testing::IsEmpty());
  EXPECT_GT(tally.total().compared, tally.total().samples * 9 / 10);
}

// Legs and a throw: SUNDIALS looks for the root on which it stands, finds none of its own on either side, and gives up.
TEST(Judge, TheReferenceGoesOnFromTheRoundOffOfASlipThatStarts) {
  const Judgement judgement = judge(judged_case(2, 208));
  EXPECT_EQ(judgement.finding, Finding::agrees) << judgement.what;
}

TEST(Judge, MakesTheSameCaseAgain) {
  EXPECT_EQ(judged_case(3, 77).text(), judged_case(3, 77).text());
  EXPECT_EQ(judged_case(3, 77).floor.horizontal_mps2, judged_case(3, 77).floor.horizontal_mps2);
  EXPECT_NE(judged_case(3, 77).text(), judged_case(4, 77).text());
}

}  // namespace
}  // namespace freestand::test
