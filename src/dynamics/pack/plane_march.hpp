// Slips in the plane, two packs of samples at once, each at its own time and in its own step, while they are in full swing.
#pragma once

#include "dynamics/pack/lane_extremes.hpp"
#include "dynamics/pack/outside.hpp"
#include "dynamics/pack/twin.hpp"
#include "dynamics/plane_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// For OnePlane of plane_step.hpp, lane by lane.
struct TwinPlane {
  static Twin choose(const TwinMask& which, const Twin& yes, const Twin& no) {
    return FREESTAND_ISA::choose(which, yes, no);
  }
  static bool any(const TwinMask& which) { return bits(which) != 0; }
  static Twin sqrt(const Twin& x) { return {xsimd::sqrt(x.a), xsimd::sqrt(x.b)}; }
  static Twin root(const TwinMask& which, const Twin& x, double degree) {
    alignas(64) double each[twin_lanes];
    store(each, x);
    for (unsigned open = bits(which); open; open &= open - 1) {
      double& one = each[__builtin_ctz(open)];
      one = pow_outside(one, 1 / degree);
    }
    return load_twin(each);
  }
  static Twin most(const TwinMask& which, const Series<Twin, plane_order>& y, const Twin& h, const Twin& floor) {
    Series<Pack, plane_order> a, b;
    for (int k = 0; k <= plane_order; ++k) a[k] = y[k].a, b[k] = y[k].b;
    return {most_of(which.a, a, h.a, floor.a), most_of(which.b, b, h.b, floor.b)};
  }

 private:
  static Pack most_of(const PackMask& which, const Series<Pack, plane_order>& y, const Pack& h, const Pack& floor) {
    const unsigned wanted = freestand::bits(which);
    return wanted ? extreme(y, h, surely_within(y, h, floor), y[0], y.at(h), floor, wanted, detail::max_of) : floor;
  }
};

template <bool elliptic, bool shaken>
unsigned plane_march(PlaneRows& rows) {
  PlaneState<Twin> at;
  Twin* numbers = reinterpret_cast<Twin*>(&at);
  for (int k = 0; k < plane_numbers; ++k) numbers[k] = load_twin(rows.numbers[k]);
  PlaneStep<Twin, TwinPlane, elliptic, shaken> step(at, rows.tolerance);
  const int count = rows.lanes;
  const unsigned here = (1U << count) - 1;
  unsigned apart = 0;
  while (!apart) {
    step.look();
    unsigned goes = bits(step.regular()) & here;
    for (int l = 0; l < count; ++l)
      if (rows.steps[l] >= most_steps_a_segment) goes &= ~(1U << l);
    apart = here & ~goes;
    if (apart) break;
    const Twin limit = step.left();
    goes &= bits(step.expand(limit));
    apart = here & ~goes;
    step.follow({lanes_of(goes), lanes_of(goes >> pack_lanes)});
    unsigned at_knot = bits(step.tau == limit) & goes;
    for (unsigned open = goes & ~at_knot; open; open &= open - 1) ++rows.steps[__builtin_ctz(open)];
    if (!at_knot) continue;
    store(rows.numbers[0], at.offset);
    clear_upper_parts();
    for (; at_knot; at_knot &= at_knot - 1) {
      const int l = __builtin_ctz(at_knot);
      if (!rows.next_segment(l)) apart |= 1U << l;
    }
    for (int k = 0; k < numbers_of_segment; ++k) numbers[k] = load_twin(rows.numbers[k]);
  }
  for (int k = 0; k < plane_numbers; ++k) store(rows.numbers[k], numbers[k]);
  clear_upper_parts();
  return apart;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
