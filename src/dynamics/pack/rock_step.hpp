// One interval of rocking from the derivatives of the equation itself, for short steps.
//
// In the notation of dynamics/pack/rock_series.hpp, with a' = da/dx and f = h^2/J:
//     Omega'     = f (g r_x - a r_y)                       = alpha
//     Omega''    = Q Omega - f a' r_y,                       Q = f (g r_y + a r_x)
//     Omega'''   = alpha K + 2 f a' r_x Omega,               K = Q - Omega^2
//     Omega''''  = Omega'' K - 3 alpha (alpha Omega - f a' r_x) + 2 f a' r_y Omega^2
//     Omega''''' = Omega''' K + Omega'' (4 f a' r_x - 9 alpha Omega) - 3 alpha^3 + 7 f a' r_y Omega alpha
//                  - 2 f a' r_x Omega^3
// each the derivative of the one before, with r_x' = Omega r_y and r_y' = -Omega r_x. The centre of mass is turned by the
// rotation gained: sine and cosine to its seventh power, 1e-15 at 0.03 rad.
#pragma once

#include <type_traits>

#include "base/pack.hpp"
#include "dynamics/pack/rock_series.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct RockStep {
  static constexpr int order = 5;         // of omega
  Pack theta[1], omega[6], rx[1], ry[1];  // the start; omega: all its series

  // As RockSeries::expand.
  [[gnu::always_inline]] void expand(const Pack& gravity, const Pack& a0, const Pack& a1) {
    const Pack two(2.0), three(3.0), w = omega[0], w2 = w * w;
    const Pack sx = a1 * rx[0], sy = a1 * ry[0], pull = gravity * ry[0] + a0 * rx[0], k = pull - w2;
    const Pack alpha = gravity * rx[0] - a0 * ry[0], spin = alpha * w, sxw = sx * w, syw = sy * w;
    const Pack second = pull * w - sy, third = alpha * k + two * sxw;
    const Pack fourth = second * k - three * (alpha * (spin - sx)) + two * (syw * w);
    const Pack fifth = third * k + second * (Pack(4.0) * sx - Pack(9.0) * spin) +
                       alpha * (Pack(7.0) * syw - three * (alpha * alpha)) - two * (sxw * w2);
    omega[1] = alpha;
    omega[2] = second * Pack(1.0 / 2);
    omega[3] = third * Pack(1.0 / 6);
    omega[4] = fourth * Pack(1.0 / 24);
    omega[5] = fifth * Pack(1.0 / 120);
  }

  [[gnu::always_inline]] RockEnd end(const Pack& a_next) const {
    RockEnd end;
    end.omega = omega[0];
    Pack gained = omega[0];
    for (int k = 1; k < 6; ++k) {  // the last term to be known last
      end.omega = end.omega + omega[k];
      gained = gained + omega[k] * Pack(1.0 / (k + 1));
    }
    end.theta = theta[0] + gained;
    turn(gained, end.rx, end.ry);
    end.a = a_next;
    return end;
  }

  Pack omega_at(const Pack& x) const {
    Pack value = omega[5];
    for (int k = 4; k >= 0; --k) value = value * x + omega[k];
    return value;
  }
  Pack theta_at(const Pack& x) const { return theta[0] + gained(x); }
  void arm_at(const Pack& x, Pack& x_arm, Pack& y_arm) const { turn(gained(x), x_arm, y_arm); }
  Pack last() const { return omega[5] * Pack(1.0 / 32); }  // about the first term left out

 private:
  Pack gained(const Pack& x) const {
    Pack value = omega[5] * Pack(1.0 / 6);
    for (int k = 4; k >= 0; --k) value = value * x + omega[k] * Pack(1.0 / (k + 1));
    return value * x;
  }
  [[gnu::always_inline]] void turn(const Pack& angle, Pack& x, Pack& y) const {
    const Pack one(1.0), square = angle * angle;
    const Pack sine = angle * (one - square * (Pack(1.0 / 6) - square * Pack(1.0 / 120)));
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
