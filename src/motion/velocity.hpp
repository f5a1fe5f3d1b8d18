// Floor velocity at any time, exact, for the fits.
#pragma once

#include <algorithm>
#include <vector>

#include "motion/channel.hpp"

namespace freestand::motion {

class FloorVelocity {
 public:
  explicit FloorVelocity(const FloorMotion& motion) : motion_(motion) {
    double speed = 0;
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      pieces_.push_back(integral(segment(motion, motion.horizontal_mps2, i), speed));
      speed = pieces_.back()(length(motion, i));
    }
  }

  // Within [0, duration].
  double operator()(double t) const {
    const std::size_t i = segment_at(motion_, t);
    return pieces_[i](t - motion_.knot_s[i]);
  }

  // Integral of velocity^2 over the motion.
  double energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Polynomial& v = pieces_[i];
      const double h = length(motion_, i);
      // Gauss-Legendre with 5 points is exact for the records' degree 4, and to 1e-15 for the short segments of pulses.
      constexpr double node[] = {0.0, 0.538469310105683091036, 0.906179845938663992798};
      constexpr double weight[] = {0.568888888888888888889, 0.478628670499366468041, 0.236926885056189087514};
      const auto squared = [&](double x) { return v(h * (1 + x) / 2) * v(h * (1 + x) / 2); };
      sum += h / 2 *
             (weight[0] * squared(0) + weight[1] * (squared(node[1]) + squared(-node[1])) +
              weight[2] * (squared(node[2]) + squared(-node[2])));
    }
    return sum;
  }

 private:
  const FloorMotion& motion_;
  std::vector<Polynomial> pieces_;
};

}  // namespace freestand::motion
