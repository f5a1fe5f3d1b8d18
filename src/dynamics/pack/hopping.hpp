// Blocks that rock in small hops, side by side, in packs: from impact to knot to impact.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/hop_rows.hpp"
#include "dynamics/pack/hop_series.hpp"
#include "dynamics/pack/lane_group.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Gravity>
class Hopping : public LaneGroup<HopRows<Gravity>> {
  using Group = LaneGroup<HopRows<Gravity>>;
  using Group::r_;

 public:
  static constexpr bool ends_in_packs = false;

  template <class Lane>
  static void release(Lane& lane) {
    lane.settle();
  }

  // To the next impact or knot for every block; bits of those that come to rest, leave what the hops' equation covers, have
  // hopped often enough to ask whether the row dies out, or are at the end of their record.
  std::uint64_t march() {
    return Group::each_pack([this](int i, unsigned here) { return march(i, here); });
  }

 private:
  unsigned march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0), two(2.0);
    const Pack fraction = load(r_.fraction + i), theta = load(r_.theta + i), omega = load(r_.omega + i),
               a = load(r_.a + i);
    const Pack a_next = fetch(r_.next + i) + load(r_.slope + i), rate = (a_next - a) / fraction,
               side = load(r_.side + i);
    const PackMask right = side > zero;
    const auto on = [&](const double(&row)[2][march_slots]) {
      return choose(right, load(row[1] + i), load(row[0] + i));
    };
    const Pack weight = on(r_.weight), tip = on(r_.tip), kappa_by_a = on(r_.kappa_by_a);
    const typename Gravity::Hop shakes(r_.shakes, i, r_.next + i, fraction, right);
    const Pack beta = shakes.beta(weight + tip * a), low = xsimd::min(beta, shakes.beta_next(weight + tip * a_next)),
               top = omega * omega + two * theta * beta;
    const PackMask holds = shakes.holds((top * top < load(r_.limit2 + i) * (low * low)) &
                                        (xsimd::max(xsimd::abs(a), xsimd::abs(a_next)) <= load(r_.push + i)));
    const HopSeries y(theta, omega, beta, shakes.beta_rate(tip * rate), shakes.kappa(on(r_.kappa) - kappa_by_a * a),
                      shakes.kappa_rate(zero - kappa_by_a * rate), shakes.pull());
    const Pack end = y.height(fraction);
    const PackMask crosses = holds & (end > zero);
    PackMask open = holds & ~crosses;
    const Pack landing = y.landing(open), t = choose(crosses, fraction, landing), speed = y.speed(t);
    const PackMask lands = holds & ~crosses & ~open & (t > zero) & (t <= fraction), goes = crosses | lands,
                   stays = ~goes;

    const Pack falls = xsimd::abs(speed), ahead = fraction - t, rises = falls * on(r_.kept);
    // At 100 intervals a second 1e-12 of one are 1e-14 s, to which events are located.
    const PackMask to_knot = crosses | (lands & (ahead < Pack(1e-12)));
    const PackMask told = lands & (falls * falls >= on(r_.told));
    const Pack rests = choose(right, load(r_.rests[0] + i), load(r_.rests[1] + i));
    const PackMask ends = lands & (rises * rises < rests);
    const Pack hops = load(r_.hops + i) + one;
    store_where(goes, r_.theta + i, choose(lands, zero, end));
    store_where(goes, r_.omega + i, choose(lands, rises, speed));
    store_where(goes, r_.a + i, choose(to_knot, a_next, a + rate * t));
    shakes.keep(r_.shakes, i, stays, to_knot, t);
    store_where(goes, r_.fraction + i, choose(to_knot, one, ahead));
    store_where(lands, r_.side + i, zero - side);
    store_where(lands, r_.hops + i, hops);
    store_where(told, r_.impacts + i, load(r_.impacts + i) + one);
    store_where(ends, r_.ended + i, one);
    advance(r_.next + i, bits(to_knot) & here, Gravity::stride);
    return bits(stays | ends | (lands & (hops >= Pack(hops_at_once))));
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
