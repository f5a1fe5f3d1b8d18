// One step of free rocking over a few knots at once, in packs.
//
// With x = (t - t_j)/T over a flight of T, theta, Omega = T omega and r = (r_x, r_y) = from the pivot to
// the centre of mass (dynamics/pack/rock_series.hpp),
//     Omega' = G r_x - P a(x) r_y,  G = T^2 g/J,  P = T^2/J.
// r turns smoothly even where the floor does not move so, and is expanded as if the floor moved as the parabola q with the
// same moments as a up to the second. The rest of a is orthogonal to parabolas and barely moves r. What it does to the
// rotation itself is then exact but for terms of second order, from the moments M_k = int a x^k dx:
//     Omega(1) = Omega_0 + sum_k r_xk G/(k+1) - r_yk P M_k
//     theta(1) = theta_0 + Omega_0 + sum_k r_xk G/((k+1)(k+2)) - r_yk P (M_k - M_{k+1})
// Over two intervals a is its chord and a hat of height c (`bend`) on the middle knot. The parabola of the hat is
// c (-1 + 30 x - 30 x^2)/8; what is left of it turns r by -P c r_y R(x), R'' = hat - parabola, and that adds
// -(P c)^2 r_x r_y int hat R dx = (P c)^2 r_x r_y/7680 to Omega(1) and half of it to theta(1).
// Errors over two intervals of noise, with T p = 0.025, p = sqrt(g R/J): about 1e-15 rad a step for K = 5.
#pragma once

#include "dynamics/pack/packs.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// int_0^1 x^k (1 - |2x - 1|) dx
constexpr double hat_moment(int k) {
  double half = 0.5;
  for (int i = 0; i < k; ++i) half *= 0.5;  // 2^-(k+1)
  return 2 * ((1 - half) / (k + 1) - (1 - half) / (k + 2));
}

// The floor under a flight; `bend` is zero where the flight is over one interval, or part of one.
template <class V>
struct FlightFloor {
  V start, chord, bend;

  V moment(int k) const { return (start * V(1.0 / (k + 1)) + chord * V(1.0 / (k + 2))) + bend * V(hat_moment(k)); }
};

// The end of a flight, and the angular acceleration where it starts, times T^2.
template <class V>
struct FlightEnd {
  V theta, omega, rx, ry, alpha;
};

template <int K, class V>
[[gnu::always_inline]] inline FlightEnd<V> fly(const V& theta, const V& omega, const V& rx, const V& ry,
                                               const V& gravity, const V& push, const FlightFloor<V>& floor) {
  const V bent = push * floor.bend, bent3 = bent * V(3.75);
  const V pushed[3] = {push * floor.start - bent * V(0.125), push * floor.chord + bent3, V(0.0) - bent3};
  V x[K + 1], y[K + 1], rate[K];
  x[0] = rx, y[0] = ry, rate[0] = omega;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) {
    V turned_x = y[0] * rate[k], turned_y = x[0] * rate[k];
#pragma GCC unroll 16
    for (int i = 1; i <= k; ++i) {
      turned_x = turned_x + y[i] * rate[k - i];
      turned_y = turned_y + x[i] * rate[k - i];
    }
    x[k + 1] = turned_x * V(1.0 / (k + 1));
    y[k + 1] = turned_y * V(-1.0 / (k + 1));
    if (k + 1 < K) {
      V alpha = gravity * x[k];
#pragma GCC unroll 4
      for (int i = 0; i <= 2 && i <= k; ++i) alpha = alpha - pushed[i] * y[k - i];
      rate[k + 1] = alpha * V(1.0 / (k + 1));
    }
  }
  V moment = floor.moment(K), falls = x[K] * V(1.0 / (K + 1)), drops = x[K] * V(1.0 / ((K + 1) * (K + 2)));
  V driven = y[K] * moment, moved = y[K] * (moment - floor.moment(K + 1));
#pragma GCC unroll 16
  for (int k = K - 1; k >= 0; --k) {
    const V later = moment;
    moment = floor.moment(k);
    falls = falls + x[k] * V(1.0 / (k + 1));
    drops = drops + x[k] * V(1.0 / ((k + 1) * (k + 2)));
    driven = driven + y[k] * moment;
    moved = moved + y[k] * (moment - later);
  }
  const V kick = rx * ry * (bent * bent) * V(1.0 / 7680);
  const V turn = omega + (gravity * drops - push * moved) + V(0.5) * kick, turn2 = turn * turn, one(1.0);
  const V turn4 = turn2 * turn2, turn8 = turn4 * turn4;
  const V sine =
      turn * (((one - turn2 * V(1.0 / 6)) + turn4 * (V(1.0 / 120) - turn2 * V(1.0 / 5040))) + turn8 * V(1.0 / 362880));
  const V cosine = ((one - turn2 * V(1.0 / 2)) + turn4 * (V(1.0 / 24) - turn2 * V(1.0 / 720))) +
                   turn8 * (V(1.0 / 40320) - turn2 * V(1.0 / 3628800));
  return {theta + turn, omega + (gravity * falls - push * driven) + kick, rx * cosine + ry * sine,
          ry * cosine - rx * sine, rate[1]};
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
