// Numbers of a study as columns of a table of joint draws.
#include "study/posterior_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "study/doubts.hpp"
#include "study/evaluator.hpp"
#include "study/known.hpp"
#include "study/realise.hpp"
#include "study/sampled.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::posterior_tables_test {
namespace {

using namespace test;

class PosteriorTables : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "draws.csv") << "# three draws\nfriction.mu,effects.floor_tilt.angle_rad\n"
                                            "0.2,0.03\n0.3,0.01\n0.4,0.02\n";
  }
  std::string text(const std::string& mu, const std::string& angle) const {
    return block + "friction: {mu: " + mu + "}\neffects: [{name: floor_tilt, angle_rad: " + angle + "}]\n" + motions +
           "samples: 3000\n" + fragility;
  }
  Study read(const std::string& content, FittedAs fitted = FittedAs::draws) const {
    return parse_study(content, folder_ / "s.yaml", known(), Files::look, fitted);
  }
  std::string problems(const std::string& content) const {
    return freestand::test::error_text(Exit::usage, [&] { read(content); });
  }
  std::string drawn() const {
    return text("{posterior: draws.csv, column: friction.mu}",
                "{posterior: draws.csv, column: effects.floor_tilt.angle_rad}");
  }
  freestand::test::Scratch folder_{"posterior_tables"};
};

TEST_F(PosteriorTables, ARowStaysTogetherAndAllAreAlikeLikely) {
  const Study study = read(drawn());
  const Realiser realise(study, load_motions(study));
  const std::map<double, double> rows = {{0.2, 0.03}, {0.3, 0.01}, {0.4, 0.02}};
  std::map<double, int> count;
  for (std::uint64_t s = 0; s < 3000; ++s) {
    const Realisation r = realise(s);
    const double mu = r.specimen.friction.mu_k;
    ASSERT_EQ(r.specimen.effects.at(0).parameters.at(0), rows.at(mu));
    ++count[mu];
  }
  for (const auto& [mu, n] : count) EXPECT_NEAR(n, 1000, 5) << mu;  // a Sobol sequence
}

TEST_F(PosteriorTables, DrawsOfAModelThatLacksSomethingAreDoubtful) {
  EXPECT_TRUE(read(drawn()).doubtful_draws.empty());
  measurement::ModelSpec model;
  model.free = {{.name = "friction.mu"}};
  measurement::Posterior open;
  open.draws = {{0.2}, {0.3}};
  open.leaves_too_much = true;
  std::ofstream(folder_ / "draws.csv") << posterior_text(model, open);
  const Study study = read(text("{posterior: draws.csv, column: friction.mu}", "0.01"));
  ASSERT_EQ(study.doubtful_draws.size(), 1u);
  EXPECT_NE(study.doubtful_draws[0].find("draws.csv holds draws of a model that leaves more"), std::string::npos);
  const std::vector<std::string> all = doubts(study);
  EXPECT_EQ(std::count(all.begin(), all.end(), study.doubtful_draws[0]), 1);
}

// Numbers of one row are dependent: no one of them is an input, the table is, and its rows that differ are its classes.
TEST_F(PosteriorTables, ATableIsOneInput) {
  std::ofstream(folder_ / "draws.csv") << "friction.mu,effects.floor_tilt.angle_rad,factor\n"
                                          "0.2,0.03,0.7\n0.3,0.01,0.7\n0.2,0.03,0.6\n0.4,0.01,0.6\n";
  const Study study = read(drawn());
  const std::vector<Sampled> all = sampled(study, 1);
  ASSERT_EQ(all[0].parameter.name, "friction.mu with effects.floor_tilt.angle_rad (drawn together)");
  EXPECT_EQ(all[0].streams, std::vector<std::string>{"posterior.draws.csv"});
  EXPECT_EQ(all[0].parameter.classes, 3);
  EXPECT_FALSE(all[0].parameter.ordered);
  for (const Sampled& one : all) EXPECT_EQ(one.parameter.name.find("angle_rad") == std::string::npos, &one != &all[0]);
  const Realiser realise(study, load_motions(study));
  std::map<int, double> mu_of;
  for (std::uint64_t s = 0; s < 200; ++s) {
    const double mu = realise(s).specimen.friction.mu_k;
    EXPECT_EQ(mu_of.try_emplace(all[0].class_of(s, 0), mu).first->second, mu);
  }
  EXPECT_EQ(mu_of.size(), 3U);

  // Of one column the values are classes, in their order.
  const std::vector<Sampled> one = sampled(read(text("{posterior: draws.csv, column: friction.mu}", "0.01")), 1);
  EXPECT_EQ(one[0].parameter.name, "friction.mu");
  EXPECT_TRUE(one[0].parameter.ordered);
}

