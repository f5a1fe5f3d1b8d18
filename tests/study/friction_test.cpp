// What does not go with the friction that a study gives, and what holds a block higher than it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_text.hpp"

namespace freestand::study::friction_test {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string rest = motions + fragility + samples, effect = "effects: [{name: static_friction, ratio: 1.2}]\n";

// mu_s was lowered to 1.2 mu_k, without a word.
TEST(StudyFriction, StaticFrictionIsSaidOnce) {
  EXPECT_THAT(
      problems(block + "friction: {mu_k: 0.2, mu_s: 0.3}\n" + rest + effect),
      HasSubstr("some.yaml:2: friction.mu_s and effect static_friction are both given (one determines the other)"));
  EXPECT_THAT(problems(block + "friction: {mu_k: 0.2, static_ratio: {uniform: [1, 1.2]}}\n" + rest + effect),
              HasSubstr("friction.static_ratio and effect static_friction are both given"));
  EXPECT_EQ(problems(block + "friction: {mu_k: 0.2, static_ratio: 1}\n" + rest + effect), "");
}

TEST(StudyFriction, AChainHoldsABlockNoHigherThanItIs) {
  const std::string chain = "chain: {stiffness_npm: 1e4, strength_n: 2736, height_m: 1.8}\n";
  const auto found = [&](const char* height) {
    return problems(std::string("block: {width_m: 0.6, mass_kg: 100, height_m: ") + height + "}\n" + friction + rest +
                    chain);
  };
  EXPECT_THAT(found("{uniform: [1.6, 2]}"), HasSubstr("chain.height_m is up to 1.8, and the block as low as 1.6 m"));
  EXPECT_EQ(found("1.8"), "");
}

}  // namespace
}  // namespace freestand::study::friction_test
