// Blocks that rock, side by side, in packs: from knot to knot, while nothing happens to them.
//
// Every lane is mirrored so that it stands on its right corner. Time is counted in intervals h: angular velocities are
// times h, accelerations times h^2.
#pragma once

#include <array>

#include "base/pack.hpp"
#include "base/units.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/rock_series.hpp"
#include "dynamics/pack/rock_step.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct RockRows {
  using Gravity = Steady;
  alignas(64) double theta[march_slots], omega[march_slots], rx[march_slots], ry[march_slots];
  alignas(64) double gravity[march_slots], push[march_slots];  // g h^2/J, scale h^2/J
  alignas(64) double weight[march_slots];                      // scale h^2
  alignas(64) double a[march_slots];                           // unit record, where the lane is
  alignas(64) double fraction[march_slots];                    // part of the interval that lies ahead
  alignas(64) double peak[march_slots], force2[march_slots];   // of theta; of the squared acceleration
  alignas(64) const double* next[march_slots];                 // a at the end of the interval
  alignas(64) const double* stop[march_slots];                 // the last such value

  // Out of use: it causes no work.
  void retire(int i) {
    omega[i] = gravity[i] = push[i] = weight[i] = a[i] = 0;
    theta[i] = 0.5;
    fraction[i] = 1;
    peak[i] = force2[i] = 1e300;
    next[i] = still_ground;
  }
  auto all() { return std::array{theta, omega, rx, ry, gravity, push, weight, a, fraction, peak, force2}; }
};

class RockMarch : public LaneGroup<RockRows> {
 public:
  // One interval for every block to which nothing happens within it; bits of those to which something may (impact,
  // turning point higher than any before or near the floor, overturning), or whose record is over. `falls`: of those among
  // them that fall to the floor, and nothing else.
  template <class Step>
  std::uint64_t march(std::uint64_t& falls) {
    falls_ = 0;
    const std::uint64_t apart = each_pack([this](int i, unsigned here) {
      const bool whole = bits(load(r_.fraction + i) == Pack(1.0)) == (1U << pack_lanes) - 1;
      return whole ? march<Step, true>(i, here) : march<Step, false>(i, here);
    });
    falls = falls_;
    return apart;
  }

 private:
  // `whole`: no lane has a part of its interval behind it.
  template <class Step, bool whole>
  unsigned march(int i, unsigned here) {
    const Pack one(1.0), zero(0.0), fraction = whole ? one : load(r_.fraction + i), fraction2 = fraction * fraction;
    const auto scaled = [&](const double* row, const Pack& by) { return whole ? load(row + i) : load(row + i) * by; };
    Step y;
    y.theta[0] = load(r_.theta + i);
    y.omega[0] = scaled(r_.omega, fraction);
    y.rx[0] = load(r_.rx + i);
    y.ry[0] = load(r_.ry + i);
    const Pack a = load(r_.a + i), a_next = fetch(r_.next + i), change = a_next - a;
    const Pack gravity = scaled(r_.gravity, fraction2), push = scaled(r_.push, fraction2);
    y.expand(gravity, push * a, push * change);
    const RockEnd end = y.end(a_next);
    const Pack peak = load(r_.peak + i);
    const PackMask falls = falls_all_along(y, end), stays = something_happens(y, end, peak, falls);

    const Pack seen = load(r_.force2 + i), over = whole ? one : one / fraction, over2 = over * over;
    const Pack most = watch_force(y, scaled(r_.weight, fraction2), gravity, push, a, change, end, one,
                                  whole ? seen : seen * (fraction2 * fraction2), false);
    const PackMask goes = ~stays;
    store_where(goes, r_.force2 + i, whole ? most : most * (over2 * over2));
    store_where(goes, r_.peak + i, xsimd::max(peak, end.theta));
    store_where(goes, r_.theta + i, end.theta);
    store_where(goes, r_.omega + i, whole ? end.omega : end.omega * over);
    store_where(goes, r_.rx + i, end.rx);
    store_where(goes, r_.ry + i, end.ry);
    store_where(goes, r_.a + i, a_next);
    if (!whole) store_where(goes, r_.fraction + i, one);
    const unsigned apart = bits(stays) & here;
    advance(r_.next + i, here & ~apart);
    falls_ |= std::uint64_t{bits(falls & (end.theta <= zero)) & apart} << i;
    return apart;
  }

  // Certainly: between falling at both ends, the block would rise only if it were thrown up hard at the start.
  template <class Step>
  static PackMask falls_all_along(const Step& y, const RockEnd& end) {
    const Pack zero(0.0);
    return ~(y.omega[0] >= zero) & ~(end.omega > zero) & (y.omega[1] + y.omega[0] <= zero - y.omega[0]);
  }

  // Turning within the interval, a block comes less than `beyond` further than at its end. Without a branch, as it would
  // be known late and often taken.
  template <class Step>
  static PackMask something_happens(const Step& y, const RockEnd& end, const Pack& peak, const PackMask& falls) {
    const Pack zero(0.0), beyond = xsimd::abs(end.omega - y.omega[0]) + xsimd::abs(y.omega[1]);
    const PackMask rises = y.omega[0] >= zero, rises_then = end.omega > zero;
    const PackMask rises_all_along = rises & rises_then & (y.omega[1] >= zero);
    const PackMask touches = (end.theta <= beyond) & ~(rises_all_along | (falls & ~(end.theta <= zero)));
    const PackMask tops = (end.theta + beyond > xsimd::max(peak, y.theta[0])) & rises & ~rises_then;
    return touches | tops | ~(end.theta < Pack(0.5 * pi));
  }

  std::uint64_t falls_ = 0;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
