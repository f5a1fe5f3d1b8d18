// Slip of a block that slides in the plane of a floor which moves in both horizontal directions. Vectors a, w, u in that
// plane: floor acceleration, slip velocity, displacement relative to the floor; a and g' = g + v change linearly with time.
//
//   w' = -a - F e,   e = w/|w|,  F = mu_k g',   u' = w
//
// Friction may differ between two directions, x and y: coefficients mu and r mu. What it can do is an ellipse,
// (f_x/mu)^2 + (f_y/(r mu))^2 <= g'^2, and the slip goes along its normal where it does all [Zmitrowicz, Int. J. Solids Struct. 25 (1989)]:
// it takes most from the motion of all that it can do. In q = (w_x, r w_y), e = q/|q|, with A = (a_x, r a_y), m = (1, r^2) the force is
// f = -mu g' (e_x, r e_y), and  q_i' = -A_i - F m_i e_i.
//
// The direction e turns ever faster as the slip comes to its end: in time the equation is singular there. With
//   ds = dt/v,  v = |q|:     dv/ds = -A.q - F (v + (r^2 - 1) q_y^2/v),   dq_i/ds = -A_i v - F m_i q_i,   dt/ds = v,   du/ds = v w
// it is linear in (v, q) where r = 1, no root and no quotient is left, and its end lies at s = infinity, reached exponentially: series
// in s have no radius to fear, and a step takes off a fixed share of the speed. Three pieces of a slip have forms of their own:
//
//  * the end, where r = 1. While a and F hold still,  d/dt (F v - a.w) = -(F^2 - A^2),  A = |a|, so that a slip with A < F ends after
//    T = (F v - a.w)/(F^2 - A^2); what it covers until then follows from three more such sums (see SlipEnd).
//  * the start, and any slip so slow that its direction follows the drive at once: an angle theta of e that is slaved to the speed.
//    In time  v' = -A.e - F (1 + (r^2 - 1) e_y^2),   v theta' = A_x e_y - A_y e_x - F (r^2 - 1) e_x e_y = G,  whose series has
//    theta_k (k v_1 - dG/dtheta) on the left side: no division by v, which may be zero (DrivenSlip).
//  * a floor without friction: polynomials in time.
#pragma once

#include <cmath>

#include "dynamics/series.hpp"

namespace freestand::dynamics {

inline constexpr int plane_order = 10,  // of series in s
    driven_order = 7;                   // and of those in time of slips that follow the drive

template <class Real>
struct Vector2 {
  Real x = Real(0.0), y = Real(0.0);
};
template <class Real>
Real dot(const Vector2<Real>& p, const Vector2<Real>& q) {
  return p.x * q.x + p.y * q.y;
}
using PlaneVector = Vector2<double>;
inline double size(const PlaneVector& p) { return std::sqrt(dot(p, p)); }

// From axes whose x goes along `axis`, a unit vector, to those in which it is given; the same bits where they are the same.
inline PlaneVector turned_back(const PlaneVector& p, const PlaneVector& axis) {
  if (axis.y == 0) return p;
  return {axis.x * p.x - axis.y * p.y, axis.y * p.x + axis.x * p.y};
}

using PlaneSeries = Series<double, plane_order>;

// The floor at an instant: acceleration and effective gravity [m/s2], and their rates.
template <class Real>
struct FloorAt {
  Vector2<Real> a, da;
  Real g, dg;

  FloorAt later(const Real& t) const { return {{a.x + t * da.x, a.y + t * da.y}, da, g + t * dg, dg}; }
};
using PlaneFloor = FloorAt<double>;

// Friction in the axes of its ellipse: mu_k along x, and r.
template <class Real>
struct Grip {
  Real mu, ratio;

