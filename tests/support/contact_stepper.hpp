// Independent simulator of the freestanding rigid block: time-stepping with contact impulses.
//
// It shares nothing with src/dynamics. State: centre of mass (X, Y) and rotation theta (clockwise) in the frame of the
// floor; no modes, no pivots, no events. In every step of fixed length dt the velocity v = (X', Y', theta') changes by
//   v+ = v + dt (-a, -(g + v_floor), 0) + M^-1 J^T p,     M = m diag(1, 1, k^2),
// where p are the impulses at the corners that are closed (or would close) in the step. They obey, corner by corner,
//   normal:   0 <= p_n  perpendicular to  J_n v+ >= 0                     (plastic: no rebound)
//   friction: p_t = -mu p_n sgn(J_t v+), or J_t v+ = 0 and |p_t| <= mu p_n  (Coulomb)
// (Moreau 1988, Stewart & Trinkle 1996). The problem has at most two corners; it is solved exactly by trying the cases
// {no corner, left, right, both} x {stick, slip to the right, slip to the left} and taking the consistent one.
// J is taken at the middle of the step for the impulses and at its end for the velocities, so smooth motion is followed
// to second order in dt. A step in which a corner meets the floor, or slip begins, stops or reverses, is cut there.
// A corner that carries is put back on the floor after each step, one that sticks is put back to where it stuck.
//
// Static friction above kinetic friction (mu_s > mu_k), stated since Coulomb's law with two coefficients has no unique
// form. A contact that stuck, or that closes in this step (an impact), tries to stick with mu_s first, then slips with
// mu_k. A contact that slipped goes on slipping with mu_k in its direction while that is consistent; when it would
// reverse it tries to stick with mu_s, and reverses with mu_k otherwise. Both corners closed and stuck: only the sum of
// the two friction forces is determined, and it is bounded by mu_s times the sum of the normal forces.
//
// Impact law: the `coulomb` one, always; Specimen::impact and Specimen::model are not read.
#pragma once

#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>
#include <functional>
#include <vector>

namespace freestand::test {

// Acceleration of the floor [m/s2], vertical up positive.
struct FloorAcceleration {
  double horizontal_mps2 = 0, vertical_mps2 = 0;
};
using FloorAt = std::function<FloorAcceleration(double time_s)>;

// Floor acceleration of a Shaking, evaluated here from its coefficients; quick where times follow each other closely.
// The FloorMotion must outlive the result.
FloorAt floor_of(const Shaking& shaking);

struct StepperSettings {
  double step_s = 4e-6;
  double end_time_s = 1;
  double output_step_s = 1e-3;  // a multiple of step_s
};

struct StepperPoint {
  double time_s;
  double slip_m;        // displacement of the midpoint of the base relative to the floor
  double rotation_rad;  // clockwise
  double rotation_rate_radps;
  double contact_speed_mps;  // slip of the closed corners; 0: stuck, or nothing closed
  bool left_closed, right_closed;
};

struct StepperResult {
  double peak_slip_m = 0, peak_rotation_rad = 0;
  double residual_slip_m = 0, residual_rotation_rad = 0;
  double slid_path_m = 0;        // integral of |slip speed| of the closed corner
  bool overturned = false;       // |theta| > pi/2; the run ends there
  bool inconsistent = false;     // no case was consistent; the run ends there
  bool flew = false;             // no corner closed at some time
  bool slide_rocked = false;     // one corner closed and slipping at some time
  bool slipping_impact = false;  // a corner closed at more than 1 cm/s and kept slipping
  int impacts = 0;               // a corner closed at more than 1 mm/s
  std::vector<StepperPoint> points;
};

StepperResult step_contacts(const Specimen& specimen, const FloorAt& floor, const StepperSettings& settings);

}  // namespace freestand::test
