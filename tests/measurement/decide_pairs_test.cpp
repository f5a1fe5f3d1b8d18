// One effect, or two and three: on candidates whose errors are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measurement/made_candidates.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {
namespace {

// A pair is named where one more effect helps beside the better of its two, all that were tried counted, by more than chance does in a hundredth of
// the sets with one effect: a wrong name, there, is to be rarer than an effect that is named where there is none.
TEST(DecideOnPairs, APairIsNamedWhereOneMoreEffectHelps) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  for (const double p : {0.0099, 0.0101}) {
    Questions ask = by_misfit();
    ask.another = [&](const Candidate& part) {
      EXPECT_EQ(part.effects, (std::vector<std::string>{"static_friction"}));
      return chance(another_question, p);
    };
    const Diagnosis d =
        decided_among(bench,
                      {with_errors(bench, {"static_friction", "wall_impact"}, {1.0, 1.02, 1.01, 1.0}, 1.0),
                       with_errors(bench, {"static_friction"}, {1.01, 1.02, 1.2, 1.0}, 1.05),
                       with_errors(bench, {"wall_impact"}, {2, 2, 3, 2}, 2.5)},
                      ask);
    EXPECT_EQ(d.verdict, Verdict::missing);
    EXPECT_EQ(d.effects.size(), p < further_level ? 2u : 1u) << p;
  }
}

// A width 2 % off: the reduced base suited the tests better than the offset mass that was there, and a pair of both explained them.
TEST(DecideOnPairs, OneEffectThatIsEnoughWithinTolerancesComesBeforePairs) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  Questions ask = by_misfit();
  const auto by_itself = [](const Candidate& c) { return c.effects == std::vector<std::string>{"offset_mass"}; };
  ask.enough = [&](const Candidate& c) {
    Chance enough = chance(misfit_question, by_itself(c) || c.effects.size() == 2 ? 0.4 : 0.001);
    enough.within_tolerances = by_itself(c);
    return enough;
  };
  ask.another = [&](const Candidate& c) { return chance(another_question, by_itself(c) ? 0.5 : 0.001); };
  const Diagnosis d = decided_among(
      bench,
      {candidate(bench, {"reduced_base", "offset_mass"}, 1.2, 1.0),
       candidate(bench, {"reduced_base", "floor_tilt"}, 1.3, 1.9), candidate(bench, {"reduced_base"}, 2, 2),
       candidate(bench, {"offset_mass"}, 2.5, 2.5), candidate(bench, {"floor_tilt"}, 2.6, 2.6)},
      ask);
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.effects, std::vector<std::string>{"offset_mass"}) << testing::PrintToString(d.sentences);
  const auto remark = [&](const std::vector<std::string>& effects) {
    return std::ranges::find(d.candidates, effects, &Candidate::effects)->remark;
  };
  EXPECT_EQ(remark({"reduced_base"}), leaves_more);
  EXPECT_EQ(remark({"reduced_base", "offset_mass"}), stands_for_tolerances);
}

// And three, beside the best of the pairs that are part of them.
TEST(DecideOnPairs, ThreeEffectsAreNamedWhereTheThirdHelps) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  const std::vector<std::string> three = {"static_friction", "wall_impact", "floor_tilt"};
  const Diagnosis d = decided_among(
      bench, {candidate(bench, three, 1.0, 1.0), candidate(bench, {"static_friction", "wall_impact"}, 1.6, 1.6),
              candidate(bench, {"static_friction"}, 2.2, 2.2)});
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.effects, three);
}

// What a pair gains on one effect alone counts by tests as well.
TEST(DecideOnPairs, APairIsNotNamedOverOneOfItsEffectsThatIsAsGood) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  const Diagnosis d =
      decided_among(bench, {with_errors(bench, {"static_friction", "viscous_drag"}, {1.0, 1.4, 1.05, 1.1}, 1.0),
                            with_errors(bench, {"static_friction"}, {1.02, 1.2, 1.1, 1.05}, std::sqrt(1.06))});
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.effects, (std::vector<std::string>{"static_friction"}));
}

}  // namespace
}  // namespace freestand::measurement
