// Blocks that rock in small hops, side by side (dynamics/pack/hopping.hpp). Time is counted in intervals h.
#pragma once

#include "dynamics/pack/corner_constants.hpp"
#include "dynamics/pack/lane_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Small hops; [0] on the left corner, [1] on the right one. Rotations are positive away from the floor.
template <class Field>
struct HopRows {
  using Gravity = Field;
  alignas(64) double theta[march_slots], omega[march_slots], side[march_slots];
  alignas(64) double a[march_slots];                          // unit record, where the lane is, and the slope
  alignas(64) double slope[march_slots];                      // as in SlideRockRows
  alignas(64) double fraction[march_slots];                   // part of the interval that lies ahead
  alignas(64) double limit2[march_slots], push[march_slots];  // four times a squared rotation; |a| of the unit record
  alignas(64) double weight[2][march_slots], tip[2][march_slots], kappa[2][march_slots], kappa_by_a[2][march_slots];
  alignas(64) double kept[2][march_slots], told[2][march_slots], rests[2][march_slots];  // squared rates but the first
  alignas(64) double hops[march_slots], impacts[march_slots], ended[march_slots];        // impacts: those that count
  alignas(64) const double* next[march_slots];                                           // a at the end of the interval
  const double* stop[march_slots];                                                       // the last such value
  typename Gravity::HopRows shakes;

  // What pulls the block back on corner k.
  void stand(int k, int i, const CornerConstants& corner, double scale, double h2) {
    weight[k][i] = corner.weight * h2;
    tip[k][i] = corner.tip * scale * h2;
    kappa[k][i] = corner.kappa * h2;
    kappa_by_a[k][i] = corner.kappa_by_a * scale * h2;
    kept[k][i] = corner.kept;
    told[k][i] = corner.told * h2;
    rests[k][i] = corner.rests * h2;
  }
  void retire(int i) { push[i] = -1; }
  auto all() {
    return std::array{theta,         omega,   side,    a,        slope,     fraction, limit2,
                      push,          hops,    impacts, ended,    weight[0], tip[0],   kappa[0],
                      kappa_by_a[0], kept[0], told[0], rests[0], weight[1], tip[1],   kappa[1],
                      kappa_by_a[1], kept[1], told[1], rests[1]};
  }
};

constexpr double hops_at_once = 16;  // until it is asked whether a row of hops dies out

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
