// The Taylor series of a block on one corner, stuck or slipping (see dynamics/contact.hpp). Real is double, or a pack.
#pragma once

#include "dynamics/pack/gravity.hpp"
#include "dynamics/pack/pull.hpp"

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

// sum_{i>0} a_i b_{k-i}; last = a_k, which may be known last.
template <class Real>
[[gnu::always_inline]] inline Real known(const Real* a, const Real& last, const Real* b, int k) {
  if (k == 1) return last * b[0];
  if (k == 2) return a[1] * b[1] + last * b[0];
  Real sum = a[2] * b[k - 2];
#pragma GCC unroll 16
  for (int i = 3; i < k; ++i) sum = sum + a[i] * b[k - i];
  return (sum + a[1] * b[k - 1]) + last * b[0];
}

// Series over the part of an interval that lies ahead, in x = time/hs: rates times hs, accelerations times hs^2.
template <int N, class Real = double>
struct CornerSeries : Polynomials<Real> {
  Real theta[N + 2], omega[N + 2], xi[N + 2], w[N + 2], rx[N + 1], ry[N + 1];

  // gravity = g' (dynamics/pack/gravity.hpp), a0, a1: times hs^2/J; per: of the units of the pull to those.
  template <class Gravity, class Pull>
  void rock(const Gravity& gravity, const Real& a0, const Real& a1, Pull& pull, const Real& per) {
    Real a[N + 1];  // of the floor and the pull together
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      Real alpha = times(rx, k, gravity);
      if constexpr (Pull::pulls) {
        a[k] = per * pull.advance(k, convolution(ry, omega, k), convolution(rx, omega, k));
        if (k < 2) a[k] = a[k] + (k == 0 ? a0 : a1);
        alpha = alpha - convolution(ry, a, k);
      } else {
        alpha = alpha - ry[k] * a0;
        if (k > 0) alpha = alpha - ry[k - 1] * a1;
      }
      const Real over(1.0 / (k + 1));
      theta[k + 1] = omega[k] * over;
      omega[k + 1] = alpha * over;
      xi[k + 1] = w[k] * over;
      w[k + 1] = Real(0.0);
      if (k == N) break;
      rx[k + 1] = convolution(ry, omega, k) * over;
      ry[k + 1] = convolution(rx, omega, k) * Real(-1.0 / (k + 1));
    }
  }
  // The pull of the corner, per mass: f_y = g' + r_y'' and T = sigma mu_k F f_y, as k^2 omega' = r_x f_y + r_y T; and
  // (w + r_x')' = -T - a. sigma_mu = sigma mu_k; gravity, a0, a1 times hs^2. to_speed = sigma/hs makes w the speed |w|
  // that the factor F on friction may ask for (dynamics/pack/friction.hpp).
  template <class Gravity, class Factor, class Pull>
  void slide_rock(const Gravity& gravity, const Real& a0, const Real& a1, const Real& k2, const Real& sigma_mu,
                  const Real& to_speed, Factor& factor, Pull& pull, const Real& per) {
    factor.expand([&](auto& f) { slide_rock_by(gravity, a0, a1, k2, sigma_mu, to_speed, f, pull, per); });
  }
  template <class Gravity, class Factor, class Pull>
  void slide_rock_by(const Gravity& gravity, const Real& a0, const Real& a1, const Real& k2, const Real& sigma_mu,
                     const Real& to_speed, Factor& factor, Pull& pulls, const Real& per) {
    Real fy[N + 1], pull[N + 1];
    Real mu = sigma_mu;
    if constexpr (Factor::varies) {
      factor.advance(0, to_speed, w[0]);
      mu = mu * factor.factor()[0];
    }
    const Real q = rx[0] + mu * ry[0], per_d = Real(1.0) / (k2 + rx[0] * q);
    const Real q_per_d = q * per_d, ry_per_d = ry[0] * per_d;
    Real ahead_x = ry[0] * omega[0], ahead_y = Real(0.0) - rx[0] * omega[0];  // coefficient k + 1
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      const Real over(1.0 / (k + 1));
      const Real side = known(rx, ahead_x, omega, k + 1), up = known(ry, ahead_y, omega, k + 1);
      const Real n = coefficient(gravity, k) - Real(k + 1.0) * side;
      Real alpha = q_per_d * n, more(0.0);
      if (k > 0) {
        alpha = alpha + (known(rx, rx[k], fy, k) + known(ry, ry[k], pull, k)) * per_d;
        if constexpr (Factor::varies) {
          factor.advance(k, to_speed, w[k]);
          more = sigma_mu * known(factor.factor(), factor.factor()[k], fy, k);
          alpha = alpha + ry_per_d * more;
        }
      }
      fy[k] = n - rx[0] * alpha;
      pull[k] = mu * fy[k];
      if (Factor::varies && k > 0) pull[k] = pull[k] + more;
      Real slip = pull[k];
      if (k < 2) slip = slip + (k == 0 ? a0 : a1);
      if constexpr (Pull::pulls)
        slip = slip + per * pulls.advance_slipping(k, w[k], Real(k + 1.0) * ahead_x, Real(-(k + 1.0)) * ahead_y);
      theta[k + 1] = omega[k] * over;
      omega[k + 1] = alpha * over;
      xi[k + 1] = w[k] * over;
      const Real rate = up + ry[0] * omega[k + 1];
      w[k + 1] = Real(0.0) - rate - slip * over;
      if (k == N) break;
      rx[k + 1] = ahead_x;
      ry[k + 1] = ahead_y;
      ahead_x = rate * Real(1.0 / (k + 2));
      ahead_y = (side + rx[0] * omega[k + 1]) * Real(-1.0 / (k + 2));
    }
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
