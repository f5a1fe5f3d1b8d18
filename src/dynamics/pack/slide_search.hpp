// Where a slip under a piecewise linear record ends, and where the next may start.
//
// In units of the scale, while the block slips in direction sigma from t_0 = (m + tau/h) h on, its speed at knot j is
//     sigma w_j = sigma (V(t_0) - V_j) - G (j - m - tau/h),   G = mu_k g h,   V = int a dt,
// and between knots a parabola, so that the slip ends where V crosses a line. The dip d_j of the table makes sure that no
// knot is passed before which the parabola could reach zero unseen. Within the interval of the start it cannot: the speed
// rises at first, and goes on to, or is concave.
//
// Both searches look at as many knots as most slips and rests last, whether they are needed or not: a branch that is
// mispredicted costs more.
#pragma once

#include <algorithm>
#include <bit>

#include "base/motion_table.hpp"
#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int look = 32;
using Look = ShortRun<look>;

// The line in the table's heights: it falls by `drop` in `look` knots. Both 0 where each knot is to be found.
struct Line {
  int height, drop;
};
constexpr int steepest_drop = 65535;

// i 2^16/look: times `drop`, the upper half of the product is how far the line has fallen after i knots.
struct Ramp {
  alignas(64) std::uint16_t at[look];
  constexpr Ramp() : at() {
    for (int i = 0; i < look; ++i) at[i] = static_cast<std::uint16_t>((i << 16) / look);
  }
};
inline constexpr Ramp ramp;

// The first j at which heights[j] is not below the line, which starts at j = 0.
[[gnu::always_inline]] inline int first_crossing(const std::uint16_t* heights, Line line) {
  const Shorts drop(static_cast<std::uint16_t>(line.drop));
  for (int j = 0;; j += 2 * look) {
    const Shorts start(static_cast<std::uint16_t>(line.height));
    Look near, far;
    for (int i = 0; i < Look::parts; ++i) {
      near.part[i] = xsimd::ssub(start, high_product(Shorts::load_aligned(ramp.at + i * short_lanes), drop));
      far.part[i] = xsimd::ssub(near.part[i], drop);
    }
    const std::uint64_t found =
        bits_not_below(Look(heights + j), near) | std::uint64_t{bits_not_below(Look(heights + j + look), far)} << look;
    if (found) [[likely]]
      return j + std::countr_zero(found);
    line.height = std::max(line.height - 2 * line.drop, 0);
  }
}

// First knot j >= from with levels[j] >= level; `runs` are their largest over level_run of them.
[[gnu::always_inline]] inline unsigned first_loud(const std::uint16_t* levels, const std::uint16_t* runs,
                                                  std::uint16_t level, unsigned from) {
  using Few = ShortRun<level_run>;
  const Few few(level);
  const Look many(level);
  const std::uint32_t near = bits_not_below(Few(levels + from), few);
  unsigned run = from / level_run + 1;
  std::uint32_t far = bits_not_below(Look(runs + run), many);
  while (!(near | far)) far = bits_not_below(Look(runs + (run += look)), many);
  const unsigned start = (run + static_cast<unsigned>(std::countr_zero(far))) * level_run;
  const unsigned here = near ? ~0U : 0U, place = (from & here) | (start & ~here);
  return place + static_cast<unsigned>(std::countr_zero(bits_not_below(Few(levels + place), few)));
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
