// Chances of verdicts on outcomes: as often as they say, in made sets whose answer is known.
#include "measurement/verdict/chance_of_outcomes.hpp"

#include <gtest/gtest.h>

#include "effects/effects.hpp"
#include "measurement/made_outcomes.hpp"
#include "measurement/verdict/outcome_screen.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

const OutcomeEffort few_draws{.draws = 10};

// The base, and with each effect.
struct FittedToOutcomes {
  TabulatedFit base;
  std::vector<TabulatedFit> with;
};
FittedToOutcomes fitted_to_outcomes(const Bench& bench, const std::vector<std::string>& names) {
  std::vector<const dynamics::Effect*> effects;
  for (const std::string& name : names) effects.push_back(effects::find(name));
  FittedToOutcomes all{tabulate_outcomes(bench, rocking_model(true_size_m), {}, few_draws, run_here), {}};
  auto screened = screen_outcomes(bench, all.base.fit, effects, few_draws, run_here);
  std::vector<OutcomeTable*> tables;
  for (Screened& s : screened) tables.push_back(&s.table);
  all.with = tabulate_outcomes(bench, all.base.fit, tables, few_draws, run_here);
  return all;
}

Chance gain_of_any(const Bench& bench, const FittedToOutcomes& all) {
  std::vector<const TabulatedFit*> tried;
  for (const TabulatedFit& one : all.with) tried.push_back(&one);
  return chance_of_gain_of_outcomes(gains_of_outcomes(bench, all.base, tried, run_here));
}

// A set of outcomes is fitted by the row of least squares, whichever way these are summed.
TEST(ChanceOfOutcomes, RefitsAreThoseOfTheTable) {
  const Dataset data = made_outcomes(30, {});
  const Bench bench(data, 0);
  const TabulatedFit base = tabulate_outcomes(bench, rocking_model(true_size_m), {}, few_draws, run_here);
  Eigen::MatrixXf measured(30, 1);
  for (int t = 0; t < 30; ++t) measured(t, 0) = *data.tests[static_cast<std::size_t>(t)].peaks.overturned ? 1 : 0;
  const TableSearch search(bench, base.table);
  const std::vector<double> scores = search.scores();
  EXPECT_NEAR(search.least_squares(measured)[0] / 30, *std::min_element(scores.begin(), scores.end()), 1e-5);
}

// With nothing hidden an effect is said to help, and the model not to be enough, in one set of twenty. FREESTAND_REPEATS for more: of 60 sets, by
// two effects, 5 and 2.
TEST(ChanceOfOutcomes, HaveTheSizeOfChance) {
  const int sets = test::dear_repeats(5);
  int helped = 0, not_enough = 0;
  for (int key = 0; key < sets; ++key) {
    const Dataset data = made_outcomes(24, {}, 300 + static_cast<std::uint64_t>(key));
    const Bench bench(data, 0);
    const FittedToOutcomes all = fitted_to_outcomes(bench, {"offset_mass"});
    helped += !gain_of_any(bench, all).chance();
    not_enough += !chance_of_misfit(outcome_misfit(bench, all.base)).chance();
  }
  std::printf("of %d sets: an effect helps %d, not enough %d\n", sets, helped, not_enough);
  EXPECT_LE(helped, test::likely_counts(sets, 0.05).most);
  EXPECT_LE(not_enough, test::likely_counts(sets, 0.05).most);
}

// A mass that is off the middle falls to one side; losses at impacts do not.
TEST(ChanceOfOutcomes, WhatIsThereHelpsAndLeads) {
  const Dataset data = made_outcomes(100, {{effects::find("offset_mass"), {0.25}}});
  const Bench bench(data, 0);
  const FittedToOutcomes all = fitted_to_outcomes(bench, {"offset_mass", "impact_loss"});
  EXPECT_LT(gain_of_any(bench, all).p, 0.001);
  const Chance lead = chance_of_lead_of_outcomes(bench, all.with[0], all.with[1], run_here);
  EXPECT_LT(lead.p, 0.01);
  EXPECT_GT(lead.told_apart, 0.95);
  EXPECT_TRUE(chance_of_lead_of_outcomes(bench, all.with[1], all.with[0], run_here).chance());
}

}  // namespace
}  // namespace freestand::measurement
