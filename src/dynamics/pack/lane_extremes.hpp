// The largest values of series over the steps of a pack of samples.
#pragma once

#include "base/pack.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// Mask of those lanes.
inline PackMask lanes_of(unsigned which) {
  alignas(64) double mask[pack_lanes];
  for (int l = 0; l < pack_lanes; ++l) mask[l] = which >> l & 1U;
  return load(mask) > Pack(0.0);
}

// max_abs and max_of (roots.hpp) over [0, h] of the lanes wanted: mostly the extreme is at an end of the step or is no new one.
// within: surely no larger than `before`; first, last: the values at the ends.
using Extreme = double (*)(const double* c, int order, double h, double floor);
template <int N>
Pack extreme(const Series<Pack, N>& y, const Pack& h, const PackMask& within, const Pack& first, const Pack& last,
             const Pack& before, unsigned wanted, Extreme search) {
  const Pack at_ends = xsimd::max(before, xsimd::max(first, last));
  unsigned unsure = wanted & ~bits(within | surely_monotonic(y, h));
  if (!unsure) return choose(within, before, at_ends);
  const PackMask surely = within | surely_within_by_ends(y, last, h, before);
  unsure &= ~bits(surely | surely_monotonic_by_ends(y, derivative(y).at(h), h));
  alignas(64) double most[pack_lanes];
  store(most, choose(surely, before, at_ends));
  const double* numbers = reinterpret_cast<const double*>(&y);
  for (unsigned open = unsure; open; open &= open - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(open));
    double c[N + 1];
    for (int k = 0; k <= N; ++k) c[k] = numbers[static_cast<std::size_t>(k * pack_lanes) + lane];
    const double end = h.get(lane), floor = before.get(lane);
    clear_upper_parts();
    most[lane] = search(c, N, end, floor);
  }
  return load(most);
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
