#include "base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace freestand::random {
namespace {

// Known answers of philox4x32-10 that its authors publish (words in the order of the counter).
TEST(Random, PhiloxGivesThePublishedKnownAnswers) {
  const auto zero = bits(0, 0, 0);
  EXPECT_EQ(zero.first, 0xe169c58d6627e8d5ULL);
  EXPECT_EQ(zero.second, 0x9b00dbd8bc57ac4cULL);
  const auto digits_of_pi = bits(0x299f31d0a4093822ULL, 0x85a308d3243f6a88ULL, 0x0370734413198a2eULL);
  EXPECT_EQ(digits_of_pi.first, 0x94fdccebd16cfe09ULL);
  EXPECT_EQ(digits_of_pi.second, 0x24126ea15001e420ULL);
}

TEST(Random, StableHashIsFnv1a) {
  EXPECT_EQ(stable_hash(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(stable_hash("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(stable_hash("foobar"), 0x85944171f73967e8ULL);
  EXPECT_EQ(stable_hash("bar", stable_hash("foo")), stable_hash("foobar"));
}

TEST(Random, UnitIntervalIsOpenAndSymmetric) {
  EXPECT_EQ(unit_interval(0), 0x1.0p-53);
  EXPECT_EQ(unit_interval(~0ULL), 1 - 0x1.0p-53);
  for (const std::uint64_t word : {0ULL, 0x123456789abcdefULL, 1ULL << 63, ~0ULL})
    EXPECT_EQ(unit_interval(word) + unit_interval(~word), 1.0);
}

TEST(Random, MixIsABijectionOnASampleOfWords) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 100000; ++i) seen.insert(mix(i));
  EXPECT_EQ(seen.size(), 100000U);
}

// Mean and variance of 2^18 uniforms within 4 standard errors, for streams that differ by one bit.
TEST(Random, UniformsHaveTheRightMoments) {
  constexpr int n = 1 << 18;
  for (const std::uint64_t stream : {1ULL, 2ULL, 3ULL}) {
    double sum = 0, squares = 0, neighbours = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
      const double u = uniform(7, i, stream) - 0.5;
      sum += u;
      squares += u * u;
      neighbours += u * (uniform(7, i, stream + 1) - 0.5);
    }
    EXPECT_NEAR(sum / n, 0, 4 * std::sqrt(1.0 / 12 / n));
    EXPECT_NEAR(squares / n, 1.0 / 12, 4 * std::sqrt(1.0 / 180 / n));
    EXPECT_NEAR(neighbours / n, 0, 4 / 12.0 / std::sqrt(n));
  }
}

}  // namespace
}  // namespace freestand::random
