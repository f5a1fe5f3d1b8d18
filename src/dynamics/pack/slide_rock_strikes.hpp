// Impacts of blocks that rock, in packs: the corner that comes down, the rates after, and the forces there.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/lane_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// What a pack of impacts asks of its blocks. Mirrored so that the corner that comes down is the right one; time is counted
// in intervals.
struct StrikeRows {
  alignas(64) double gravity[pack_lanes], push[pack_lanes];                                   // as in SlideRockRows
  alignas(64) double curvature0[pack_lanes], curvature1[pack_lanes], curvature2[pack_lanes];  // as in SlideRockRows
  alignas(64) double arm[pack_lanes], height[pack_lanes];  // from the corner to the centre of mass
  alignas(64) double kept[pack_lanes];                     // of the rate
  alignas(64) double told[pack_lanes];                     // squared rate before, of impacts that count
  alignas(64) double rests[pack_lanes];                    // squared rate after, under which all ends
  alignas(64) double peak[pack_lanes], shift[pack_lanes];  // slip: the largest so far; xi
  alignas(64) double limit2[pack_lanes];                   // squared rotation of small hops
  alignas(64) double row[pack_lanes], slow[pack_lanes], last_told[pack_lanes];  // rows of hops: see HopBounds
  alignas(64) double fx[pack_lanes], fx1[pack_lanes], lift[pack_lanes], lift1[pack_lanes];
  alignas(64) double tips[pack_lanes];
};

// An impact of one block.
struct Impact {
  double part, rate;    // of what is left of the interval; per interval
  double turned, slid;  // largest rotation and slip so far
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
