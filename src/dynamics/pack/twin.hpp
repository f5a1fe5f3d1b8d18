// Two packs side by side, as one number: what the one waits for gives the other time.
#pragma once

#include "dynamics/pack/power.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

inline constexpr int twin_lanes = 2 * pack_lanes;

// Those of packs stay visible beside those of twins.
using freestand::bits, freestand::choose, freestand::store;

struct TwinMask {
  PackMask a, b;

  friend TwinMask operator&(const TwinMask& x, const TwinMask& y) { return {x.a & y.a, x.b & y.b}; }
  friend TwinMask operator|(const TwinMask& x, const TwinMask& y) { return {x.a | y.a, x.b | y.b}; }
  friend TwinMask operator!(const TwinMask& x) { return {!x.a, !x.b}; }
};
inline unsigned bits(const TwinMask& x) { return bits(x.a) | bits(x.b) << pack_lanes; }

struct Twin {
  Pack a, b;

  Twin() = default;
  Twin(double x) : a(x), b(x) {}
  Twin(const Pack& first, const Pack& second) : a(first.data), b(second.data) {}
  // Whole registers: left to itself the compiler copies halves, for which loads of the whole wait long.
  Twin(const Twin& x) : a(x.a.data), b(x.b.data) {}
  Twin& operator=(const Twin& x) {
    a = Pack(x.a.data);
    b = Pack(x.b.data);
    return *this;
  }

  friend Twin operator+(const Twin& x, const Twin& y) { return {x.a + y.a, x.b + y.b}; }
  friend Twin operator-(const Twin& x, const Twin& y) { return {x.a - y.a, x.b - y.b}; }
  friend Twin operator*(const Twin& x, const Twin& y) { return {x.a * y.a, x.b * y.b}; }
  friend Twin operator/(const Twin& x, const Twin& y) { return {x.a / y.a, x.b / y.b}; }
  friend TwinMask operator<(const Twin& x, const Twin& y) { return {x.a < y.a, x.b < y.b}; }
  friend TwinMask operator>(const Twin& x, const Twin& y) { return {x.a > y.a, x.b > y.b}; }
  friend TwinMask operator<=(const Twin& x, const Twin& y) { return {x.a <= y.a, x.b <= y.b}; }
  friend TwinMask operator>=(const Twin& x, const Twin& y) { return {x.a >= y.a, x.b >= y.b}; }
  friend TwinMask operator==(const Twin& x, const Twin& y) { return {x.a == y.a, x.b == y.b}; }
  friend Twin abs(const Twin& x) { return {xsimd::abs(x.a), xsimd::abs(x.b)}; }
  friend Twin sqrt(const Twin& x) { return {xsimd::sqrt(x.a), xsimd::sqrt(x.b)}; }
  friend Twin max(const Twin& x, const Twin& y) { return {xsimd::max(x.a, y.a), xsimd::max(x.b, y.b)}; }
  friend Twin min(const Twin& x, const Twin& y) { return {xsimd::min(x.a, y.a), xsimd::min(x.b, y.b)}; }
  friend Twin power_of(const Twin& x, const Twin& n) { return {power_of(x.a, n.a), power_of(x.b, n.b)}; }
  friend Twin eighth_root(const Twin& x) { return {eighth_root(x.a), eighth_root(x.b)}; }
};

inline Twin load_twin(const double* p) { return {load(p), load(p + pack_lanes)}; }
inline void store(double* p, const Twin& x) {
  store(p, x.a);
  store(p + pack_lanes, x.b);
}
inline Twin choose(const TwinMask& mask, const Twin& yes, const Twin& no) {
  return {choose(mask.a, yes.a, no.a), choose(mask.b, yes.b, no.b)};
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
