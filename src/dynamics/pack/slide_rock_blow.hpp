// The plastic impulse of Coulomb's impact law on one sample of slide-rock: dynamics/impact.cpp, flat and without laws.
#pragma once

#include "dynamics/batch.hpp"
#include "dynamics/pack/corner_constants.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct Blow {
  enum class Ends { regular, flat, painleve };  // flat: both corners take it
  Ends ends;
  double omega, w;  // after it, on the corner that strikes
  double flat;      // slip of a base that stays flat instead
  bool hops() const { return ends != Ends::painleve && omega != 0; }
};

// The block, which rocked on `from` with the rate `omega` while its corner slipped with `w`, strikes with `to`.
inline Blow coulomb_blow(const BatchCase& c, const CornerConstants& from, const CornerConstants& to, double omega,
                         double w) {
  const double vx = w + c.h * omega, vy = from.arm * omega, way = to.arm > 0 ? 1 : -1;  // of the centre of mass
  Blow after{Blow::Ends::regular, (c.k2 * omega + c.h * vx + to.arm * vy) * to.per_inertia, 0, 0};
  const double px = c.h * after.omega - vx, py = to.arm * after.omega - vy;
  if (!(magnitude(px) <= c.mu_s * py)) {
    const double first = px < 0 ? 1 : -1;  // friction opposes the slip
    bool found = false;
    for (const double sigma : {first, -first}) {
      const double sigma_mu = sigma * c.mu_k, q = sigma_mu * c.h - to.arm, d = c.k2 - to.arm * q;
      if (!(d > 0)) continue;
      const double push = (to.arm * omega - vy) * c.k2 / d;
      after.omega = omega + push * q / c.k2;
      after.w = vx - sigma_mu * push - c.h * after.omega;
      if (found = sigma * after.w >= 0; found) break;
    }
    if (!found) return {Blow::Ends::painleve, 0, 0, 0};
  }
  if (!(after.omega * way > 0)) after.omega = 0;
  const double push = magnitude(vy), speed = magnitude(vx), slip = speed - c.mu_k * push;
  after.flat = speed <= c.mu_s * push || slip < 0 ? 0 : vx > 0 ? slip : -slip;
  if (after.omega == 0) after.ends = Blow::Ends::flat;
  return after;
}

// Does the corner that strikes stick, where the other one did not slip? Whatever the rate.
inline bool blow_sticks(const BatchCase& c, const CornerConstants& from, const CornerConstants& to) {
  const double rate = from.arm > 0 ? -1 : 1, after = from.kept * rate;
  return after != 0 && magnitude(c.h * (after - rate)) <= 0.999999 * c.mu_s * (to.arm * after - from.arm * rate);
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
