#include "formula/condition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace freestand::formula {
namespace {

const std::vector<Condition::Name> names = {{"slip_m"}, {"order_m"}, {"overturned", true}, {"hit", true}};

// slip 0.3, order 2.
bool holds(const std::string& text, bool overturned = false, bool hit = false) {
  const double values[] = {0.3, 2, overturned ? 1.0 : 0.0, hit ? 1.0 : 0.0};
  return Condition(text, names).holds(values);
}

std::string problem(const std::string& text) {
  try {
    Condition(text, names);
  } catch (const FormulaError& error) {
    return std::to_string(error.position()) + " " + error.what();
  }
  return "";
}

TEST(Condition, OperatorsBindAsTheyRead) {
  EXPECT_TRUE(holds("slip_m > 0.1"));
  EXPECT_FALSE(holds("slip_m > 0.1 and overturned"));
  EXPECT_TRUE(holds("slip_m > 0.5 or overturned", true));
  EXPECT_TRUE(holds("slip_m > 0.5 and hit or order_m > 1"));  // (.. and ..) or ..
  EXPECT_FALSE(holds("slip_m > 0.5 and (hit or order_m > 1)"));
  EXPECT_TRUE(holds("not slip_m > 0.5"));  // not (slip > 0.5), and not (not slip) > 0.5
  EXPECT_TRUE(holds("not overturned and hit", false, true));
  EXPECT_FALSE(holds("not (overturned or hit)", false, true));
  EXPECT_TRUE(holds("slip_m + 0.1 > 0.2*2 - 0.1"));
  EXPECT_TRUE(holds("slip_m>=0.3 && order_m<=2 && order_m==2 && slip_m!=2"));
  EXPECT_TRUE(holds("max(slip_m, abs(-order_m)) > 1.9"));
  EXPECT_TRUE(holds("overturned", true));
  EXPECT_FALSE(holds("overturned"));
}

// What the integer arithmetic of all 16 combinations says, for each way to write it.
TEST(Condition, LogicIsThatOfItsTruthTable) {
  for (int bits = 0; bits < 4; ++bits) {
    const bool a = bits & 1, b = bits & 2;
    EXPECT_EQ(holds("overturned and hit", a, b), a && b);
    EXPECT_EQ(holds("overturned or hit", a, b), a || b);
    EXPECT_EQ(holds("not overturned or hit", a, b), !a || b);
    EXPECT_EQ(holds("not (overturned and not hit)", a, b), !(a && !b));
    EXPECT_EQ(holds("overturned != hit", a, b), a != b);
  }
}

TEST(Condition, TellsWhatItLooksAt) {
  EXPECT_THAT(Condition("hit or slip_m > 1", names).uses(), testing::ElementsAre(0, 3));
}

TEST(Condition, MistakesAreToldWithTheirPlace) {
  EXPECT_EQ(problem("slip_m > 0.1 or tilt > 2"), "16 \"tilt\" is not known here");
  EXPECT_EQ(problem("slip_m"), "0 it is a number and no condition, compare it with something");
  EXPECT_EQ(problem("(slip_m > 1) + (order_m > 1)"), "0 it is a number and no condition, compare it with something");
  EXPECT_THAT(problem("slip_m = 1"), testing::StartsWith("7 \"=\" is not known here"));
  EXPECT_THAT(problem("hit & overturned"), testing::HasSubstr("`and` is"));
  EXPECT_THAT(problem("slip_m > 1,"), testing::Not(""));
  EXPECT_THAT(problem("slip_m > 1, hit"), testing::HasSubstr("more than one value"));
  EXPECT_THAT(problem(""), testing::HasSubstr("empty"));
  EXPECT_THAT(problem("slip_m >"), testing::HasSubstr("ends too early"));
  EXPECT_THAT(problem("hit ? 1 : 0"), testing::HasSubstr("`and` and `or` are"));
}

}  // namespace
}  // namespace freestand::formula
