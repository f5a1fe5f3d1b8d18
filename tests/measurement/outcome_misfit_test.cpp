// Is a model enough for outcomes: as often as it says in sets drawn from known probabilities, and both ways in which one is not.
#include "measurement/fit/outcome_misfit.hpp"

#include <gmock/gmock.h>

#include "measurement/made_outcomes.hpp"
#include "measurement/tell/compare.hpp"
#include "measurement/verdict/diagnose_outcomes.hpp"
#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<bool> first_fell(std::size_t tests, std::size_t fell) {
  std::vector<bool> all(tests, false);
  std::fill_n(all.begin(), fell, true);
  return all;
}

// 40 tests with a chance of 0.35 each, of which 14 +- 3.0 fall. Four that fall leave a score of (4 0.65^2 + 36 0.35^2)/40 = 0.1525, below the
// 0.2275 of chance; P(at most 4) = 1.5e-4, and the other side has less than 3e-4.
TEST(OutcomeMisfit, HowManyFellCountsBesideTheScore) {
  const Values p(40, 0.35);
  const OutcomeMisfit few = outcome_misfit(p, first_fell(40, 4));
  EXPECT_NEAR(few.score, 0.1525, 1e-12);
  EXPECT_NEAR(few.usual_score, 0.2275, 0.004);
  EXPECT_GT(few.of_score, 0.9);
  EXPECT_NEAR(few.expected, 14, 1e-9);
  EXPECT_NEAR(few.count_scatter, std::sqrt(40 * 0.2275), 0.2);
  EXPECT_LT(few.p, 0.005);
  EXPECT_TRUE(few.other_count());
  EXPECT_FALSE(few.surer());
  EXPECT_THAT(what_chance_leaves(few), HasSubstr("too unstable: 4 tests overturned where it expects 14.0 +- 3"));
  EXPECT_FALSE(outcome_misfit(p, first_fell(40, 24)).chance());
  EXPECT_TRUE(outcome_misfit(p, first_fell(40, 13)).chance());
}

// As many fell as expected, but not those.
TEST(OutcomeMisfit, OneThatIsSurerThanItMayBe) {
  const OutcomeMisfit wrong = outcome_misfit({0.1, 0.9, 0.1, 0.9, 0.1, 0.9}, {true, false, true, false, false, true});
  EXPECT_TRUE(wrong.surer());
  EXPECT_FALSE(wrong.other_count());
  EXPECT_TRUE(outcome_misfit({0.1, 0.9, 0.1, 0.9}, {false, true, false, true}).chance());
  EXPECT_EQ(what_chance_leaves(outcome_misfit({0.1, 0.9}, {false, true})), "");
}

// Of sets from the very probabilities one in twenty has p <= 0.05: all but as many where scores are many, fewer where they are few
// (eight tests with a chance of 0.02, far from normal).
TEST(OutcomeMisfit, HasItsSize) {
  const int sets = test::repeats_asked(400);
  struct Case {
    Values probability;
    bool steps;
  };
  Values spread;
  for (int t = 0; t < 30; ++t) spread.push_back((t + 0.5) / 30);
  for (const auto& [p, steps] : {Case{spread, false}, Case{Values(40, 0.35), true}, Case{Values(8, 0.02), true}}) {
    int rejected = 0;
    for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
      test::KeyedRandom random(71, key);
      std::vector<bool> fell;
      for (const double chance : p) fell.push_back(random.chance(chance));
      rejected += !outcome_misfit(p, fell).chance();
    }
    EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most) << p.size();
    if (!steps) {
      EXPECT_GE(rejected, test::likely_counts(sets, 0.05).least);
    }
  }
}

// Numbers that are open move all tests together: how many fall scatters by more than were each by itself.
TEST(OutcomeMisfit, DrawsMoveAllTestsTogether) {
  const int sets = test::repeats_asked(300);
  const std::vector<Values> draws = {Values(30, 0.2), Values(30, 0.4), Values(30, 0.6), Values(30, 0.8)};
  const Values mean(30, 0.5);
  int rejected = 0, as_if_known = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key) {
    test::KeyedRandom random(72, key);
    const Values& p = draws[key % draws.size()];
    std::vector<bool> fell;
    for (const double chance : p) fell.push_back(random.chance(chance));
    rejected += !outcome_misfit(mean, fell, draws).chance();
    as_if_known += !outcome_misfit(mean, fell).chance();
  }
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
  EXPECT_GT(as_if_known, sets / 3);
}

// Those of 60 tests fall that the model is surest of, and no other: a score that is smaller than chance makes it, and fewer than it expects.
// Compare tells how many, and the diagnosis, of the same numbers, does not say that nothing is missing.
TEST(OutcomeMisfit, CompareAndDiagnoseSayTheSameOfAModelThatIsBiased) {
  ModelSpec slender = rocking_model(true_size_m);
  slender.slenderness = Number{.value = true_slenderness};
  slender.placement_scatter = Number{.value = 0.5};
  slender.free.clear();
  Dataset data = made_outcomes(60, {}, 9, 0.3);
  const Values expected =
      overturning_probabilities(Bench(data, 0), tests_of(data, Role::calibration), slender, Values{});
  for (std::size_t t = 0; t < data.tests.size(); ++t) data.tests[t].peaks.overturned = expected[t] > 0.7;
  const Bench bench(data, 0);
  OutcomeEffort effort;
  effort.draws = 10;
  const Diagnosis d = diagnose_outcomes(bench, slender, {}, {}, effort, run_here);
  EXPECT_EQ(d.verdict, Verdict::unknown);
  EXPECT_EQ(d.reason, Reason::none_helps);
  EXPECT_THAT(d.sentences, Contains(HasSubstr("too unstable")));

  std::vector<TestComparison> tests;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    tests.push_back({.test = i, .error = d.base.fit.calibration[i]});
    tests.back().model = predict(slender, bench.test(i), {});
  }
  const auto said = compare(bench, slender, {}, tests, {}).findings;
  EXPECT_THAT(said,
              Contains(HasSubstr("chance explains that score, but not how many overturned: something is missing")));
  EXPECT_THAT(said, Contains(HasSubstr("it is too unstable")));
}

}  // namespace
}  // namespace freestand::measurement
