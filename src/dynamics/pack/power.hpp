// x^n for packs, 0 < x <= 1, 1 <= n <= 100, to a few 1e-14 of the value, with the same bits in packs of any width. Values
// below 1e-290 come out as about that.
//
// log2 x = k + log2 m, m in [sqrt(1/2), sqrt(2)), by 2 artanh((m - 1)/(m + 1)); 2^y = 2^k 2^f, |f| <= 1/2, by Taylor's
// series. The bits of the exponent are read and written as integers.
#pragma once

#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

using PackBits = xsimd::batch<std::uint64_t>;
inline PackBits as_bits(const Pack& x) { return xsimd::bitwise_cast<PackBits>(x); }
inline Pack as_double(const PackBits& x) { return xsimd::bitwise_cast<Pack>(x); }

constexpr std::uint64_t root_half_bits = 0x3fe6a09e667f3bcdULL;  // sqrt(1/2)
constexpr double integer_shift = 6755399441055744.0;             // 1.5 * 2^52: adding it rounds to an integer

// 2^y, -1000 < y < 1000.
inline Pack power_of_two(const Pack& y) {
  const Pack shifted = y + Pack(integer_shift);
  const Pack f = (y - (shifted - Pack(integer_shift))) * Pack(0.69314718055994531);
  const Pack f2 = f * f, f4 = f2 * f2;
  const Pack e0 = (Pack(1.0) + f) + f2 * (Pack(1.0 / 2) + f * Pack(1.0 / 6));
  const Pack e1 = (Pack(1.0 / 24) + f * Pack(1.0 / 120)) + f2 * (Pack(1.0 / 720) + f * Pack(1.0 / 5040));
  const Pack e2 = (Pack(1.0 / 40320) + f * Pack(1.0 / 362880)) + f2 * (Pack(1.0 / 3628800) + f * Pack(1.0 / 39916800));
  const Pack e = e0 + f4 * (e1 + f4 * e2);
  return as_double(as_bits(e) + (as_bits(shifted) << 52));
}

inline Pack power_of(const Pack& x, const Pack& n) {
  // 1000 is added to the exponent so that it stays positive, and taken away as a double.
  const PackBits offset = as_bits(x) - PackBits(root_half_bits) + PackBits(1000ULL << 52);
  const PackBits exponent = offset >> 52;
  const Pack k = as_double(exponent | PackBits(0x4330000000000000ULL)) - Pack(4503599627370496.0 + 1000.0);
  const Pack m = as_double(as_bits(x) - (exponent << 52) + PackBits(1000ULL << 52));
  const Pack t = (m - Pack(1.0)) / (m + Pack(1.0)), t2 = t * t, t4 = t2 * t2;
  constexpr double c = 2.8853900817779268;  // 2/ln 2
  const Pack low = (Pack(c) + Pack(c / 3) * t2) + t4 * (Pack(c / 5) + Pack(c / 7) * t2);
  const Pack high = (Pack(c / 9) + Pack(c / 11) * t2) + t4 * (Pack(c / 13) + Pack(c / 15) * t2);
  return power_of_two(xsimd::max(n * (k + t * (low + t4 * t4 * high)), Pack(-960.0)));
}

// e^x, to a few 1e-16 times 1 + |x|; below x = -660 it comes out as about 1e-287.
inline Pack exponential_of(const Pack& x) {
  constexpr double per_ln2 = 1.4426950408889634;
  return power_of_two(xsimd::min(xsimd::max(x * Pack(per_ln2), Pack(-960.0)), Pack(960.0)));
}

inline double power_of_one(double x, double n) {
  alignas(64) double values[pack_lanes];
  store(values, power_of(Pack(x), Pack(n)));
  return values[0];
}

// x^(1/8) for x > 0, up to 4 % too small: the exponent divided by 8.
inline Pack eighth_root(const Pack& x) {
  constexpr std::uint64_t one = 0x3ff0000000000000ULL;
  return as_double((as_bits(x) >> 3) + PackBits(one - (one >> 3))) * Pack(0.96);
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
