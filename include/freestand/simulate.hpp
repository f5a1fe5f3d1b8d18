// One sample: a specimen and a floor motion in, a response out.
#pragma once

#include <freestand/floor_motion.hpp>
#include <freestand/response.hpp>
#include <freestand/specimen.hpp>

namespace freestand {

struct Settings {
  double tolerance = 1e-9;       // local error of the dimensionless state, one step
  double free_vibration_s = 60;  // integration goes on until the block is at rest, at most this long after the motion
  int event_limit = 100000;
};

// Taylor integrator of the sweep. Never throws, never allocates unless `history` is given.
Response respond(const Specimen&, const Shaking&, const Settings& = {}, History* history = nullptr);

// Event-driven reference on SUNDIALS ARKODE (explicit Runge-Kutta, order 5) with root finding; stops at every knot of
// the motion. Slow and exact.
Response respond_reference(const Specimen&, const Shaking&, const Settings& = {}, History* history = nullptr);

}  // namespace freestand
