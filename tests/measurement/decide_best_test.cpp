// Which candidate is called the best: its own table does not say otherwise.
#include <gtest/gtest.h>

#include <map>

#include "base/digits.hpp"
#include "effects/effects.hpp"
#include "measurement/made_candidates.hpp"
#include "support/keyed_random.hpp"

namespace freestand::measurement {
namespace {

// Chance does not part the two, and no more from the base: the best that is told leaves the least all the same.
TEST(Decide, WhereNothingHelpsTheBestIsTheOneOfLeastLeftOutError) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  Candidate odd = candidate(bench, {"friction_wear"}, 4.4, 2.1);
  odd.fit.model = with_effect(odd.fit.model, *effects::find("friction_wear"), bench.reach());
  odd.fit.x = {0.2, 0.01, 1e4};
  Diagnosis d = undecided(bench, 0);
  d.candidates = {candidate(bench, {"directional_friction"}, 4.6, 2.2), odd};
  d.chances = {chance(help_question, 0.126)};
  Questions ask = by_misfit();
  ask.lead = [](const Candidate&, const Candidate&) { return chance(lead_question, 1); };
  decide(bench, d, ask);
  EXPECT_EQ(d.verdict, Verdict::unknown);
  EXPECT_EQ(d.reason, Reason::none_helps);
  ASSERT_TRUE(d.best.has_value());
  EXPECT_EQ(d.candidates[*d.best].effects, std::vector<std::string>{"friction_wear"});
  ask.enough = [](const Candidate&) { return chance(misfit_question, 0.3); };
  d.sentences.clear();
  d.chances.resize(1);  // to be asked anew
  decide(bench, d, ask);
  EXPECT_EQ(d.verdict, Verdict::none);
  EXPECT_NE(d.sentences.at(0).find("the best, friction_wear, with numbers that are not met in practice, changes the "
                                   "left-out error from 5.50 to 4.40"),
            std::string::npos)
      << d.sentences.at(0);
}

// The fit that comes closest misses the tests left out by more than the base does: the next one is asked.
TEST(Decide, TheEffectThatHelpsNeedNotComeClosestInTheFit) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  const Diagnosis d = decided_among(
      bench, {candidate(bench, {"reduced_base"}, 9.4, 1.0), candidate(bench, {"impact_loss"}, 1.0, std::sqrt(1.001))});
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.effects, std::vector<std::string>{"impact_loss"});
}

// Of candidates whose errors are drawn: none that misses the tests left out by less than the best is passed over in silence.
TEST(Decide, WhatMissesByLessThanTheBestSaysWhyItIsNotNamed) {
  const Dataset data = cabinet_tests();
  const Bench bench(data, 0);
  const std::vector<std::vector<std::string>> models = {{"static_friction"},
                                                        {"rate_weakening"},
                                                        {"static_friction", "wall_impact"},
                                                        {"rate_weakening", "viscous_drag"},
                                                        {"static_friction", "wall_impact", "floor_tilt"}};
  std::map<Verdict, int> verdicts;
  int ahead = 0;
  for (std::uint64_t key = 0; key < 2000; ++key) {
    test::KeyedRandom random(61, key);
    Questions ask = by_misfit();
    const double p_another = random.unit(), p_lead = random.unit(), p_enough = random.unit();
    ask.another = [&](const Candidate&) { return chance(another_question, 0.1 * p_another); };
    ask.lead = [&](const Candidate&, const Candidate&) { return chance(lead_question, 0.1 * p_lead); };
    ask.enough = [&](const Candidate&) { return chance(misfit_question, 0.1 * p_enough); };
    Diagnosis d = undecided(bench, 0);
    d.base = candidate(bench, {}, 1 + random.unit(), 1 + 0.8 * random.unit());
    for (const auto& effects : models)
      d.candidates.push_back(candidate(bench, effects, 1 + random.unit(), 1 + 0.8 * random.unit()));
    Candidate& odd = d.candidates[1];
    odd.fit.model = with_effect(odd.fit.model, *effects::find("rate_weakening"), bench.reach());
    odd.fit.x = {0.356, 0.338, random.unit() < 0.5 ? 0.0008 : 0.08};
    decide(bench, d, ask);
    ++verdicts[d.verdict];
    if (!d.best) continue;
    const Candidate& best = d.candidates[*d.best];
    for (const Candidate& c : d.candidates)
      if (three_digits(c.fit.left_out[0].noise_units) < three_digits(best.fit.left_out[0].noise_units)) {
        ++ahead;
        EXPECT_FALSE(c.remark.empty() || c.rival) << key << ' ' << c.effects[0];
        EXPECT_NE(d.sentences.at(0).find(c.remark), std::string::npos) << d.sentences.at(0);
      }
  }
  EXPECT_GT(ahead, 100);
  for (const Verdict verdict : {Verdict::none, Verdict::missing, Verdict::ambiguous, Verdict::unknown})
    EXPECT_GT(verdicts[verdict], 20) << name(verdict);
}

}  // namespace
}  // namespace freestand::measurement
