// The plain block of a Specimen by the contact stepper (moreau_stepper.hpp), for tests of src/dynamics.
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

// Of the plain block, impact law `coulomb` always; Specimen::impact, model and effects are not read.
StepperResult step_contacts(const Specimen& specimen, const FloorAt& floor, const StepperSettings& settings);

}  // namespace freestand::test
