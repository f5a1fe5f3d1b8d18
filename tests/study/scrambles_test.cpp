// Errors from the differences between independent scrambles are the errors that the design has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fragility/fit.hpp"
#include "fragility/tally.hpp"
#include "sampling/design.hpp"
#include "sampling/distribution.hpp"
#include "study_text.hpp"

namespace freestand::study::scrambles_test {
namespace {

using namespace test;

struct Fitted {
  double lambda, lambda_se;
};

// ln EDP = the sum of three normal numbers of a design of 4096 points, whose lambda is 0.
Fitted fitted(int scrambles, std::uint64_t seed) {
  fragility::Options options;
  options.im_name = "im";
  options.im_edge = {0, 1};
  options.edps = {{"demand", "1", "", false, 0, {1}}};
  options.scrambles = scrambles;
  options.resamples = 200;
  options.seed = seed;
  fragility::Tally tally(options);
  constexpr std::uint64_t samples = 4096;
  std::vector<sampling::Stream> streams;
  for (const char* name : {"friction.mu_k", "block.width_m", "motion.period_s"})
    streams.emplace_back(sampling::Plan{sampling::Design::sobol, seed, samples, scrambles}, name);
  std::vector<double> demand(1);
  for (std::uint64_t i = 0; i < samples; ++i) {
    double sum = 0;
    for (const auto& stream : streams) sum += quantile(sampling::Normal{}, stream(i));
    demand[0] = std::exp(sum);
    fragility::Sample sample;
    sample.index = i;
    sample.im = 0.5;
    sample.outcome = Outcome::moved;
    sample.edp = demand;
    tally.add(sample);
  }
  const fragility::BinFit bin = fragility::fit(tally).edps.front().bins.front();
  return {bin.lambda, bin.lambda_se};
}

// Of 60 designs: how far lambda scatters over the error that is stated. Its standard error is 1/sqrt(2 60) of it, 0.09;
// the bootstrap of 32 groups states sqrt(31/32) of it.
TEST(Scrambles, StateTheErrorsThatTheyHave) {
  double scatter = 0, stated = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Fitted one = fitted(32, seed);
    scatter += one.lambda * one.lambda / 60;
    stated += one.lambda_se * one.lambda_se / 60;
  }
  EXPECT_NEAR(std::sqrt(scatter / stated), 1, 3 * 0.09);
  // Samples that count as independent: errors of 3^0.5/64, which a single design does not have.
  const Fitted single = fitted(1, 1);
  EXPECT_NEAR(single.lambda_se, std::sqrt(3.0) / 64, 0.3 * std::sqrt(3.0) / 64);
  EXPECT_LT(std::sqrt(stated), 0.5 * single.lambda_se);
}

TEST(Scrambles, AreReadAndWrittenOut) {
  const Study study = parse(block + friction + samples + "scrambles: 32\n" + motions + fragility);
  EXPECT_EQ(study.plan().scrambles, 32);
  EXPECT_THAT(expanded(study), testing::HasSubstr("scrambles: 32\n"));
  EXPECT_EQ(expanded(parse(expanded(study))), expanded(study));
  EXPECT_THAT(problems(block + friction + samples + "design: monte_carlo\nscrambles: 32\n" + motions + fragility),
              testing::HasSubstr("samples of monte_carlo are independent as they are"));
  EXPECT_THAT(problems(block + friction + samples + "scrambles: 1000\n" + motions + fragility),
              testing::HasSubstr("scrambles"));
}

}  // namespace
}  // namespace freestand::study::scrambles_test