// A pulse may take its amplitude from the table that friction is of.
TEST_F(PosteriorTables, ATableOfTheModelAndOfTheMotionsIsOneInput) {
  const Study study = read(block +
                           "friction: {mu: {posterior: draws.csv, column: friction.mu}}\nmotions: [{pulse: B, "
                           "period_s: {posterior: draws.csv, column: effects.floor_tilt.angle_rad}, "
                           "peak_acceleration_g: {uniform: [0.1, 2]}}]\nsamples: 300\n" +
                           fragility);
  std::vector<std::string> names;
  for (const Sampled& one : sampled(study, 1)) names.push_back(one.parameter.name);
  EXPECT_EQ(names, (std::vector<std::string>{"friction.mu with motion.period_s (drawn together)",
                                             "motion.peak_acceleration_g"}));
}

TEST_F(PosteriorTables, TheExpandedStudyCarriesTheDraws) {
  const Study study = read(drawn());
  const std::string all = expanded(study);
  EXPECT_NE(all.find("values: [0.2, 0.3, 0.4]"), std::string::npos) << all;
  std::filesystem::remove(folder_ / "draws.csv");
  EXPECT_EQ(expanded(read(all)), all);
  EXPECT_EQ(expanded(parse_stored(all, folder_ / "s.yaml")), all);
}

TEST_F(PosteriorTables, WhatWasFittedIsDrawnOrAtItsBest) {
  const std::string fitted =
      "model:\n  friction: {mu: {calibrate: [0.1, 1], value: 0.31, interval: [0.2, 0.4], posterior: draws.csv, "
      "column: friction.mu}}\n  block: {width_m: 0.6, height_m: 1.8, mass_kg: 150}\n" +
      motions + "samples: 300\n" + fragility;
  const auto mu = [](const Study& study) { return study.model.friction.mu->value; };
  EXPECT_TRUE(std::holds_alternative<sampling::Posterior>(mu(read(fitted))));
  ASSERT_TRUE(is_fixed(mu(read(fitted, FittedAs::best))));
  EXPECT_EQ(std::get<sampling::Fixed>(mu(read(fitted, FittedAs::best))).value, 0.31);
}

// Outcomes are judged by a width that scatters from test to test: so it does from sample to sample of a sweep, about the number of the
// study or the one that was fitted. Joint draws of a width hold the scatter already.
TEST_F(PosteriorTables, PlacementsScatterInASweepAsInTheFit) {
  const auto width = [&](const std::string& block, const std::string& scatter, FittedAs as) {
    const std::string study = "model:\n  friction: {mu: 0.3}\n  placement_scatter: " + scatter + "\n  block: {" +
                              block + "height_m: 1.8, mass_kg: 150}\n" + motions + "samples: 300\n" + fragility;
    return read(study, as).model.block.width->value;
  };
  const auto expect_spread = [](const sampling::Distribution& found, double median) {
    ASSERT_TRUE(std::holds_alternative<sampling::Lognormal>(found));
    EXPECT_EQ(std::get<sampling::Lognormal>(found).median, median);
    EXPECT_EQ(std::get<sampling::Lognormal>(found).dispersion, 0.17);
  };
  const std::string fitted =
      "{calibrate: [0.001, 0.5], value: 0.17, interval: [0.1, 0.2], posterior: draws.csv, column: s}";
  const std::string drawn = "width_m: {calibrate: [0.1, 1], value: 0.5, posterior: draws.csv, column: friction.mu}, ";
  for (const FittedAs as : {FittedAs::draws, FittedAs::best}) {
    expect_spread(width("width_m: 0.6, ", "0.17", as), 0.6);
    expect_spread(width("width_m: 0.6, ", fitted, as), 0.6);
  }
  EXPECT_TRUE(std::holds_alternative<sampling::Posterior>(width(drawn, fitted, FittedAs::draws)));
  // At the best a known width scatters by the best scatter, also where the table holds placements of it.
  const std::string placed =
      "{calibrate: [0.001, 0.5], value: 0.17, posterior: draws.csv, column: s, placed: block.width_m}";
  expect_spread(width("width_m: 0.6, ", placed, FittedAs::best), 0.6);
  expect_spread(width(drawn, fitted, FittedAs::best), 0.5);
}

