// Sobol points by random access, and nested uniform (Owen) scrambling of 64-bit words.
#pragma once

#include <cstdint>

namespace freestand::sampling {

inline constexpr int sobol_dimensions = 64;

// Coordinate `dimension` of point `index` of the Sobol sequence in natural order, as a 64-bit fraction: XOR of the
// direction numbers of the set bits of the index. 0 <= dimension < sobol_dimensions. Direction numbers: Joe & Kuo,
// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30 (2008), table
// new-joe-kuo-6.21201.
std::uint64_t sobol_word(int dimension, std::uint64_t index);

// Nested uniform scrambling (Owen 1995): bit j of the word, from the top, is flipped or not by a hash of (key, bits
// above j). A bijection of the 64-bit words that maps dyadic intervals to dyadic intervals.
std::uint64_t owen_scramble(std::uint64_t word, std::uint64_t key);

}  // namespace freestand::sampling
