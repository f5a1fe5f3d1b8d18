// The Taylor series of a block on one corner, stuck or slipping (see dynamics/contact.hpp). Real is double, or a pack.
#pragma once

#include "dynamics/pack/gravity.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// 1 - cos(theta) without loss for small theta, to 1e-15 for |theta| <= 1.6.
template <class Real>
Real versine(const Real& theta) {
  const Real square = theta * theta;
  Real sum(1.0);
#pragma GCC unroll 16
  for (int k = 10; k >= 2; --k) sum = Real(1.0) - square * Real(1.0 / (2 * k * (2 * k - 1))) * sum;
  return Real(0.5) * square * sum;
}

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

// Series over the part of an interval that lies ahead, in x = time/hs: rates times hs, accelerations times hs^2.
template <int N, class Real = double>
struct CornerSeries {
  Real theta[N + 2], omega[N + 2], xi[N + 2], w[N + 2], rx[N + 1], ry[N + 1];

  // Coefficient k of a b.
  [[gnu::always_inline]] static Real product(const Real* a, const Real* b, int k) { return convolution(a, b, k); }
  [[gnu::always_inline]] void integrate(int k, const Real& alpha, const Real& slip) {
    const Real over(1.0 / (k + 1));
    theta[k + 1] = omega[k] * over;
    omega[k + 1] = alpha * over;
    xi[k + 1] = w[k] * over;
    w[k + 1] = slip * over;
    if (k == N) return;
    rx[k + 1] = product(ry, omega, k) * over;
    ry[k + 1] = product(rx, omega, k) * Real(-1.0 / (k + 1));
  }
  // gravity = g' (dynamics/pack/gravity.hpp), a0, a1: times hs^2/J.
  template <class Gravity>
  void rock(const Gravity& gravity, const Real& a0, const Real& a1) {
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      Real alpha = times(rx, k, gravity) - ry[k] * a0;
      if (k > 0) alpha = alpha - ry[k - 1] * a1;
      integrate(k, alpha, Real(0.0));
    }
  }
  // sigma_mu = sigma mu_k; gravity, a0, a1 times hs^2. to_speed = sigma/hs makes w the speed |w| that the factor F on
  // friction may ask for (dynamics/pack/friction.hpp).
  template <class Gravity, class Factor>
  void slide_rock(const Gravity& gravity, const Real& a0, const Real& a1, const Real& k2, const Real& sigma_mu,
                  const Real& to_speed, Factor& factor) {
    Real omega2[N + 1], q[N + 1], n[N + 1], d[N + 1], alpha[N + 1], fy[N + 1], per_d(1.0);
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      factor.advance(k, to_speed * w[k]);
      omega2[k] = product(omega, omega, k);
      q[k] = rx[k] + sigma_mu * factor.times(ry, k);
      n[k] = coefficient(gravity, k) - product(ry, omega2, k);
      d[k] = product(rx, q, k);
      if (k == 0) d[k] = d[k] + k2, per_d = Real(1.0) / d[k];
      Real numerator = product(n, q, k);
      if (k > 0) {
        Real known = d[1] * alpha[k - 1];
#pragma GCC unroll 16
        for (int i = 2; i <= k; ++i) known = known + d[i] * alpha[k - i];
        numerator = numerator - known;
      }
      alpha[k] = numerator * per_d;
      fy[k] = n[k] - product(rx, alpha, k);
      Real slip = product(rx, omega2, k) - sigma_mu * factor.times(fy, k) - product(ry, alpha, k);
      if (k < 2) slip = slip - (k == 0 ? a0 : a1);
      integrate(k, alpha[k], slip);
    }
  }

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
