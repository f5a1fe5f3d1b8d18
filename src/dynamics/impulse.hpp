// A blow on a corner that keeps its place: angular momentum about it is conserved (impact.hpp). Real is double, or a pack.
#pragma once

namespace freestand::dynamics {

template <class Real>
struct Velocity {
  Real vx, vy, omega;  // of the centre of mass, and rotation
};

template <class Real>
struct Arm {
  Real rx, ry;  // corner to centre of mass
};

template <class Real>
Velocity<Real> at_centre(const Arm<Real>& r, const Real& w, const Real& omega) {
  return {w + r.ry * omega, -r.rx * omega, omega};
}

// M: share of the mass that moves sideways.
template <class Real>
Velocity<Real> stick(const Real& k2, const Real& M, const Arm<Real>& r, const Velocity<Real>& before) {
  const Real omega =
      (k2 * before.omega + M * r.ry * before.vx - r.rx * before.vy) / (k2 + r.rx * r.rx + M * r.ry * r.ry);
  return at_centre(r, Real(0.0), omega);
}

// Impulse on the corner, per mass.
template <class Real>
struct Impulse {
  Real px, py;
};
template <class Real>
Impulse<Real> impulse(const Real& M, const Velocity<Real>& before, const Velocity<Real>& after) {
  return {M * (after.vx - before.vx), after.vy - before.vy};
}

// Largest rotation of a free hop that starts flat with rate omega: (1/2) J omega^2 = g |c| theta. inertia: J, about the corner.
template <class Real>
Real hop_rotation(const Real& inertia, const Real& omega, const Real& g, const Real& c) {
  using std::abs;
  return inertia * omega * omega / (Real(2.0) * g * abs(c));
}

}  // namespace freestand::dynamics
