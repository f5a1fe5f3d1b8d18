// Slip in the plane under friction that differs between two directions, x and y: coefficients mu and r mu.
//
// What friction can do is an ellipse, (f_x/mu)^2 + (f_y/(r mu))^2 <= g'^2, and the slip goes along its normal where it does all
// [Zmitrowicz, Int. J. Solids Struct. 25 (1989)]: it takes most from the motion of all that it can do. In q = (w_x, r w_y), whose direction
// e = q/|q| tells the force, f = -mu g' (e_x, r e_y), with A = (a_x, r a_y), F = mu g', m = (1, r^2):
//
//   q_i' = -A_i - F m_i e_i;   in s, ds = dt/v, v = |q|:   dv/ds = -A.q - F sum m_i q_i e_i,   dq_i/ds = -A_i v - F m_i q_i
//
// that is the isotropic equation (plane_slip.hpp) but for one quotient, e. A slip that follows the drive has the direction theta of e with
//   v' = -A.e - F (m_x e_x^2 + m_y e_y^2),   v theta' = A_x e_y - A_y e_x - F (m_y - m_x) e_x e_y = G,
// at first the one in which e grows without turning, e_i = -A_i/(rate + F m_i).
#pragma once

#include "dynamics/plane_slip.hpp"

namespace freestand::dynamics {

struct EllipticGrip {
  double mu = 0;     // along x
  double ratio = 1;  // r: along y over along x

  PlaneVector scaled(const PlaneVector& w) const { return {w.x, ratio * w.y}; }
  double speed(const PlaneVector& w) const { return size(scaled(w)); }  // |q|
  // F times the larger of m.
  double hardest(double g) const { return mu * std::abs(g) * std::fmax(1.0, ratio * ratio); }
};

// The series in s; their `felt2` is the square of the total acceleration, for a block that weighs `weight` at rest [m/s2].
SlipSeries elliptic_slip(const PlaneFloor&, const EllipticGrip&, const PlaneVector& w, const PlaneVector& u,
                         double weight);

// As driven_slip().
bool elliptic_driven_slip(const PlaneFloor&, const EllipticGrip&, const PlaneVector& w, const PlaneVector& u,
                          double weight, double zero, DrivenSlip& found);

// What an impulse of the floor, up by `push`, leaves of a slip.
PlaneVector slip_after_push(const EllipticGrip&, const PlaneVector& w, double push);

// -dv/dt times v, at this instant.
double slows(const PlaneFloor&, const EllipticGrip&, const PlaneVector& w);

}  // namespace freestand::dynamics
