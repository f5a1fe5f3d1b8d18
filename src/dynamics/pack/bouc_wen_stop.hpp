// Where a swing on a Bouc-Wen contact ends: zeros of its speed, a polynomial in time.
#pragma once

#include <cmath>

#include "dynamics/pack/polynomial_root.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Pairs of terms first, then pairs of pairs: short chains.
template <int N>
[[gnu::always_inline]] inline double polynomial(const double* c, double tau) {
  if constexpr (N == 2) {
    return c[0] + tau * (c[1] + tau * c[2]);
  } else {
    const double tau2 = tau * tau, tau4 = tau2 * tau2;
    const auto four = [&](int i) { return (c[i] + c[i + 1] * tau) + (c[i + 2] + c[i + 3] * tau) * tau2; };
    static_assert(N == 8 || N == 12);
    const double high = N == 8 ? c[8] : four(8) + tau4 * c[12];
    return four(0) + tau4 * (four(4) + tau4 * high);
  }
}

// Zero of the speed p, which is positive at 0 and not at `end`; p' = -(A + slope tau + W zeta). Negative: not found.
template <int N>
double quick_stop(const double* p, const double* zeta, double A, double slope, double W, double end) {
  const double square = p[1] * p[1] - 4 * p[0] * p[2];
  if (!(p[0] > 0 && square > 0)) return -1;
  const double sum = std::sqrt(square) - p[1];
  double tau = 2 * p[0] / sum;
  for (int i = 0; i < 5; ++i) {
    if (!(tau > 0 && tau <= end)) return -1;
    const double step = polynomial<N>(p, tau) / (A + slope * tau + W * polynomial<N>(zeta, tau));
    tau += step;
    // Newton's steps go by their squares: after 1e-9 of the contact's own time the next would be 1e-18 of it, below round-off.
    if (step < 1e-9 && step > -1e-9) return tau > 0 && tau <= end ? tau : -1;
  }
  return -1;
}

// First zero in (0, end] of a speed p > 0 just after 0. Negative: none.
template <int N>
double first_stop(const double* p, double end) {
  const double at = first_fall<N>(p, end);
  return at <= end ? at : -1;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
