// The Taylor series of a block that slides flat under a law of friction, or pulled along the floor (see dynamics/contact.hpp):
//     w' = -a - sigma mu_k F g - P,   F of the slip (dynamics/slip_law.hpp), P: spring and drag (dynamics/pack/pull.hpp)
#pragma once

#include "dynamics/pack/pull.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Over the part of an interval that lies ahead, in x = time/hs: speeds times hs, accelerations times hs^2.
template <int N, class Real = double>
struct FlatSeries : Polynomials<Real> {
  Real xi[N + 2], w[N + 2];

  // friction = sigma mu_k g hs^2; to_speed = sigma/hs makes w the speed |w|.
  // per: of the units of the pull to those.
  template <class Factor, class Pull>
  void slide(const Real& friction, const Real& a0, const Real& a1, const Real& to_speed, Factor& factor, Pull& pull,
             const Real& per) {
    factor.expand([&](auto& f) { slide_by(friction, a0, a1, to_speed, f, pull, per); });
  }
  template <class Factor, class Pull>
  void slide_by(const Real& friction, const Real& a0, const Real& a1, const Real& to_speed, Factor& factor, Pull& pull,
                const Real& per) {
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      const Real over(1.0 / (k + 1));
      Real change(0.0);
      if constexpr (Factor::varies) {
        factor.advance(k, to_speed, w[k]);
        change = friction * over * factor.factor()[k];
      } else if (k == 0) {
        change = friction;
      }
      if constexpr (Pull::pulls) change = change + per * over * pull.advance_flat(k, w[k]);
      xi[k + 1] = w[k] * over;
      w[k + 1] = k < 2 ? (k == 0 ? a0 : a1) * (Real(0.0) - over) - change : Real(0.0) - change;
    }
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
