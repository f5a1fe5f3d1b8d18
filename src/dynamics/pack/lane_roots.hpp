// Where witnesses fall to zero, of those lanes of a pack of which bounds tell nothing: by the search for single samples.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/lane_extremes.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// zero: of each lane, as ZeroTolerance's acceleration. when: of those that fall within h; the others keep theirs.
template <int N>
PackMask falls_within(const Series<Pack, N>& y, const Pack& h, unsigned lanes, int level, const Pack& zero,
                      Pack& when) {
  if (!lanes) return h < h;
  alignas(64) double tau[pack_lanes];
  store(tau, when);
  const double* numbers = reinterpret_cast<const double*>(&y);
  unsigned falls = 0;
  for (unsigned open = lanes; open; open &= open - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(open));
    double c[N + 1];
    for (int k = 0; k <= N; ++k) c[k] = numbers[static_cast<std::size_t>(k * pack_lanes) + lane];
    const double end = h.get(lane);
    const ZeroTolerance tolerance{level, zero.get(lane)};
    clear_upper_parts();
    double root = 0;
    if (!detail::first_root(c, N, end, tolerance, root)) continue;
    tau[lane] = root;
    falls |= 1U << lane;
  }
  when = load(tau);
  return lanes_of(falls);
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
