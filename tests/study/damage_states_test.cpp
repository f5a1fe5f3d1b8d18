// Damage states and capacities that are distributions, against probabilities in closed form.
#include "study/damage_states.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/response.hpp>
#include <numeric>

#include "study/known.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"

namespace freestand::study::damage_states_test {
namespace {

const double nan = std::nan("");

Study study(const std::string& fragility, const std::string& more = "") {
  return parse_study(test::block + test::friction + test::motions + "samples: 20000\nfragility:\n" + fragility + more,
                     "s.yaml", registries());
}

Table rows(std::size_t n, double slip) {
  Table table{{{"edp_peak_slip_m", "m", ""}, {"edp_overturned", "1", ""}, {"outcome", "1", ""}}, {}};
  for (std::size_t i = 0; i < n; ++i)
    table.values.insert(table.values.end(), {slip, 0, static_cast<double>(Outcome::moved)});
  return table;
}

double share(const Table& table, const std::string& column) {
  const std::size_t at = column_index(table.columns, column);
  double sum = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) sum += table.at(row, at);
  return sum / static_cast<double>(table.rows());
}

TEST(DamageStates, AnOverturnedBlockIsBeyondEveryCapacityAndAFailedSampleHasNoState) {
  const DamageStates states(
      study("  edp: [overturned]\n  damage: {door: peak_slip_m > 0.1, near: peak_slip_m < 0.1, "
            "both: peak_slip_m > 0.1 or overturned}\n"));
  Table table{rows(1, 0.2).columns, {0.2, 0, 1, 0.05, 0, 1, nan, 1, 2, nan, 0, 1}};
  states.append(table, 0);
  ASSERT_EQ(table.columns.size(), 6U);
  EXPECT_EQ(table.columns[3].name, "edp_door");
  const auto column = [&](std::size_t c) {
    return std::vector{table.at(0, c), table.at(1, c), table.at(2, c), table.at(3, c)};
  };
  const auto is = [](std::vector<double> values) {
    return testing::Pointwise(testing::NanSensitiveDoubleEq(), std::move(values));
  };
  EXPECT_THAT(column(3), is({1, 0, 1, nan}));
  EXPECT_THAT(column(4), is({0, 1, 0, nan}));
  EXPECT_THAT(column(5), is({1, 0, 1, nan}));
  const auto options = states.edps();
  ASSERT_EQ(options.size(), 3U);
  EXPECT_TRUE(options[0].binary && !options[0].censored);
  EXPECT_EQ(options[0].name, "door");
}

TEST(DamageStates, ThoseThatHoldForEveryBlockThatOverturnedAreNamed) {
  const DamageStates states(study(
      "  edp: [overturned]\n  damage: {door: peak_slip_m > 0.1, near: peak_slip_m < 0.1, both: peak_slip_m > 0.1 or "
      "overturned, stays: residual_slip_m > 0.1 and not overturned, broken: connection_failed or peak_slip_m < 0.1, "
      "any: "
      "connection_failed or overturned}\n",
      "chain: {stiffness_npm: 1e4, strength_n: 2736, wall_gap_m: 0.1}\n"));
  EXPECT_THAT(states.with_overturned(), testing::ElementsAre("door", "both", "any"));
}

// Beyond every capacity by two demands, their difference is none: a condition must say what an overturned block is.
TEST(DamageStates, WhatIsDefinedForOverturnedBlocksIsTaken) {
  for (const char* open : {"peak_slip_m - residual_slip_m > 0.03", "residual_slip_m / peak_slip_m > 0.5"})
    EXPECT_THAT(freestand::test::error_text(
                    Exit::usage, [&] { study(fmt::format("  edp: [overturned]\n  damage: {{door: {}}}\n", open)); }),
                testing::HasSubstr("door is not defined for a block that overturned"))
        << open;
  EXPECT_NO_THROW(
      study("  edp: [overturned]\n  damage: {a: peak_slip_m - residual_slip_m > 0.03 or overturned, b: peak_slip_m - "
            "residual_slip_m > 0.03 and not overturned, c: peak_slip_m > 0.1 and residual_slip_m > 0.05}\n"));
}

// P(d > C) of a lognormal capacity is Phi(ln(d/median)/dispersion). With 20000 independent draws its standard error is at
// most 0.0036, here 4.5 of them.
TEST(DamageStates, ACapacityThatIsADistributionIsExceededAsOftenAsItSays) {
  const std::string capacity = "{lognormal: {median: 0.05, dispersion: 0.4}}";
  const DamageStates states(study("  capacities: {peak_slip_m: [0.1, " + capacity +
                                  "]}\n  damage: {hits: {when: \"peak_slip_m "
                                  "> gap_m or overturned\", parameters: {gap_m: " +
                                  capacity + "}}}\n"));
  for (const double slip : {0.03, 0.05, 0.08}) {
    Table table = rows(20000, slip);
    states.append(table, 0);
    const double expected = 0.5 * std::erfc(-std::log(slip / 0.05) / 0.4 / std::sqrt(2.0));
    EXPECT_NEAR(share(table, "edp_peak_slip_m_over_capacity_1"), expected, 0.016) << slip;
    EXPECT_NEAR(share(table, "edp_hits"), expected, 0.016) << slip;
    // Two states draw for themselves: together as often as two independent ones.
    const std::size_t a = column_index(table.columns, "edp_peak_slip_m_over_capacity_1"),
                      b = column_index(table.columns, "edp_hits");
    double both = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) both += table.at(row, a) * table.at(row, b);
    EXPECT_NEAR(both / 20000, expected * expected, 0.016) << slip;
  }
}

TEST(DamageStates, AreDrawnBySampleWhateverTheBlock) {
  const DamageStates states(
      study("  damage: {hits: {when: peak_slip_m > gap_m, parameters: {gap_m: {uniform: [0, 1]}}}}\n"));
  Table whole = rows(100, 0.5), part = rows(30, 0.5);
  states.append(whole, 0);
  states.append(part, 40);
  for (std::size_t row = 0; row < 30; ++row) EXPECT_EQ(part.at(row, 3), whole.at(40 + row, 3));
}

TEST(DamageStates, StandInTheExpandedStudyAndChangeNoSample) {
  const Study with = study(
      "  capacities: {peak_slip_m: [{lognormal: {median: 0.05, dispersion: 0.4}}]}\n"
      "  damage: {door: \"peak_slip_m > 0.1 or overturned\"}\n");
  const std::string text = expanded(with);
  EXPECT_THAT(text, testing::HasSubstr("when: peak_slip_m > 0.1 or overturned"));
  EXPECT_THAT(text, testing::HasSubstr("peak_slip_m_over_capacity_1:"));
  EXPECT_EQ(expanded(parse_study(text, "s.yaml", registries())), text);
  EXPECT_EQ(samples_fingerprint(with), samples_fingerprint(study("  edp: [overturned]\n")));
}

}  // namespace
}  // namespace freestand::study::damage_states_test
