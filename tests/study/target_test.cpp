// Samples that stay are distributed as the target wants, and are told apart by their number alone.
#include "study/target.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "study/realise.hpp"
#include "study_text.hpp"

namespace freestand::study::target_test {
namespace {

using namespace test;
using testing::HasSubstr;

std::string swept(const std::string& friction, const std::string& target, const std::string& more = "") {
  return block + "friction: {mu: " + friction + "}\nsamples: 40000\ndesign: monte_carlo\n" + motions +
         "fragility: {edp: [overturned], " + more + "target: {" + target + "}}\n";
}

// The draws that stay, increasing.
std::vector<double> kept(const Study& study, const std::string& column) {
  const Target target(study);
  const Realiser realise(study, load_motions(study));
  const std::size_t place = column_index(realise.draw_columns(), column);
  std::vector<double> draws;
  for (std::uint64_t i = 0; i < study.samples; ++i)
    if (target.keeps(i)) draws.push_back(realise(i).draws[place]);
  std::sort(draws.begin(), draws.end());
  // As many as are told: within 4 standard deviations of a binomial count.
  const double share = target.kept_share(), n = static_cast<double>(study.samples);
  EXPECT_NEAR(static_cast<double>(draws.size()), share * n, 4 * std::sqrt(n * share * (1 - share)) + 1e-6);
  return draws;
}

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

template <class Cdf>
double largest_difference(const std::vector<double>& draws, const Cdf& cdf) {
  double largest = 0;
  const auto n = static_cast<double>(draws.size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const double p = cdf(draws[i]), rank = static_cast<double>(i);
    largest = std::max({largest, std::abs(p - rank / n), std::abs(p - (rank + 1) / n)});
  }
  return largest * std::sqrt(n);
}

// Kolmogorov: sqrt(n) S above 1.95 has probability 0.001.
TEST(Target, WhatStaysIsDistributedAsWanted) {
  const auto lognormal = [](double x) { return normal_cdf(std::log(x / 0.3) / 0.2); };
  EXPECT_LT(largest_difference(
                kept(parse(swept("{uniform: [0.05, 1.2]}", "friction.mu: {lognormal: {median: 0.3, dispersion: 0.2}}")),
                     "friction_mu"),
                lognormal),
            1.95);
  EXPECT_LT(largest_difference(kept(parse(swept("{lognormal: {median: 0.3, dispersion: 0.5}}",
                                                "friction.mu: {lognormal: {median: 0.3, dispersion: 0.2}}")),
                                    "friction_mu"),
                               lognormal),
            1.95);
  EXPECT_LT(largest_difference(kept(parse(swept("{triangular: [0.1, 0.2, 0.9]}", "friction.mu: {uniform: [0.3, 0.5]}")),
                                    "friction_mu"),
                               [](double x) { return std::clamp((x - 0.3) / 0.2, 0.0, 1.0); }),
            1.95);
}

TEST(Target, OfAnIntensityThatTheMotionIsScaledTo) {
  Study study = parse(block + friction + "samples: 20000\ndesign: monte_carlo\n" +
                      "motions: [{pulse: B, period_s: 0.5, scale_to: {pga_g: {uniform: [0.1, 2]}}}]\n" +
                      "fragility: {edp: [overturned], target: {motion.pga_g: {uniform: [0.5, 1]}}}\n");
  const Target target(study);
  const Realiser realise(study, load_motions(study));
  int kept = 0;
  for (std::uint64_t i = 0; i < study.samples; ++i) {
    if (!target.keeps(i)) continue;
    ++kept;
    EXPECT_GT(realise(i).pta_g, 0.4999);  // to a cell of the draws
    EXPECT_LT(realise(i).pta_g, 1.0001);
  }
  EXPECT_NEAR(kept, 20000 * 0.5 / 1.9, 4 * std::sqrt(20000 * 0.26 * 0.74));
}

TEST(Target, OfAListAndOfTheMotion) {
  const auto draws = kept(parse(swept("{choice: [0.2, 0.3, 0.4]}",
                                      "friction.mu: {choice: [0.4, 0.2], weights: [3, 1]}, "
                                      "motion.peak_acceleration_g: {uniform: [0.1, 1]}")),
                          "friction_mu");
  const double n = static_cast<double>(draws.size());
  const auto share = [&](double mu) { return static_cast<double>(std::count(draws.begin(), draws.end(), mu)) / n; };
  EXPECT_EQ(share(0.3), 0);
  EXPECT_NEAR(share(0.4), 0.75, 4 * std::sqrt(0.75 * 0.25 / n));
}

TEST(Target, TellsWhatItTakesAway) {
  const Study study = parse(swept("{uniform: [0.1, 0.5]}", "friction.mu: {uniform: [0.4, 0.51]}", "adequate: 0.2, "));
  EXPECT_THAT(Target(study).told(),
              HasSubstr("target: 25 % of the samples stay, so that friction.mu is {uniform: [0.4, "
                        "0.51]} (9.1 % of it lie where nothing was swept)"));
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_TRUE(Target(parse(block + friction + samples + motions + fragility)).told().empty());
}

TEST(Target, WhatCannotBeMadeOfTheSamplesIsRefused) {
  const auto refused = [](const std::string& friction, const std::string& target) {
    return problems(swept(friction, target));
  };
  EXPECT_THAT(refused("{uniform: [0.1, 0.5]}", "friction.mu: {uniform: [0.4, 0.6]}"),
              HasSubstr("50.0 % of the target of friction.mu lie where nothing was swept"));
  EXPECT_THAT(refused("{lognormal: {median: 0.3, dispersion: 0.2}}", "friction.mu: {uniform: [2, 3]}"),
              HasSubstr("hardly any sample lies where the target of friction.mu does"));
  EXPECT_THAT(refused("0.3", "friction.mu: {uniform: [0.4, 0.6]}"), HasSubstr("friction.mu is 0.3 in every sample"));
  EXPECT_THAT(refused("{uniform: [0.1, 0.5]}", "friction.mu: 0.4"), HasSubstr("is one number"));
  EXPECT_THAT(refused("{uniform: [0.1, 0.5]}", "friction.mu: {choice: [0.4]}"), HasSubstr("do not meet"));
  EXPECT_THAT(refused("{choice: [0.1, 0.5]}", "friction.mu: {choice: [0.1, 0.4]}"), HasSubstr("50.0 % of the target"));
  EXPECT_THAT(refused("{uniform: [0.1, 0.5]}", "friction.mu_k: {uniform: [0.2, 0.3]}"),
              HasSubstr("friction.mu_k is nothing that every sample of this study draws (did you mean friction.mu?)"));
  EXPECT_THAT(refused("{uniform: [0.1, 0.5]}", "friction.mu: {uniform: [0.5, 0.2]}"), HasSubstr("friction.mu"));
}

}  // namespace
}  // namespace freestand::study::target_test
