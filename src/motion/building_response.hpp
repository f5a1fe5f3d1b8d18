// What the floors of a building do under the motion of the ground.
#pragma once

#include <freestand/floor_motion.hpp>
#include <map>
#include <string>
#include <vector>

#include "motion/building.hpp"

namespace freestand::motion {

// How far a floor's acceleration may lie off the straight lines between its samples, over its peak; and below what share of its peak
// it counts as still behind the record. Its peak is met as well as that. (Lines cut off peaks, which slips on the floor go with: on the second
// and the fourth floor of a building of 0.59 s they lie 0.10 % and 0.04 % low on the average, and 0.3 % at most.)
inline constexpr double usual_straightness = 1e-3;

// Absolute acceleration of floor i: -sum_m G_m phi_im (2 z_m w_m q_m' + w_m^2 q_m), building.hpp. The ground's record is a line from
// sample to sample, for which each mode is solved in closed form (oscillator.hpp), exact to rounding at the samples; these
// lie at the record's, and between them where the floor would be off the lines otherwise. Behind the end of the record
// the ground stands still and the floor comes to rest. A floor moves vertically as the ground does.
class BuildingResponse {
 public:
  // ground: outlives this; samples at equal steps. Throws Error (Exit::usage) where it is no such record, and where a floor would
  // swing for more than an hour after it.
  BuildingResponse(const FloorMotion& ground, std::vector<Mode> modes, double straightness = usual_straightness);

  // The motion of a floor, 0 ... number of modes; 0 is the ground.
  FloorMotion floor(int floor, std::string name);

 private:
  using Histories = std::vector<std::vector<double>>;  // [mode][knot], (2 z w q' + w^2 q)

  double ground_at(const MotionValues& coefficients, std::size_t knot, int parts) const;
  std::size_t tail(int floor, const std::vector<double>& amplitude, double peak) const;
  void look_at_the_shaking();
  const Histories& histories(int parts);
  std::vector<double> acceleration(int floor, int parts);

  const FloorMotion& ground_;
  std::vector<Mode> modes_;
  double straightness_, step_s_;
  std::vector<double> peak_;        // by floor, at the samples of the record
  std::vector<std::size_t> tail_;   // by floor: steps of the record after its end
  std::map<int, Histories> known_;  // by parts of a step of the record
};

// "" where a mode can be excited by the record: a period of at least two of its steps, and no longer than it is. Else why not, without its name.
std::string outside_the_band(const FloorMotion& ground, const std::vector<Mode>& modes);

}  // namespace freestand::motion