  Vector2<Real> scaled(const Vector2<Real>& w) const { return {w.x, ratio * w.y}; }
};
using EllipticGrip = Grip<double>;

// A slip about an instant, as series in s, or `in_time`. t: time since that instant.
template <class Real>
struct SlipSeries {
  Series<Real, plane_order> v, wx, wy, ux, uy, path, t;
  Series<Real, plane_order> felt2;  // total acceleration, squared; of elliptic friction only [m2/s4]
  bool in_time = false;
};

namespace detail {

// Coefficient k of a^2.
template <class Real, int N>
[[gnu::always_inline]] inline Real square(const Series<Real, N>& a, int k) {
  Real sum(0.0);
#pragma GCC unroll 16
  for (int i = 0; 2 * i < k; ++i) sum = sum + a[i] * a[k - i];
  sum = sum + sum;
  return k % 2 == 0 ? sum + a[k / 2] * a[k / 2] : sum;
}
// Coefficient k of a b but for the term with a[0].
template <class Real, int N>
[[gnu::always_inline]] inline Real product_of_rest(const Series<Real, N>& a, const Series<Real, N>& b, int k) {
  Real sum(0.0);
#pragma GCC unroll 16
  for (int i = 1; i <= k; ++i) sum = sum + a[i] * b[k - i];
  return sum;
}

// What friction that differs between two directions adds to the series: z = q_y^2/v, e_y^2 = z/v, and |w|.
template <class Real>
struct EllipticSeries {
  using S = Series<Real, plane_order>;
  const Grip<Real>& grip;
  Real stiff, over_v, over_m_less_1;  // r^2 - 1, 1/v, 1/r^2 - 1
  S qy, qy2, z, e2, size2, size;

  EllipticSeries(const Grip<Real>& g, const Real& v, const Real& wy)
      : grip(g),
        stiff(g.ratio * g.ratio - Real(1.0)),
        over_v(Real(1.0) / v),
        over_m_less_1(Real(1.0) / (g.ratio * g.ratio) - Real(1.0)) {
    qy[0] = g.ratio * wy;
  }
  [[gnu::always_inline]] void to(const S& v, int k) {
    using std::sqrt;
    qy2[k] = square(qy, k);
    z[k] = (qy2[k] - product_of_rest(v, z, k)) * over_v;
    e2[k] = (z[k] - product_of_rest(v, e2, k)) * over_v;
    size2[k] = square(v, k) + over_m_less_1 * qy2[k];
    if (k == 0)
      size[0] = sqrt(size2[0]);
    else if (k == 1)
      size[1] = Real(0.5) * size2[1] / size[0];
    else {
      Real rest = size2[k];
      for (int j = 1; j < k; ++j) rest = rest - size[j] * size[k - j];
      size[k] = Real(0.5) * rest / size[0];
    }
  }
};

}  // namespace detail

// Series in s. w, u at the instant, in the axes of the ellipse; v = |q|, > 0. weight: g' of a floor that does not shake vertically.
template <bool elliptic, bool shaken, class Real>
[[gnu::always_inline]] inline void slip_series(const FloorAt<Real>& floor, const Grip<Real>& grip, const Real& weight,
                                               const Vector2<Real>& w, const Vector2<Real>& u, const Real& v,
                                               SlipSeries<Real>& y) {
  constexpr int N = plane_order;
  using S = Series<Real, N>;
  using detail::product_of_rest;
  using detail::square;
  const Real half(0.5), r = elliptic ? grip.ratio : Real(1.0), over_r = elliptic ? Real(1.0) / r : r;
  const Real Ax = floor.a.x, Ay = r * floor.a.y, Bx = floor.da.x, By = r * floor.da.y;
  const Real F = grip.mu * floor.g, dF = grip.mu * floor.dg, m = r * r;
  detail::EllipticSeries<Real> ellipse(grip, v, w.y);
  S t2, pull;  // t^2; what t multiplies in dv/ds
  S &qx = y.wx, &qy = elliptic ? ellipse.qy : y.wy;
  y.v[0] = v;
  y.wx[0] = w.x, y.wy[0] = w.y;
  y.ux[0] = u.x, y.uy[0] = u.y;
  y.path[0] = y.t[0] = t2[0] = Real(0.0);
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) {
    const Real over(1.0 / (k + 1));
    y.t[k + 1] = y.v[k] * over;
    t2[k + 1] = square(y.t, k + 1);
    Real held = y.v[k];
    if constexpr (elliptic) {
      ellipse.to(y.v, k);
      y.wy[k] = qy[k] * over_r;
      held = held + ellipse.stiff * ellipse.z[k];
      y.path[k + 1] = product(y.v, ellipse.size, k) * over;
    } else {
      y.path[k + 1] = square(y.v, k) * over;
    }
    y.ux[k + 1] = product(y.v, y.wx, k) * over;
    y.uy[k + 1] = product(y.v, y.wy, k) * over;
    pull[k] = Bx * qx[k] + By * qy[k];
    if constexpr (shaken) pull[k] = pull[k] + dF * held;
    y.v[k + 1] = (Real(0.0) - (Ax * qx[k] + Ay * qy[k] + F * held + product_of_rest(y.t, pull, k))) * over;
    Real rubs_x = F * qx[k], rubs_y = F * qy[k];
    if constexpr (shaken) {
      rubs_x = rubs_x + dF * product_of_rest(y.t, qx, k);
      rubs_y = rubs_y + dF * product_of_rest(y.t, qy, k);
    }
    if constexpr (elliptic) rubs_y = m * rubs_y;
    qx[k + 1] = Real(0.0) - (Ax * y.t[k + 1] + half * Bx * t2[k + 1]) - rubs_x * over;
    qy[k + 1] = Real(0.0) - (Ay * y.t[k + 1] + half * By * t2[k + 1]) - rubs_y * over;
  }
  if constexpr (elliptic) {
    ellipse.to(y.v, N);
    y.wy[N] = qy[N] * over_r;
    // F^2 (1 + (r^2 - 1) e_y^2) and the square of g' - g.
    const Real lift = floor.g - weight;
    S F2;
#pragma GCC unroll 16
    for (int k = 0; k <= N; ++k) {
      F2[k] = k == 0 ? F * F : Real(0.0);
      Real more(0.0);
      if constexpr (shaken) {
        F2[k] = F2[k] + dF * (Real(2.0) * F * y.t[k] + dF * t2[k]);
        more = floor.dg * (Real(2.0) * lift * y.t[k] + floor.dg * t2[k]);
        if (k == 0) more = more + lift * lift;
      }
      y.felt2[k] = F2[k] + more + ellipse.stiff * (shaken ? product(F2, ellipse.e2, k) : F2[0] * ellipse.e2[k]);
    }
  }
}

