// Displacement of the floor at any time, exact for the motion as it is stored: d'' = a, d = d' = 0 at the start. A record whose
// baseline is off drifts. After the motion the floor goes on with the velocity that it has left.
#pragma once

#include <algorithm>
#include <vector>

#include "motion/channel.hpp"

namespace freestand::motion {

class FloorDisplacement {
 public:
  explicit FloorDisplacement(const FloorMotion& motion) : motion_(motion) {
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      const Polynomial velocity = integral(segment(motion, motion.horizontal_mps2, i), last_velocity_);
      pieces_.push_back(integral(velocity, last_));
      last_velocity_ = velocity(length(motion, i));
      last_ = pieces_.back()(length(motion, i));
    }
  }

  double operator()(double t) const {
    if (t >= motion_.duration_s()) return last_ + last_velocity_ * (t - motion_.duration_s());
    const std::size_t i = segment_at(motion_, t);
    return pieces_[i](t - motion_.knot_s[i]);
  }
  // Of the floor as one sample feels it [m].
  double operator()(const Shaking& shaking, double t) const {
    return shaking.scale * shaking.stretch * shaking.stretch * (*this)(t / shaking.stretch);
  }

 private:
  const FloorMotion& motion_;
  std::vector<Polynomial> pieces_;
  double last_ = 0, last_velocity_ = 0;
};

}  // namespace freestand::motion
