// Elastoplastic contact after Bouc and Wen for a block that only slides  [KM05 6.27-6.30].
//
//   u_y z' + gamma |u'| z |z|^(n-1) + beta u' |z|^n - u' = 0,   u'' + mu g' z = -a
//
// The law does not know time: dz/du = (1 - |z|^n (beta + gamma)) / u_y while |z| grows (loading), and
// (1 - |z|^n (beta - gamma)) / u_y while it falls (unloading). The scaling zeta = z/z_u with z_u = (beta + gamma)^(-1/n)
// leaves one parameter:
//
//   y zeta' = u' (1 - f q),  q = |zeta|^n,  y = u_y z_u,  G = mu z_u g',   u'' + G zeta = -a
//   f = 1 in loading,  f = kappa = (beta - gamma)/(beta + gamma) <= 0 in unloading;  gamma = beta: kappa = 0
//
// so u = u_p + y zeta splits into a slip u_p that remains and an elastic part. u_p' = f q u', and |zeta| <= 1.
#pragma once

#include <cmath>
#include <freestand/specimen.hpp>

#include "dynamics/series.hpp"

namespace freestand::dynamics {

struct BoucWenContact {
  double yield;     // y [m]
  double strength;  // mu z_u [1]
  double n;         // exponent
  double kappa;     // factor of q in unloading
  // Within the tolerance of the integration:
  double linear;     // below this |zeta| the contact is elastic in loading too
  double saturated;  // 1 - q below this is zero: the block slides as Coulomb's does
  double sliding;    // |zeta| at which q = 3/4: the contact is said to slide beyond

  double q(double zeta) const { return std::pow(std::fabs(zeta), n); }
};

// Scaled contact, for integrations to the tolerance (of the dimensionless state).
BoucWenContact bouc_wen_contact(double mu, const BoucWen& law, double tolerance);

// How the contact moves during one step. In loading and sliding the block moves in the direction in which zeta grows.
enum class ContactPhase {
  elastic,    // zeta' = u'/y: unloading with kappa = 0, or |zeta| <= linear
  yielding,   // zeta' = u' (1 - q)/y
  returning,  // zeta' = u' (1 - kappa q)/y: unloading with kappa < 0
  sliding     // zeta = 1
};

// The state over one step, all in the direction of the motion: v >= 0; mirrored motions have the same arc.
template <int N>
struct BoucWenArc {
  Series<double, N> v;     // u' [m/s]
  Series<double, N> zeta;  // [1]
  Series<double, N> slip;  // u_p since the start of the step [m]
  Series<double, N> q;     // |zeta|^n, where it is not constant [1]
  Series<double, N> hold;  // what holds the block back, per mass, to order N - 1 [m/s2]
};

// Coefficients of one step. a: acceleration of the floor, in the direction of the motion. hold(k): coefficient k of what
// holds the block back, G zeta and the forces of effects, from the coefficients 0 ... k of the arc. The start, arc.v[0],
// arc.zeta[0], arc.q[0], is set; arc.slip[0] = 0.
template <ContactPhase phase, int N, class Hold>
void fill(BoucWenArc<N>& arc, const Series<double, N>& a, const BoucWenContact& contact, Hold&& hold) {
  const double over_yield = 1 / contact.yield;
  const double f = phase == ContactPhase::returning ? contact.kappa : 1.0;
  const bool curved = phase == ContactPhase::yielding || phase == ContactPhase::returning;
  const double over_zeta = curved ? 1 / arc.zeta[0] : 0.0;
  arc.slip[0] = 0;
  for (int k = 0; k < N; ++k) {
    const double over = 1.0 / (k + 1);
    arc.hold[k] = hold(k);
    arc.v[k + 1] = -(a[k] + arc.hold[k]) * over;
    if constexpr (phase == ContactPhase::sliding) {
      arc.slip[k + 1] = arc.v[k] * over;
      arc.zeta[k + 1] = 0;
    } else if constexpr (phase == ContactPhase::elastic) {
      arc.slip[k + 1] = 0;
      arc.zeta[k + 1] = arc.v[k] * over * over_yield;
    } else {
      const double plastic = f * product(arc.v, arc.q, k);
      arc.slip[k + 1] = plastic * over;
      arc.zeta[k + 1] = (arc.v[k] - plastic) * over * over_yield;
      // zeta q' = n q zeta'
      double sum = contact.n * (k + 1) * arc.q[0] * arc.zeta[k + 1];
      for (int j = 1; j <= k; ++j) sum += (contact.n * (k + 1 - j) - j) * arc.q[j] * arc.zeta[k + 1 - j];
      arc.q[k + 1] = sum * over * over_zeta;
    }
  }
  arc.hold[N] = 0;
}

}  // namespace freestand::dynamics
