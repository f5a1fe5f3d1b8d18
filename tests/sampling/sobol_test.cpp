#include "sampling/sobol.hpp"

#include <gsl/gsl_qrng.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "base/random.hpp"
#include "sampling/sobol_table.hpp"

namespace freestand::sampling {
namespace {

int degree(std::uint32_t polynomial) { return std::bit_width(polynomial) - 1; }

// Order of x modulo the polynomial over GF(2); 2^s - 1 exactly when it is primitive.
std::uint32_t order_of_x(std::uint32_t polynomial) {
  const std::uint32_t top = 1U << degree(polynomial);
  std::uint32_t power = 1, order = 0;
  do {
    power <<= 1;
    if (power & top) power ^= polynomial;
    ++order;
  } while (power != 1 && order < 2 * top);
  return order;
}

TEST(Sobol, DirectionTableIsSound) {
  std::set<std::uint32_t> polynomials;
  for (std::size_t d = 1; d < direction_rows.size(); ++d) {
    const auto& row = direction_rows[d];
    const int s = degree(row.polynomial);
    EXPECT_TRUE(polynomials.insert(row.polynomial).second) << "dimension " << d;
    EXPECT_TRUE(s == 1 || order_of_x(row.polynomial) == (1U << s) - 1) << "not primitive: dimension " << d;
    for (int i = 0; i < 10; ++i) {
      const std::uint32_t m = row.m[static_cast<std::size_t>(i)];
      EXPECT_EQ(m % 2, i < s ? 1U : 0U) << "dimension " << d;
      EXPECT_LT(m, 2U << i) << "dimension " << d;
    }
  }
}

// The recurrence in its printed form: m_k = 2 a_1 m_(k-1) ^ ... ^ 2^(s-1) a_(s-1) m_(k-s+1) ^ 2^s m_(k-s) ^ m_(k-s).
TEST(Sobol, DirectionNumbersFollowTheRecurrence) {
  for (int d = 1; d < sobol_dimensions; ++d) {
    const auto& row = direction_rows[static_cast<std::size_t>(d)];
    const int s = degree(row.polynomial);
    const auto m = [&](int k) { return sobol_word(d, 1ULL << (k - 1)) >> (64 - k); };  // k = 1, 2 ...
    for (int k = 1; k <= s; ++k) EXPECT_EQ(m(k), row.m[static_cast<std::size_t>(k - 1)]);
    for (int k = s + 1; k <= 40; ++k) {
      std::uint64_t expected = (m(k - s) << s) ^ m(k - s);
      for (int j = 1; j < s; ++j)
        if ((row.polynomial >> (s - j)) & 1U) expected ^= m(k - j) << j;
      ASSERT_EQ(m(k), expected) << "dimension " << d << ", k " << k;
    }
  }
}

// Points computed by SciPy (scipy.stats.qmc.Sobol, 30 bits, not scrambled), which orders them by Gray code.
TEST(Sobol, PointsAgreeWithAnotherImplementation) {
  struct Point {
    int dimension;
    std::uint64_t index, word30;
  };
  const Point points[] = {{1, 1, 0x20000000},    {2, 1, 0x20000000},    {63, 1, 0x20000000},   {1, 3, 0x10000000},
                          {2, 3, 0x10000000},    {9, 3, 0x30000000},    {35, 3, 0x30000000},   {63, 3, 0x30000000},
                          {1, 107, 0x35800000},  {2, 107, 0x800000},    {9, 107, 0x1b800000},  {35, 107, 0x31800000},
                          {63, 107, 0x38800000}, {1, 2048, 0x3c3c0000}, {2, 2048, 0x15640000}, {9, 2048, 0xfc40000},
                          {35, 2048, 0xb3c0000}, {63, 2048, 0x236c0000}};
  for (const auto& p : points)
    EXPECT_EQ(sobol_word(p.dimension, p.index) >> 34, p.word30) << p.dimension << " " << p.index;
}

// GSL uses other direction numbers from the third dimension on; the first two are the same. It starts at index 1.
TEST(Sobol, FirstTwoDimensionsAgreeWithGsl) {
  gsl_qrng* reference = gsl_qrng_alloc(gsl_qrng_sobol, 2);
  for (std::uint64_t n = 1; n < 3000; ++n) {
    double x[2];
    gsl_qrng_get(reference, x);
    const std::uint64_t gray = n ^ (n >> 1);
    for (int d = 0; d < 2; ++d) ASSERT_EQ(static_cast<double>(sobol_word(d, gray)) * 0x1.0p-64, x[d]);
  }
  gsl_qrng_free(reference);
}

// Smallest t for which the 2^m points are a (t, m, 2)-net in this pair of coordinates: every dyadic box of area 2^(t-m)
// holds 2^t points.
int quality(int m, const std::vector<std::uint64_t>& x, const std::vector<std::uint64_t>& y) {
  for (int t = 0; t < m; ++t) {
    bool balanced = true;
    for (int kx = 0; kx <= m - t && balanced; ++kx) {
      const int ky = m - t - kx;
      std::vector<int> counts(1U << (m - t));
      for (std::size_t i = 0; i < x.size(); ++i) {
        const std::uint64_t column = kx ? x[i] >> (64 - kx) : 0, row = ky ? y[i] >> (64 - ky) : 0;
        ++counts[(column << ky) | row];
      }
      for (const int c : counts) balanced = balanced && c == (1 << t);
    }
    if (balanced) return t;
  }
  return m;
}

std::vector<std::uint64_t> points(int dimension, int m, std::uint64_t key) {
  std::vector<std::uint64_t> x;
  for (std::uint64_t i = 0; i < (1ULL << m); ++i) {
    const std::uint64_t word = sobol_word(dimension, i);
    x.push_back(key ? owen_scramble(word, key) : word);
  }
  return x;
}

TEST(Sobol, FirstTwoDimensionsAreAZeroNetAndScramblingKeepsEveryNet) {
  constexpr int m = 9;
  EXPECT_EQ(quality(m, points(0, m, 0), points(1, m, 0)), 0);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {3, 7}, {5, 20}, {11, 35}}) {
    const int t = quality(m, points(a, m, 0), points(b, m, 0));
    EXPECT_EQ(quality(m, points(a, m, 99), points(b, m, 12345)), t) << a << " and " << b;
  }
}

