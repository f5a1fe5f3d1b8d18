// Nonlinear refinement of one pulse's fit to a velocity history.
#pragma once

#include "motion/pulse.hpp"
#include "motion/velocity.hpp"

namespace freestand::motion {

struct PulseFit {
  double period_s = 0, velocity_mps = 0, start_s = 0;
  double gain = 0;  // what the pulse takes off the integral of velocity^2 [m2/s]
};

// Least squares in period, amplitude and start from a first guess (Levenberg-Marquardt of GSL, exact derivatives), over
// the guess's neighbourhood inside [0, duration_s]. Falls back on the guess where the fit runs away from it.
PulseFit refine(const FloorVelocity& velocity, double duration_s, const Pulse& pulse, const PulseFit& guess);

}  // namespace freestand::motion