// Where s is at time t after the instant, 0 <= t <= t(s_end).
double place_in_series(const SlipSeries<double>& slip, double t, double s_end);

// What is left of a slip with A < F, the floor as it is at this instant; r = 1.
struct SlipEnd {
  double after_s = 0;    // T
  double path_m = 0;     // length of what it covers
  PlaneVector covers_m;  // and where that leads
};
SlipEnd slip_end(const PlaneVector& a, double F, const PlaneVector& w);

// Series in time of a slip whose direction follows the drive: from rest (w = 0, and A >= F, to within `zero`), or at a speed
// that changes little while the direction settles. False: it does not follow, or not to within `allowed` of its velocity [m/s] for
// the time h. `turned`: angle between q and the direction of the series [rad], or more.
struct DrivenSlip {
  SlipSeries<double> slip;
  double last_angle = 0;  // last coefficient of theta
  double settles = 0;     // the direction does in |q| over this [m/s2]
  double bends =
      0;  // what turning changes of v', over the angle and `settles`; none where friction is the same in all directions
  double turned = 0;
};
bool driven_slip(const PlaneFloor& floor, const EllipticGrip& grip, const PlaneVector& w, const PlaneVector& u,
                 double weight, double zero, double h, double allowed, DrivenSlip& found);

// Series in time of a slip without friction: exact.
SlipSeries<double> free_slip(const PlaneFloor& floor, const PlaneVector& w, const PlaneVector& u);

// What an impulse of the floor, up by `push`, leaves of a slip.
PlaneVector slip_after_push(const EllipticGrip&, const PlaneVector& w, double push);

// -dv/dt times v, at this instant.
double slows(const PlaneFloor&, const EllipticGrip&, const PlaneVector& w);

}  // namespace freestand::dynamics
