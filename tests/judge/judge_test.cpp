// Two programs that share no line, one physics, over every effect in every mode.
#include <gtest/gtest.h>

#include "judge/tally.hpp"

namespace freestand::test {
namespace {

TEST(Judge, AgreesWithTheKernelOnEveryEffectInEveryMode) {
  Tally tally;
  for (std::uint64_t number = 0; number < 2 * recipes().size(); ++number) {
    const JudgedCase c = judged_case(1, number);
    const Judgement judgement = judge(c);
    tally.add(c, judgement);
    EXPECT_NE(judgement.finding, Finding::disagrees) << c.text() << "\n  " << judgement.what;
  }
  EXPECT_THAT(tally.empty_cells(), testing::IsEmpty());
}

}  // namespace
}  // namespace freestand::test
