// Where a slip under a piecewise linear record ends.
//
// In units of the scale, while the block slips in direction sigma from t_0 = (m + tau/h) h on, its speed at knot j is
//     sigma w_j = sigma (V(t_0) - V_j) - G (j - m - tau/h),   G = mu_k g h,   V = int a dt,
// and between knots a parabola, so that the slip ends where V crosses a line. The dip d_j of the table makes sure that no
// knot is passed before which the parabola could reach zero unseen. Within the interval of the start it cannot: the speed
// rises at first, and goes on to, or is concave.
#pragma once

#include "base/motion_table.hpp"
#include "base/pack.hpp"
#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Of the line and of its drop: more than the search rounds, so that it passes no knot.
inline constexpr double line_slack = 1e-6;

// First knot j >= from at which sigma w_j <= d_j, or almost; `knots`: none. `row` is sigma V_j + d_j, `line` is
// sigma V(t_0) - G (from - m - tau/h), and `drop` is G. Many knots at a time, whether they are needed or not, so that the
// processor can go on to the next search meanwhile.
inline int first_crossing(const float* row, float line, float drop, int from, int knots) {
  constexpr int look = 64;
  alignas(64) static constexpr float ramp[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const Floats slope(drop), step(drop * float_lanes);
  for (int j = from; j < knots; j += look) {
    Floats at = Floats(line - drop * static_cast<float>(j - from)) - slope * Floats::load_aligned(ramp);
    std::uint64_t found = 0;
    for (int i = 0; i < look; i += float_lanes) {
      found |= bits(at <= Floats::load_unaligned(row + j + i)) << i;
      at = at - step;
    }
    if (found) return j + __builtin_ctzll(found);
  }
  return knots;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
