// The physics: equations of motion of the freestanding block, mode by mode.  [KM05 ch. 6; derived for any k^2, h, b_l,
// b_r]
//
//        theta > 0 clockwise                 r = (r_x, r_y): from the pivot (contact corner) to the centre of mass
//              ____                            r_x = -c cos(theta) + h sin(theta)       d/dt r_x =  omega r_y
//             /    /    r_y ^                  r_y =  c sin(theta) + h cos(theta)       d/dt r_y = -omega r_x
//            /  x /         |                c = +b_r on the right corner, -b_l on the left one
//           /    /          |                uniform block: r_x = -s R sin(phi), r_y = R cos(phi), phi = alpha -
//           |theta|
//      ____/____/_____      +--> r_x
//           pivot, at w = slip speed         floor: a(t) to the right, v(t) up, g' = g + v
//
// Forces on the pivot, per unit mass:  f_x = w' + r_y theta'' - r_x omega^2 + a,   f_y = g' - r_x theta'' - r_y omega^2
// Moments about the centre of mass:    k^2 theta'' = r_x f_y - r_y f_x
//
//   rock        (k^2 + r^2) theta'' = r_x g' - r_y a
//   slide-rock  f_x = -sigma mu f_y,  q = r_x + sigma mu r_y,  n = g' - r_y omega^2:
//               (k^2 + r_x q) theta'' = n q,   w' = -sigma mu f_y - a - r_y theta'' + r_x omega^2,   f_y = n k^2/(k^2 +
//               r_x q)
//   slide       w' = -a - sigma mu g'
//   flight      theta'' = 0, centre of mass (x, y): x'' = -a, y'' = -g'
//
// Coefficient k of the accelerations needs coefficients 0..k of the state, and gives coefficient k + 1 of the state.
#pragma once

#include <cmath>

#include "dynamics/rotation.hpp"
#include "dynamics/series.hpp"

namespace freestand::dynamics {

// Acceleration of the floor and effective gravity [m/s2], about the start of the step.
template <class Real, int N>
struct Floor {
  Series<Real, N> a;  // horizontal
  Series<Real, N> g;  // g' = g + v
};

// Geometry of the block on one corner [m, m2].
template <class Real>
struct Corner {
  Real c;   // signed offset of the corner from the centre of mass
  Real h;   // height of the centre of mass
  Real k2;  // gyration radius squared
};

// One corner down (rock, slide-rock): state, and what follows from it. Also carries slide and rest (theta = 0).
template <class Real, int N>
struct Arc {
  Series<Real, N> theta, omega;  // [rad], [rad/s]
  Series<Real, N> xi, w;         // pivot's displacement [m] and slip speed [m/s] relative to the floor
  Series<Real, N> rx, ry;        // [m]
  Series<Real, N> alpha;         // theta'' [rad/s2], to order N - 1, as all below
  Series<Real, N> fx, fy;        // contact force per unit mass [m/s2]
  Series<Real, N> n;  // g' - r_y omega^2: what presses the corner down when theta'' = 0, slide-rock only [m/s2]
  Series<Real, N> d;  // k^2 + r_x q: Painleve's denominator, slide-rock only [m2]
};

template <class Real, int N>
void start_arc(Arc<Real, N>& y, const Corner<Real>& body, Real theta, Real omega, Real xi, Real w) {
  const Rotation<Real> rotation = rotation_by(theta);
  const Real sine = rotation.sine, cosine = rotation.cosine;
  y.theta[0] = theta;
  y.omega[0] = omega;
  y.xi[0] = xi;
  y.w[0] = w;
  y.rx[0] = body.h * sine - body.c * cosine;
  y.ry[0] = body.c * sine + body.h * cosine;
}

// Kinematics: coefficient k + 1 of the state from coefficient k of its rates.
template <class Real, int N>
[[gnu::always_inline]] inline void integrate_coefficient(Arc<Real, N>& y, const Real& slip_acceleration, int k) {
  const Real one_over = Real(1.0 / (k + 1));
  y.theta[k + 1] = y.omega[k] * one_over;
  y.omega[k + 1] = y.alpha[k] * one_over;
  y.rx[k + 1] = product(y.ry, y.omega, k) * one_over;
  y.ry[k + 1] = -product(y.rx, y.omega, k) * one_over;
  y.xi[k + 1] = y.w[k] * one_over;
  y.w[k + 1] = slip_acceleration * one_over;
}

// The highest force coefficients are not determined by a step of order N.
template <class Real, int N>
void finish_arc(Arc<Real, N>& y) {
  y.alpha[N] = y.fx[N] = y.fy[N] = y.n[N] = y.d[N] = Real(0.0);
}

// Forces from the motion of the centre of mass: f_x = r_x'' + a, f_y = r_y'' + g'.
template <class Real, int N>
void rock(Arc<Real, N>& y, const Floor<Real, N>& floor, const Corner<Real>& body) {
  const Real over_inertia = Real(1.0) / (body.k2 + body.c * body.c + body.h * body.h);
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) {
    y.alpha[k] = (product(y.rx, floor.g, k) - product(y.ry, floor.a, k)) * over_inertia;
    integrate_coefficient(y, Real(0.0), k);
  }
  for (int k = 0; k < N; ++k) {
    const Real last_x = k < N - 1 ? Real(k + 2.0) * y.rx[k + 2] : product(y.ry, y.omega, N);  // coefficient of r'
    const Real last_y = k < N - 1 ? Real(k + 2.0) * y.ry[k + 2] : -product(y.rx, y.omega, N);
    y.fx[k] = Real(k + 1.0) * last_x + floor.a[k];
    y.fy[k] = Real(k + 1.0) * last_y + floor.g[k];
    y.n[k] = y.d[k] = Real(0.0);
  }
  finish_arc(y);
}

