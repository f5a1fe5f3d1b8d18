// A block that slides in the plane of the floor, by impulses in tiny steps (Moreau's time stepping): in each step the momentum
// that the floor brings is taken away by friction as far as the cone of Coulomb's law lets it. It knows no event, no direction of slip
// and no series, and shares no code with src/dynamics.
#pragma once

#include <functional>

namespace freestand::test {

struct PlaneBlock {
  double mu_s = 0, mu_k = 0, g = 9.80665;
  // Friction across a direction that is turned by `axis_rad` from x, over that along it. What it can do is an ellipse, of which it takes what
  // leaves the least of |w - w_free|^2/2 + impulse . w.
  double ratio = 1, axis_rad = 0;
};

struct PlanePush {
  double x = 0, y = 0, up = 0;  // accelerations of the floor [m/s2]
};

struct PlaneAnswer {
  double peak_slip_m = 0, residual_x_m = 0, residual_y_m = 0, path_m = 0;
  double friction_work = 0;  // per mass [m2/s2]
};

// From rest at t = 0 to end_s in `steps` steps.
PlaneAnswer step_in_plane(const PlaneBlock& block, const std::function<PlanePush(double t)>& floor, double end_s,
                          long steps);

// The same at steps and twice as many, extrapolated to a step of zero (the error of the rule goes with the step); `error`: what
// the extrapolation of the peak has changed.
PlaneAnswer step_in_plane_twice(const PlaneBlock& block, const std::function<PlanePush(double t)>& floor, double end_s,
                                long steps, double& error);

}  // namespace freestand::test
