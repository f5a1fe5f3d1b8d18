// Friction that depends on the slip speed alone, F(|w|), as the kernels of whole blocks read it: that part of the tape,
// cut out and numbered anew.
#pragma once

#include <optional>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

inline constexpr int speed_law_nodes = 8;

// Place 0 is |w| [m/s]; node i fills place i + 1 from the places before it. The last one is F [1].
struct SpeedLaw {
  Node nodes[speed_law_nodes];
  int count = 0;
  bool fades = false;  // F = p + q exp(r |w| + s): nodes affine, exp, affine
};

// The same operations on the same places: the two differ in constants only, and go in one pack.
bool same_shape(const SpeedLaw& a, const SpeedLaw& b);

// Nothing where the laws are more than such a friction, or ask for operations that packs do not have.
std::optional<SpeedLaw> speed_law(const Laws& laws);

// F(|w|).
double friction_factor(const SpeedLaw& law, double speed);

// By how much the argument of one of its exponentials changes at most while the speed changes by so much [m/s].
double steepest_exponent(const SpeedLaw& law, double change);

}  // namespace freestand::dynamics
