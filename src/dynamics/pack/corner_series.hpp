// The Taylor series of a block on one corner, stuck or slipping, for single lanes (see dynamics/contact.hpp).
#pragma once

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Series over the part of an interval that lies ahead, in x = time/hs: rates times hs, accelerations times hs^2.
template <int N>
struct CornerSeries {
  double theta[N + 2], omega[N + 2], xi[N + 2], w[N + 2], rx[N + 1], ry[N + 1];

  static double product(const double* a, const double* b, int k) {
    double sum = a[0] * b[k];
#pragma GCC unroll 16
    for (int i = 1; i <= k; ++i) sum += a[i] * b[k - i];
    return sum;
  }
  void integrate(int k, double alpha, double slip) {
    const double over = 1.0 / (k + 1);
    theta[k + 1] = omega[k] * over;
    omega[k + 1] = alpha * over;
    xi[k + 1] = w[k] * over;
    w[k + 1] = slip * over;
    if (k == N) return;
    rx[k + 1] = product(ry, omega, k) * over;
    ry[k + 1] = -product(rx, omega, k) * over;
  }
  void rock(double gravity, double a0, double a1) {  // times hs^2/J
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      double alpha = rx[k] * gravity - ry[k] * a0;
      if (k > 0) alpha -= ry[k - 1] * a1;
      integrate(k, alpha, 0.0);
    }
  }
  // sigma_mu = sigma mu_k; gravity, a0, a1 times hs^2.
  void slide_rock(double gravity, double a0, double a1, double k2, double sigma_mu) {
    double omega2[N + 1], q[N + 1], n[N + 1], d[N + 1], alpha[N + 1];
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      omega2[k] = product(omega, omega, k);
      q[k] = rx[k] + sigma_mu * ry[k];
      n[k] = (k == 0 ? gravity : 0.0) - product(ry, omega2, k);
      d[k] = product(rx, q, k) + (k == 0 ? k2 : 0.0);
      double numerator = product(n, q, k);
#pragma GCC unroll 16
      for (int i = 1; i <= k; ++i) numerator -= d[i] * alpha[k - i];
      alpha[k] = numerator / d[0];
      const double fy = n[k] - product(rx, alpha, k), a = k == 0 ? a0 : k == 1 ? a1 : 0.0;
      integrate(k, alpha[k], product(rx, omega2, k) - sigma_mu * fy - a - product(ry, alpha, k));
    }
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