TEST(Sobol, PairsOfTheFirstDimensionsAreNearlyNets) {
  constexpr int m = 10;
  std::vector<std::vector<std::uint64_t>> all;
  for (int d = 0; d < 11; ++d) all.push_back(points(d, m, 0));
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_LE(quality(m, all[a], all[b]), 4) << a << " and " << b;
}

TEST(OwenScramble, IsNested) {
  // Words that agree in their first j bits still do, and those that differ first at bit j still do.
  for (const std::uint64_t key : {1ULL, 0xdeadbeefULL}) {
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const std::uint64_t a = random::mix(i), b = a ^ (random::mix(i + 77) >> (i % 64));
      EXPECT_EQ(std::countl_zero(a ^ b), std::countl_zero(owen_scramble(a, key) ^ owen_scramble(b, key)));
    }
  }
}

// A flip at a node must be a fair coin, and the flips of two nodes of one level independent ones.
TEST(OwenScramble, FlipsAreFairAndIndependent) {
  constexpr int n = 20000;
  for (const int level : {0, 3, 5, 6, 7, 20, 51}) {
    const int shift = 63 - level;
    int flips = 0, equal = 0;
    for (std::uint64_t key = 0; key < n; ++key) {
      const bool first = (owen_scramble(0, key) >> shift) & 1U;
      const std::uint64_t other = level ? 1ULL << 63 : 0;  // another node of the level
      const bool second = (owen_scramble(other, level ? key : key + n) >> shift) & 1U;
      flips += first;
      equal += first == second;
    }
    EXPECT_NEAR(flips, n / 2, 4 * std::sqrt(n) / 2) << "level " << level;
    EXPECT_NEAR(equal, n / 2, 4 * std::sqrt(n) / 2) << "level " << level;
  }
}

}  // namespace
}  // namespace freestand::sampling
