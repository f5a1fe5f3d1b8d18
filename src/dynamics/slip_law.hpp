// Friction that depends on the slip alone, F(speed, path, direction), as the kernels of whole blocks read it: that part of the tape,
// cut out and numbered anew.
#pragma once

#include <optional>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

// What it may look at.
struct Slip {
  double speed;   // [m/s]
  double path;    // slid so far [m]
  int direction;  // +1 to the right, -1 to the left
};
enum SlipPlace : int { slip_speed_place, slip_path_place, slip_direction_place, slip_places };
inline constexpr int slip_law_nodes = 12;

// The first places are those of Slip; node i fills place slip_places + i from the places before it. The last one is F [1].
struct SlipLaw {
  Node nodes[slip_law_nodes];
  int count = 0;
  bool sees_path = false, sees_direction = false;
  bool fades = false;  // F = p + q exp(r speed + s): nodes affine, exp, affine

  int place() const { return slip_places + count - 1; }  // of F
};

// The same operations on the same places: the two differ in constants only, and go in one pack.
bool same_shape(const SlipLaw& a, const SlipLaw& b);

// Nothing where the laws are more than such a friction, or less than an operation, or ask for operations that packs do not have.
std::optional<SlipLaw> slip_law(const Laws& laws);

double friction_factor(const SlipLaw& law, const Slip& slip);

// By how much the argument of one of its exponentials changes within a time [s] in which the speed changes by so much [m/s]: the most at
// speeds up to 10 m/s, at the paths 0, 0.1, 1 and 10 m, in both directions.
double steepest_exponent(const SlipLaw& law, double change, double within);

}  // namespace freestand::dynamics
