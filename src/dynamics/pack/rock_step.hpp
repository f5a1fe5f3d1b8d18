// One interval of rocking from the derivatives of the equation itself, for short steps.
//
// In the notation of dynamics/pack/rock_series.hpp, with a' = da/dx and f = h^2/J:
//     Omega' = f (g r_x - a r_y) = alpha,  Omega'' = Q Omega - f a' r_y,  Q = f (g r_y + a r_x)
// and on, each the derivative of the one before, by r_x' = Omega r_y, r_y' = -Omega r_x and K = Q - Omega^2,
// K' = f a' r_x - 3 Omega alpha, up to the seventh: what is left out is below round-off where a step is 0.02/p long, for an
// eighth more time than up to the fifth, which errs by 3e-11 of the demand. The centre of mass is turned by the rotation
// gained: sine to its seventh power, cosine to its sixth, 4e-15 at 0.06 rad.
#pragma once

#include <type_traits>

#include "base/pack.hpp"
#include "dynamics/pack/rock_series.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct RockStep : Polynomials<Pack> {
  static constexpr int order = 7;                 // of omega
  Pack theta[order + 2], omega[2], rx[1], ry[1];  // the start; theta: all its series, omega: its rate, too
  Pack omega_term(int k) const { return Pack(k + 1.0) * theta[k + 1]; }

  // As RockSeries::expand.
  [[gnu::always_inline]] void expand(const Pack& gravity, const Pack& a0, const Pack& a1) {
    const auto times = [](double factor, const Pack& x) { return Pack(factor) * x; };
    const Pack w = omega[0], w2 = w * w;
    const Pack sx = a1 * rx[0], sy = a1 * ry[0], pull = gravity * ry[0] + a0 * rx[0], k = pull - w2;
    const Pack alpha = gravity * rx[0] - a0 * ry[0], alpha2 = alpha * alpha, spin = alpha * w, sxw = sx * w,
               syw = sy * w;
    const Pack second = pull * w - sy, third = alpha * k + times(2, sxw), k_rate = sx - times(3, spin);  // k_rate: K'
    const Pack fourth = times(3, alpha * (sx - spin)) + times(2, syw * w) + second * k;
    const Pack by_second = sx + times(3, k_rate), by_third = by_second + k_rate, by_fourth = by_third + k_rate;
    const Pack twist = alpha2 + second * w;  // of spin
    const Pack fifth = alpha * (times(7, syw) - times(3, alpha2)) - times(2, sxw * w2) + second * by_second + third * k;
    const Pack sixth = alpha * (times(7, sy * alpha) - times(13, sxw * w)) - times(2, syw * (w2 * w)) +
                       second * (times(11, syw) - times(9, twist + alpha2)) + third * by_third + fourth * k;
    const Pack seventh = sxw * (times(2, w2 * w2) - times(33, alpha2)) - times(21, spin * (sy * w2)) +
                         second * (alpha * (times(25, sy) - times(45, second)) - times(24, sxw * w)) +
                         third * (times(16, syw) - times(30, twist)) + fourth * by_fourth + fifth * k;
    omega[1] = alpha;
    theta[1] = w;
    theta[2] = alpha * Pack(1.0 / 2);
    theta[3] = second * Pack(1.0 / 6);
    theta[4] = third * Pack(1.0 / 24);
    theta[5] = fourth * Pack(1.0 / 120);
    theta[6] = fifth * Pack(1.0 / 720);
    theta[7] = sixth * Pack(1.0 / 5040);
    theta[8] = seventh * Pack(1.0 / 40320);
  }

  [[gnu::always_inline]] RockEnd end(const Pack& a_next) const {
    RockEnd end;
    end.omega = omega[0];
    Pack gained = omega[0];
#pragma GCC unroll 16
    for (int k = 1; k <= order; ++k) {  // the last term to be known last
      gained = gained + theta[k + 1];
      end.omega = end.omega + omega_term(k);
    }
    end.theta = theta[0] + gained;
    turn(gained, end.rx, end.ry);
    end.a = a_next;
    return end;
  }

  Pack omega_at(const Pack& x) const {
    Pack value = omega_term(order);
#pragma GCC unroll 16
    for (int k = order - 1; k >= 0; --k) value = value * x + omega_term(k);
    return value;
  }
  Pack theta_at(const Pack& x) const { return theta[0] + gained(x); }
  void arm_at(const Pack& x, Pack& x_arm, Pack& y_arm) const { turn(gained(x), x_arm, y_arm); }
  Pack last() const { return theta[order + 1] * Pack(1.0 / 4); }  // about the first term left out

 private:
  Pack gained(const Pack& x) const {
    Pack value = theta[order + 1];
#pragma GCC unroll 16
    for (int k = order; k >= 1; --k) value = value * x + theta[k];
    return value * x;
  }
  [[gnu::always_inline]] void turn(const Pack& angle, Pack& x, Pack& y) const {
    const Pack one(1.0), square = angle * angle;
    const Pack sine = angle * (one - square * (Pack(1.0 / 6) - square * (Pack(1.0 / 120) - square * Pack(1.0 / 5040))));
    const Pack lost = square * (Pack(1.0 / 2) - square * (Pack(1.0 / 24) - square * Pack(1.0 / 720)));
    x = rx[0] - (rx[0] * lost - ry[0] * sine);
    y = ry[0] - (ry[0] * lost + rx[0] * sine);
  }
};

// Of the pools for short steps, and for longer ones.
template <int N>
using StepOf = std::conditional_t<(N < 8), RockStep, RockSeries<N>>;

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
