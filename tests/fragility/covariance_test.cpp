// Covariance of ln demands, against demands that are made with a known one.
#include "fragility/covariance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace freestand::fragility {
namespace {

Options options() {
  Options options;
  options.im_name = "pga_g";
  options.im_edge = {0.1, 1, 2};
  options.edps = {{"slip", "m", "", false, 1e-4, {0.1}}, {"fell", "1", "", true}, {"turn", "1", "", false, 0, {1}}};
  options.minimum_samples = 30;
  return options;
}

// ln slip = 0.7 ln IM + e, ln turn = -0.3 ln IM + 0.5 e + f, e and f normal with 0.4 and 0.3: whatever the lines are, the
// covariances are 0.16, 0.5 * 0.16, 0.25 * 0.16 + 0.09. Standard errors of n = 20000 samples are below 0.0016; 4 of them.
TEST(Covariance, IsThatAboutTheLines) {
  Tally tally(options());
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.11, 0.99);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double im = uniform(random), e = 0.4 * normal(random), f = 0.3 * normal(random);
    const double edp[] = {std::exp(0.7 * std::log(im) + e), 0, std::exp(-0.3 * std::log(im) + 0.5 * e + f)};
    tally.add({i, im, 0, Outcome::moved, edp, {}});
  }
  const Covariance found = covariance(tally);
  EXPECT_EQ(found.edps, (std::vector<std::string>{"slip", "turn"}));
  ASSERT_EQ(found.ln_covariance.size(), 2u * 2 * 2);
  EXPECT_NEAR(found.ln_covariance[0], 0.16, 0.0064);
  EXPECT_NEAR(found.ln_covariance[1], 0.08, 0.0064);
  EXPECT_EQ(found.ln_covariance[1], found.ln_covariance[2]);
  EXPECT_NEAR(found.ln_covariance[3], 0.13, 0.0064);
  EXPECT_EQ(found.n[1], 20000);
  EXPECT_TRUE(std::isnan(found.ln_covariance[4]));  // the second bin is empty
  EXPECT_EQ(found.n[4], 0);
}

// Three samples of which two moved by both: by hand, at one intensity.
TEST(Covariance, CountsWhatMovedByBothAndStood) {
  Options few = options();
  few.minimum_samples = 2;
  Tally tally(few);
  const auto add = [&](std::uint64_t i, double slip, double turn, Outcome outcome) {
    const double edp[] = {slip, 0, turn};
    tally.add({i, 0.5, 0, outcome, edp, {}});
  };
  add(0, std::exp(1), std::exp(2), Outcome::moved);
  add(1, std::exp(2), std::exp(4), Outcome::moved);
  add(2, std::exp(4), std::exp(3), Outcome::moved);
  add(3, 5e-5, 1, Outcome::moved);  // still by slip
  add(4, std::nan(""), std::nan(""), Outcome::overturned);
  add(5, 1, 1, Outcome::painleve);
  const Covariance found = covariance(tally);
  EXPECT_EQ(found.n[0], 3);
  EXPECT_EQ(found.n[1], 3);
  EXPECT_EQ(found.n[3], 4);
  // slip 1 2 4, mean 7/3; turn 2 4 3, mean 3: sum of products (-4/3)(-1) + (-1/3)(1) + 0 = 1, over 2.
  EXPECT_NEAR(found.ln_covariance[1], 0.5, 1e-9);
  EXPECT_NEAR(found.ln_covariance[0], (16.0 / 9 + 1.0 / 9 + 25.0 / 9) / 2, 1e-9);
}

}  // namespace
}  // namespace freestand::fragility
