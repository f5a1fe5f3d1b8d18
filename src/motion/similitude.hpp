// Similitude: a record as the floor of a model of another size feels it.
//
// Lengths go with L = length_scale and times with T = time_scale, so that a(t) becomes
//   a'(t') = L / T^2 a(t' / T).
// Velocities go with L / T, displacements with L. Gravity cannot be scaled: where friction and weight count, L = T^2, and
// accelerations stay as they are. At quarter scale L = 1/4 and T = 1/2  [KM05 ch. 7].
#pragma once

#include <freestand/floor_motion.hpp>
#include <optional>

namespace freestand::motion {

struct Similitude {
  double time = 1, length = 1;

  double acceleration() const { return length / (time * time); }
  bool is_identity() const { return time == 1 && length == 1; }
};

// Where one of the two is given, the other follows from gravity: L = T^2. Both must be above zero.
Similitude similitude(std::optional<double> time_scale, std::optional<double> length_scale);

// Both channels; exact where the scales are powers of two.
FloorMotion at_scale(FloorMotion motion, const Similitude& scale);

}  // namespace freestand::motion
