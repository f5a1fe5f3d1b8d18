// Several packs as one: all operations go through them in turns, so that where each waits for the one before, the packs fill
// each other's gaps.
#pragma once

#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int n>
struct PacksMask {
  PackMask pack[n];
};

template <int n>
struct Packs {
  Pack pack[n];
  using batch_bool_type = PacksMask<n>;

  Packs() = default;
  explicit Packs(double x) {
#pragma GCC unroll 4
    for (Pack& one : pack) one = Pack(x);
  }
};

template <class V>
using MaskOf = typename V::batch_bool_type;

template <class V>
constexpr int lanes_of = static_cast<int>(sizeof(V) / sizeof(double));

template <int n, class Result, class Operation, class... More>
[[gnu::always_inline]] inline Result in_turns(Operation&& operation, const More&... more) {
  Result result;
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) result.pack[i] = operation(more.pack[i]...);
  return result;
}

#define FREESTAND_PACKS(NAME, RESULT, OPERAND, EXPRESSION)                                        \
  template <int n>                                                                                \
  [[gnu::always_inline]] inline RESULT<n> NAME(const OPERAND<n>& a, const OPERAND<n>& b) {        \
    return in_turns<n, RESULT<n>>([](const auto& x, const auto& y) { return EXPRESSION; }, a, b); \
  }
FREESTAND_PACKS(operator+, Packs, Packs, x + y)
FREESTAND_PACKS(operator-, Packs, Packs, x - y)
FREESTAND_PACKS(operator*, Packs, Packs, x* y)
FREESTAND_PACKS(operator/, Packs, Packs, x / y)
FREESTAND_PACKS(min, Packs, Packs, xsimd::min(x, y))
FREESTAND_PACKS(max, Packs, Packs, xsimd::max(x, y))
FREESTAND_PACKS(operator<, PacksMask, Packs, x < y)
FREESTAND_PACKS(operator>, PacksMask, Packs, x > y)
FREESTAND_PACKS(operator<=, PacksMask, Packs, x <= y)
FREESTAND_PACKS(operator>=, PacksMask, Packs, x >= y)
FREESTAND_PACKS(operator==, PacksMask, Packs, x == y)
FREESTAND_PACKS(operator&, PacksMask, PacksMask, x& y)
FREESTAND_PACKS(operator|, PacksMask, PacksMask, x | y)
#undef FREESTAND_PACKS

template <int n>
inline PacksMask<n> operator~(const PacksMask<n>& a) {
  return in_turns<n, PacksMask<n>>([](const PackMask& x) { return ~x; }, a);
}
template <int n>
inline Packs<n> abs(const Packs<n>& a) {
  return in_turns<n, Packs<n>>([](const Pack& x) { return xsimd::abs(x); }, a);
}
template <int n>
inline Packs<n> choose(const PacksMask<n>& mask, const Packs<n>& yes, const Packs<n>& no) {
  return in_turns<n, Packs<n>>([](const PackMask& m, const Pack& x, const Pack& y) { return xsimd::select(m, x, y); },
                               mask, yes, no);
}

// Bit i: lane i holds.
template <int n>
inline unsigned bits(const PacksMask<n>& mask) {
  unsigned all = 0;
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) all |= freestand::bits(mask.pack[i]) << (i * pack_lanes);
  return all;
}
using freestand::bits;
using freestand::choose;

template <class V>
inline V load_as(const double* p) {
  V x;
#pragma GCC unroll 4
  for (int i = 0; i < lanes_of<V> / pack_lanes; ++i) x.pack[i] = load(p + i * pack_lanes);
  return x;
}
template <int n>
inline void store(double* p, const Packs<n>& x) {
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) freestand::store(p + i * pack_lanes, x.pack[i]);
}
using freestand::store;

template <class V>
inline V fetch_as(const double* const* p, int offset = 0) {
  V x;
#pragma GCC unroll 4
  for (int i = 0; i < lanes_of<V> / pack_lanes; ++i) x.pack[i] = fetch(p + i * pack_lanes, offset);
  return x;
}

// p[i] += 1, where bit i of `lanes` is set.
template <class V>
inline void advance_as(const double** p, unsigned lanes) {
#pragma GCC unroll 4
  for (int i = 0; i < lanes_of<V> / pack_lanes; ++i)
    advance(p + i * pack_lanes, lanes >> (i * pack_lanes) & ((1U << pack_lanes) - 1));
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
