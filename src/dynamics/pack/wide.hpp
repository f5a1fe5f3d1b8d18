// Several packs side by side, worked on in turns: where each operation waits for the one before, the packs fill each
// other's gaps.
#pragma once

#include "dynamics/pack/power.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int wide_packs = 2, wide_lanes = wide_packs * pack_lanes;

struct Wide {
  Pack pack[wide_packs];
  Wide() = default;
  explicit Wide(double x) {
    for (Pack& one : pack) one = Pack(x);
  }
};

template <class Operation>
inline Wide each(const Wide& a, const Wide& b, Operation&& operation) {
  Wide c;
  for (int i = 0; i < wide_packs; ++i) c.pack[i] = operation(a.pack[i], b.pack[i]);
  return c;
}
inline Wide operator+(const Wide& a, const Wide& b) {
  return each(a, b, [](const Pack& x, const Pack& y) { return x + y; });
}
inline Wide operator-(const Wide& a, const Wide& b) {
  return each(a, b, [](const Pack& x, const Pack& y) { return x - y; });
}
inline Wide operator*(const Wide& a, const Wide& b) {
  return each(a, b, [](const Pack& x, const Pack& y) { return x * y; });
}
inline Wide operator/(const Wide& a, const Wide& b) {
  return each(a, b, [](const Pack& x, const Pack& y) { return x / y; });
}
inline Wide larger(const Wide& a, const Wide& b) {
  return each(a, b, [](const Pack& x, const Pack& y) { return xsimd::max(x, y); });
}
inline Wide smaller(const Wide& a, const Wide& b) {
  return each(a, b, [](const Pack& x, const Pack& y) { return xsimd::min(x, y); });
}
inline Wide magnitude(const Wide& a) {
  return each(a, a, [](const Pack& x, const Pack&) { return xsimd::abs(x); });
}
inline Wide power_of(const Wide& a, const Wide& n) {
  return each(a, n, [](const Pack& x, const Pack& y) { return power_of(x, y); });
}
inline Wide eighth_root(const Wide& a) {
  return each(a, a, [](const Pack& x, const Pack&) { return eighth_root(x); });
}

// Bit i: lane i holds.
inline unsigned operator>(const Wide& a, const Wide& b) {
  unsigned all = 0;
  for (int i = 0; i < wide_packs; ++i) all |= bits(a.pack[i] > b.pack[i]) << (i * pack_lanes);
  return all;
}
inline unsigned operator>=(const Wide& a, const Wide& b) {
  unsigned all = 0;
  for (int i = 0; i < wide_packs; ++i) all |= bits(a.pack[i] >= b.pack[i]) << (i * pack_lanes);
  return all;
}

inline Wide wide(const double* p) {
  Wide x;
  for (int i = 0; i < wide_packs; ++i) x.pack[i] = load(p + i * pack_lanes);
  return x;
}
inline void put(double* p, const Wide& x) {
  for (int i = 0; i < wide_packs; ++i) store(p + i * pack_lanes, x.pack[i]);
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
