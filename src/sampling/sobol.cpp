#include "sampling/sobol.hpp"

#include <array>
#include <bit>

#include "base/random.hpp"
#include "sampling/sobol_table.hpp"

namespace freestand::sampling {
namespace {

constexpr int word_bits = 64;
using Directions = std::array<std::uint64_t, word_bits>;

// v_k = m_k 2^(64-k); for k > s: v_k = a_1 v_(k-1) ^ ... ^ a_(s-1) v_(k-s+1) ^ v_(k-s) ^ (v_(k-s) >> s).
constexpr Directions directions(const DirectionRow& row) {
  Directions v{};
  const int degree = std::bit_width(row.polynomial) - 1;
  for (int k = 0; k < word_bits; ++k) {
    if (degree == 0 || k < degree) {
      const std::uint64_t m = degree == 0 ? 1 : row.m[static_cast<std::size_t>(k)];
      v[static_cast<std::size_t>(k)] = m << (word_bits - 1 - k);
      continue;
    }
    const std::uint64_t oldest = v[static_cast<std::size_t>(k - degree)];
    std::uint64_t next = oldest ^ (oldest >> degree);
    for (int j = 1; j < degree; ++j)
      if ((row.polynomial >> (degree - j)) & 1U) next ^= v[static_cast<std::size_t>(k - j)];
    v[static_cast<std::size_t>(k)] = next;
  }
  return v;
}

constexpr auto all_directions = [] {
  std::array<Directions, sobol_dimensions> all{};
  for (std::size_t d = 0; d < all.size(); ++d) all[d] = directions(direction_rows[d]);
  return all;
}();

constexpr int levels_per_hash = 6;  // one 64-bit hash decides the 63 flips of a subtree of 6 levels

}  // namespace

std::uint64_t sobol_word(int dimension, std::uint64_t index) {
  const Directions& v = all_directions[static_cast<std::size_t>(dimension)];
  std::uint64_t word = 0;
  for (; index != 0; index &= index - 1) word ^= v[static_cast<std::size_t>(std::countr_zero(index))];
  return word;
}

std::uint64_t owen_scramble(std::uint64_t word, std::uint64_t key) {
  std::uint64_t result = 0;
  for (int level = 0; level < word_bits; level += levels_per_hash) {
    const std::uint64_t above = level == 0 ? 0 : word >> (word_bits - level);
    const std::uint64_t subtree = random::mix(key + static_cast<std::uint64_t>(level) * 0x9e3779b97f4a7c15ULL) ^ above;
    const std::uint64_t flips = random::mix(subtree * 0xd1342543de82ef95ULL + key);
    std::uint64_t node = 1;
    for (int j = level; j < level + levels_per_hash && j < word_bits; ++j) {
      const int shift = word_bits - 1 - j;
      const std::uint64_t bit = (word >> shift) & 1U;
      result |= (bit ^ ((flips >> node) & 1U)) << shift;
      node = 2 * node + bit;
    }
  }
  return result;
}

}  // namespace freestand::sampling
