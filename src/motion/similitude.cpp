#include "motion/similitude.hpp"

#include <cmath>

#include "motion/channel.hpp"

namespace freestand::motion {

Similitude similitude(std::optional<double> time_scale, std::optional<double> length_scale) {
  if (!time_scale && !length_scale) return {};
  Similitude scale;
  scale.time = time_scale ? *time_scale : std::sqrt(*length_scale);
  scale.length = length_scale ? *length_scale : *time_scale * *time_scale;
  return scale;
}

FloorMotion at_scale(FloorMotion motion, const Similitude& scale) {
  if (scale.is_identity()) return motion;
  for (double& knot : motion.knot_s) knot *= scale.time;
  const auto terms = static_cast<std::size_t>(motion.degree) + 1;
  for (MotionValues* channel : channels(motion))
    for (std::size_t first = 0; first < channel->size(); first += terms) {
      double factor = scale.acceleration();  // of t^k: L / T^(2 + k)
      for (std::size_t k = 0; k < terms; ++k, factor /= scale.time) (*channel)[first + k] *= factor;
    }
  index_runs(motion);
  return motion;
}

}  // namespace freestand::motion
