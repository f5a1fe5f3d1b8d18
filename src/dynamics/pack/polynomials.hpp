// Values of polynomials whose coefficients stand in an array, the lowest first: what all series have in common.
#pragma once

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// sum_i a_i b_{k-i}, those terms last that are known last, so that little waits for them.
template <class Real>
[[gnu::always_inline]] inline Real convolution(const Real* a, const Real* b, int k) {
  if (k == 0) return a[0] * b[0];
  if (k == 1) return a[0] * b[1] + a[1] * b[0];
  Real sum = a[1] * b[k - 1];
#pragma GCC unroll 16
  for (int i = 2; i < k; ++i) sum = sum + a[i] * b[k - i];
  return sum + (a[0] * b[k] + a[k] * b[0]);
}

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
  // Of the derivative.
  template <int M>
  static Real rate_at(const Real (&c)[M], const Real& x) {
    Real value = Real(double(M - 1)) * c[M - 1];
#pragma GCC unroll 16
    for (int k = M - 2; k >= 1; --k) value = value * x + Real(double(k)) * c[k];
    return value;
  }
  template <int M>
  static Real rate_sum(const Real (&c)[M]) {
    Real total = Real(double(M - 1)) * c[M - 1];
#pragma GCC unroll 16
    for (int k = M - 2; k >= 1; --k) total = total + Real(double(k)) * c[k];
    return total;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
