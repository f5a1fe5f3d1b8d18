// What the rows of all groups of lanes have in common.
#pragma once

#include <array>

#include "base/pack.hpp"
#include "dynamics/pack/pool_gravity.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int still_intervals = 16384;
alignas(64) const double still_ground[still_intervals] = {};  // the floor after the record

// Lane `from` of the other rows becomes lane `to` of these.
template <std::size_t Count>
[[gnu::always_inline]] inline void copy_each(const std::array<double*, Count>& mine, int to,
                                             const std::array<double*, Count>& theirs, int from) {
#pragma GCC unroll 64
  for (std::size_t k = 0; k < Count; ++k) mine[k][to] = theirs[k][from];
}
template <class Rows>
void copy_lane(Rows& rows, int to, Rows& other, int from) {
  copy_each(rows.all(), to, other.all(), from);
  if constexpr (requires { rows.law; }) rows.law.copy(to, other.law, from);
  if constexpr (requires { rows.shakes.all(); }) copy_each(rows.shakes.all(), to, other.shakes.all(), from);
  rows.next[to] = other.next[from];
  rows.stop[to] = other.stop[from];
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
