// Counter-based random numbers: every draw is a pure function of (seed, sample, stream), so any rank can make any
// sample, in any order, and one more sample or one more parameter changes no earlier draw.
//
// Source: J. K. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3" (SC11); Philox4x32-10 of Random123.
#pragma once

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <utility>

namespace freestand::random {

// FNV-1a, 64 bits: the same number for the same bytes on every machine. `hash` continues an earlier one.
constexpr std::uint64_t stable_hash(std::string_view text, std::uint64_t hash = 14695981039346656037ULL) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

// Bijective mixing of 64 bits (finaliser of SplitMix64): for hashing the nodes of a tree, not for streams.
constexpr std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// 128 random bits that belong to (seed, counter, stream).
inline std::pair<std::uint64_t, std::uint64_t> bits(std::uint64_t seed, std::uint64_t counter, std::uint64_t stream) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const r123::Philox4x32::ctr_type c = {{low(counter), high(counter), low(stream), high(stream)}};
  const r123::Philox4x32::key_type k = {{low(seed), high(seed)}};
  const auto r = r123::Philox4x32()(c, k);
  return {(static_cast<std::uint64_t>(r[1]) << 32) | r[0], (static_cast<std::uint64_t>(r[3]) << 32) | r[2]};
}

// The upper 52 bits of a word -> the open interval (0, 1): odd multiples of 2^-53. Never 0, never 1, and symmetric:
// flipping every bit of the word gives exactly 1 - u.
constexpr double unit_interval(std::uint64_t word) { return static_cast<double>(2 * (word >> 12) + 1) * 0x1.0p-53; }

// Uniform in the open interval (0, 1).
inline double uniform(std::uint64_t seed, std::uint64_t counter, std::uint64_t stream) {
  return unit_interval(bits(seed, counter, stream).first);
}

// Standard normal, likewise (Box and Muller).
inline double standard_normal(std::uint64_t seed, std::uint64_t counter, std::uint64_t stream) {
  const auto [a, b] = bits(seed, counter, stream);
  return std::sqrt(-2 * std::log(unit_interval(a))) * std::cos(2 * std::numbers::pi * unit_interval(b));
}

}  // namespace freestand::random
