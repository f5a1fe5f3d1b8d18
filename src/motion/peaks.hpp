// Peaks and integrals of a floor motion, exact: the polynomials are integrated, not the samples.
#pragma once

#include <freestand/floor_motion.hpp>
#include <vector>

namespace freestand::motion {

// Peak |acceleration|, |velocity|, |displacement| of the floor, which starts from rest.
struct MotionPeaks {
  double pga_mps2 = 0, pgv_mps = 0, pgd_m = 0;
};

enum class Channel { horizontal, vertical };

// Peaks over [0, duration], found between the knots too. A missing channel has peaks 0.
MotionPeaks peaks(const FloorMotion& motion, Channel channel = Channel::horizontal);

// Peaks of scale * motion(t / stretch): pga |scale|, pgv |scale| stretch, pgd |scale| stretch^2.
MotionPeaks scaled(const MotionPeaks& peaks, double scale, double stretch);

// Velocity and displacement of the floor at equally spaced times 0, step_s, ... up to the end of the motion.
struct FloorHistory {
  double step_s = 0;
  std::vector<double> acceleration_mps2, velocity_mps, displacement_m;
};
FloorHistory floor_history(const FloorMotion& motion, double step_s, Channel channel = Channel::horizontal);

}  // namespace freestand::motion
