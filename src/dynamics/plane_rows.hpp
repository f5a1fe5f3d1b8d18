// Samples that slide in the plane in packs: a row for each number of PlaneState, a slot for each sample.
#pragma once

#include "dynamics/plane_march.hpp"
#include "dynamics/plane_step.hpp"

namespace freestand::dynamics {

inline constexpr int plane_slots = 16;  // two of the widest packs

class PlaneSample;

struct PlaneRows {
  double tolerance = 0;
  int lanes = 0;
  alignas(64) double numbers[plane_numbers][plane_slots] = {};
  int steps[plane_slots] = {};  // within the segment
  PlaneSample* samples[plane_slots] = {};

  // The sample in that slot goes to its next segment. False: its motion is over.
  bool next_segment(int slot);
};

}  // namespace freestand::dynamics
