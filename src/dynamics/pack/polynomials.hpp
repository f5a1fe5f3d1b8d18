// Values of polynomials whose coefficients stand in an array, the lowest first: what all series have in common.
#pragma once

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Real>
struct Polynomials {
  // At x = 1.
  template <int M>
  static Real sum(const Real (&c)[M]) {
    Real total = c[M - 1];
#pragma GCC unroll 16
    for (int k = M - 2; k >= 0; --k) total = total + c[k];
    return total;
  }
  template <int M>
  static Real at(const Real (&c)[M], const Real& x) {
    Real value = c[M - 1];
#pragma GCC unroll 16
    for (int k = M - 2; k >= 0; --k) value = value * x + c[k];
    return value;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