template <class Real, int N>
void slide_rock(Arc<Real, N>& y, const Floor<Real, N>& floor, const Corner<Real>& body, const Real& sigma_mu) {
  Series<Real, N> omega2, q;
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) {
    omega2[k] = product(y.omega, y.omega, k);
    q[k] = y.rx[k] + sigma_mu * y.ry[k];
    y.n[k] = floor.g[k] - product(y.ry, omega2, k);
    y.d[k] = product(y.rx, q, k) + (k == 0 ? body.k2 : Real(0.0));
    Real numerator = product(y.n, q, k);
    for (int i = 1; i <= k; ++i) numerator = numerator - y.d[i] * y.alpha[k - i];
    y.alpha[k] = numerator / y.d[0];
    y.fy[k] = y.n[k] - product(y.rx, y.alpha, k);
    y.fx[k] = -sigma_mu * y.fy[k];
    const Real slip_acceleration = y.fx[k] - floor.a[k] - product(y.ry, y.alpha, k) + product(y.rx, omega2, k);
    integrate_coefficient(y, slip_acceleration, k);
  }
  finish_arc(y);
}

// Both corners down, slipping (sigma_mu = sigma mu_k) or at rest (sigma_mu ignored, stuck = true). Polynomials of
// degree floor + 2: exact, not a truncation.
template <class Real, int N>
void flat(Arc<Real, N>& y, const Floor<Real, N>& floor, const Real& sigma_mu, bool stuck) {
  for (int k = 0; k <= N; ++k) y.theta[k] = y.omega[k] = y.alpha[k] = y.d[k] = Real(0.0);
  for (int k = 1; k <= N; ++k) y.rx[k] = y.ry[k] = Real(0.0);
  for (int k = 0; k < N; ++k) {
    const Real one_over = Real(1.0 / (k + 1));
    y.n[k] = y.fy[k] = floor.g[k];
    y.fx[k] = stuck ? floor.a[k] : -sigma_mu * floor.g[k];
    y.xi[k + 1] = y.w[k] * one_over;
    y.w[k + 1] = (y.fx[k] - floor.a[k]) * one_over;
  }
  finish_arc(y);
}

// No corner down. Position of the centre of mass relative to the floor, and the gaps under both corners.
template <class Real, int N>
struct Flight {
  Series<Real, N> x, y, theta;          // [m], [m], [rad]
  Series<Real, N> vx, vy, omega;        // rates
  Series<Real, N> gap_right, gap_left;  // height of the corners above the floor [m]
};

template <class Real, int N>
Series<Real, N> corner_gap(const Flight<Real, N>& f, const Real& c, const Real& h) {
  Series<Real, N> rx, ry, gap;
  const Rotation<Real> rotation = rotation_by(f.theta[0]);
  rx[0] = h * rotation.sine - c * rotation.cosine;
  ry[0] = c * rotation.sine + h * rotation.cosine;
  gap[0] = f.y[0] - ry[0];
  for (int k = 0; k < N; ++k) {
    const Real one_over = Real(1.0 / (k + 1));
    rx[k + 1] = ry[k] * f.omega[0] * one_over;
    ry[k + 1] = -rx[k] * f.omega[0] * one_over;
    gap[k + 1] = f.y[k + 1] - ry[k + 1];
  }
  return gap;
}

template <class Real, int N>
void fly(Flight<Real, N>& f, const Floor<Real, N>& floor, const Real& right, const Real& left, const Real& h) {
  for (int k = 0; k < N; ++k) {
    const Real one_over = Real(1.0 / (k + 1));
    f.x[k + 1] = f.vx[k] * one_over;
    f.vx[k + 1] = -floor.a[k] * one_over;
    f.y[k + 1] = f.vy[k] * one_over;
    f.vy[k + 1] = -floor.g[k] * one_over;
    f.theta[k + 1] = k == 0 ? f.omega[0] : Real(0.0);
    f.omega[k + 1] = Real(0.0);
  }
  f.gap_right = corner_gap(f, right, h);
  f.gap_left = corner_gap(f, Real(-left), h);
}

}  // namespace freestand::dynamics
