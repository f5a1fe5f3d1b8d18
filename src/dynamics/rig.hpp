// The specimen as the kernel reads it, and the state that it integrates.
#pragma once

#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <freestand/specimen.hpp>

#include "base/units.hpp"
#include "dynamics/contact.hpp"

namespace freestand::dynamics {

struct Rig {
  double right, left, h, k2;  // [m], [m2]
  double mu_s, mu_k;
  bool can_slip, can_rock;
  Impact impact;
  double g = standard_gravity_mps2;
  // Thresholds, all scaled by the block.
  double force_zero;     // accelerations smaller than this are round-off [m/s2]
  double turn_zero;      // angular accelerations smaller than this are round-off [rad/s2]
  double rest_rotation;  // a hop of less than this rotation ends the rocking [rad]
  double told_rotation;  // an impact after a rotation of less than this is not counted [rad]

  Rig(const Specimen& specimen, const Settings& settings)
      : right(specimen.block.right_m),
        left(specimen.block.left_m),
        h(specimen.block.height_m),
        k2(specimen.block.gyration2_m2),
        mu_s(specimen.friction.mu_s),
        mu_k(specimen.friction.mu_k),
        can_slip(specimen.model != Model::rock),
        can_rock(specimen.model != Model::slide),
        impact(specimen.impact),
        force_zero(1e-11 * g),
        turn_zero(force_zero / specimen.block.size_m()),
        rest_rotation(settings.tolerance),
        told_rotation(1e-3 * specimen.block.alpha_rad()) {}

  // No floor acceleration with |a| <= a_max, |v| <= v_max can move the block from rest.
  bool stays_put(double a_max, double v_max) const {
    const double push = g - v_max;
    return (!can_slip || a_max < mu_s * push) && (!can_rock || h * a_max < (right < left ? right : left) * push) &&
           push > 0;
  }

  double offset(int pivot) const { return pivot > 0 ? right : -left; }
  Corner<double> corner(int pivot) const { return {offset(pivot), h, k2}; }
  double half_base() const { return 0.5 * (right + left); }
  double inertia(int pivot) const { return k2 + h * h + offset(pivot) * offset(pivot); }  // about the pivot, per mass

  // Largest rotation of a free hop that starts flat with rate omega: (1/2) J omega^2 = g |c| theta.
  double hop_rotation(int pivot, double omega) const {
    const double c = offset(pivot);
    return inertia(pivot) * omega * omega / (2 * g * (c < 0 ? -c : c));
  }
};

// Where the block is. `pivot`: +1 right corner, -1 left corner, 0 both or none. `sigma`: direction of slip, 0 when
// stuck.
struct State {
  Mode mode = Mode::rest;
  int pivot = 0;
  int sigma = 0;
  double theta = 0, omega = 0;  // [rad], [rad/s]
  double xi = 0, w = 0;         // contact's displacement and slip speed, when a corner is down [m], [m/s]
  double x = 0, vx = 0;         // centre of mass relative to the floor, in flight [m], [m/s]
  double y = 0, vy = 0;
  double doubt = 1;  // by how much more than round-off the last choice of mode took for zero
};

}  // namespace freestand::dynamics
