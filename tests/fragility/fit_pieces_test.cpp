// A fit whose pieces are made elsewhere, in any order, is the same to the bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "fragility/draws.hpp"
#include "fragility/fit.hpp"
#include "fragility/result_numbers.hpp"

namespace freestand::fragility {
namespace {

std::vector<std::uint64_t> bits(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> bits;
  for (const double x : numbers) bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

Tally tally() {
  Options options;
  options.im_name = "pga_g";
  options.im_edge = {0.1, 0.5, 1};
  options.edps = {{"slip", "m", "", false, 1e-4, {0.1, 0.3}}, {"fell", "1", "", true}};
  options.axes = {{"friction_mu_k", "1", {0.1, 0.2, 0.3}}};
  options.motion_group = {0, 1, 2, 3, 4, 5, 6, 7};
  options.resamples = 50;
  Tally tally(options);
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double im = 0.1 + 0.9 * test::uniform(i, 1), axis = 0.1 + 0.2 * test::uniform(i, 2);
    const double slip = 0.2 * im * std::exp(0.5 * test::normal(i, 3));
    const bool fell = slip > 0.35;
    const double edp[] = {slip, fell ? 1.0 : 0.0};
    tally.add({i, im, static_cast<int>(i % 8), fell ? Outcome::overturned : Outcome::moved, edp, {&axis, 1}});
  }
  return tally;
}

TEST(FitPieces, InAnyOrderAreTheSameToTheBit) {
  const Tally counted = tally();
  const Result here = fit(counted);
  const Result there = fit(counted, [](const std::string& what, std::size_t n, const Job& job) {
    EXPECT_EQ(what, "fit");
    EXPECT_EQ(n, 6U);  // two demands, two capacities and one of a binary demand, overturning
    std::vector<std::vector<double>> answers(n);
    for (std::size_t i = n; i-- > 0;) answers[i] = job(i);
    return answers;
  });
  ASSERT_EQ(here.edps.size(), 2U);
  EXPECT_GT(here.edps[0].bins[1].lambda, here.edps[0].bins[0].lambda);
  EXPECT_EQ(here.edps[0].functions.size(), 2U);
  EXPECT_EQ(here.edps[0].axes[0].name, "friction_mu_k");
  EXPECT_EQ(here.edps[0].axes[0].probability.size(), 8U);
  EXPECT_GT(here.overturning.median, 0);
  for (std::size_t e = 0; e < 2; ++e) {
    EXPECT_EQ(here.edps[e].name, there.edps[e].name);
    EXPECT_EQ(bits(numbers_of(here.edps[e])), bits(numbers_of(there.edps[e])));
  }
  EXPECT_EQ(bits(numbers_of(here.overturning)), bits(numbers_of(there.overturning)));
}

}  // namespace
}  // namespace freestand::fragility