// Shares of variance of the one number that is drawn from a table go by classes of its values, whatever the order of the rows.
TEST_F(PosteriorTables, ClassesGoByValue) {
  const Study study = read(text("0.3", "{posterior: draws.csv, column: effects.floor_tilt.angle_rad}"));
  for (const Sampled& one : sampled(study, 1)) {
    if (one.parameter.name != "effects.floor_tilt.angle_rad") continue;
    const Realiser realise(study, load_motions(study));
    std::map<double, int> of;
    for (std::uint64_t s = 0; s < 100; ++s) of[realise(s).specimen.effects.at(0).parameters.at(0)] = one.class_of(s, 0);
    EXPECT_LT(of.at(0.01), of.at(0.02));
    EXPECT_LT(of.at(0.02), of.at(0.03));
    return;
  }
  FAIL() << "not sampled";
}

TEST_F(PosteriorTables, MistakesAreTold) {
  EXPECT_NE(problems(text("{posterior: nowhere.csv, column: friction.mu}", "0")).find("--best"), std::string::npos);
  EXPECT_NE(problems(text("{posterior: draws.csv, column: friction.nu}", "0")).find("has no column friction.nu"),
            std::string::npos);
  EXPECT_NE(problems(text("{posterior: draws.csv}", "0")).find("has no column"), std::string::npos);
  std::ofstream(folder_ / "draws.csv") << "friction.mu\n0.2\nnan\n";
  EXPECT_NE(problems(text("{posterior: draws.csv, column: friction.mu}", "0")).find("draws.csv:3"), std::string::npos);
  std::ofstream(folder_ / "draws.csv") << "friction.mu\n0.2\n-0.1\n";
  EXPECT_NE(problems(text("{posterior: draws.csv, column: friction.mu}", "0")).find("impossible"), std::string::npos);
}

// Slips are multiplied, and nothing else.
TEST(Discrepancy, MultipliesSlips) {
  const std::string plain =
      block + friction + samples + fragility + "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: 1.5}]\n";
  const auto row = [](const std::string& text, const char* column) {
    const Study study = parse(text);
    const Evaluator evaluate(study, load_motions(study));
    std::vector<double> values;
    evaluate.append(7, values);
    return values.at(column_index(evaluate.columns(), column));
  };
  const std::string twice = plain + "discrepancy: {slip: 2}\n";
  ASSERT_GT(row(plain, "edp_peak_slip_m"), 0);
  for (const char* slip : {"edp_peak_slip_m", "edp_residual_slip_m", "edp_slid_path_m", "edp_delta"})
    EXPECT_EQ(row(twice, slip), 2 * row(plain, slip)) << slip;
  for (const char* other : {"edp_peak_rotation_over_alpha", "edp_peak_acceleration_g", "pta_g"})
    EXPECT_EQ(row(twice, other), row(plain, other)) << other;
  EXPECT_NE(expanded(parse(twice)).find("discrepancy: {slip: 2}"), std::string::npos);
  EXPECT_NE(problems(plain + "discrepancy: {slip: -1}\n"), "");
  const std::string alone = "motion: {pulse: B, period_s: 0.5, peak_acceleration_g: 0.6}\n";
  EXPECT_NE(case_problems(block + friction + alone + "discrepancy: {slip: 2}\n").find("a case is the model"),
            std::string::npos);
}

}  // namespace
}  // namespace freestand::study::posterior_tables_test
