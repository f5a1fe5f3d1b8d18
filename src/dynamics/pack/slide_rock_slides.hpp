// Blocks that slide flat at present under a friction that follows their speed, side by side, and their steps in packs: an
// interval, or what is left of it, as long as nothing happens in it: no end of the slip, no turn of its speed, no tipping.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/flat_series.hpp"
#include "dynamics/pack/friction.hpp"
#include "dynamics/pack/lane_group.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N, class Friction>
class SlideRockSlides : public LaneGroup<FlatRows<Friction>> {
  using Group = LaneGroup<FlatRows<Friction>>;
  using Group::r_;

 public:
  static constexpr bool ends_in_packs = false;

  template <class Lane>
  static void release(Lane& lane) {
    lane.go_on();
  }

  // One interval for every block; bits of the blocks to which something happens, or whose record ends.
  std::uint64_t march() {
    return Group::each_pack([this](int i, unsigned here) { return march(i, here); });
  }

 private:
  unsigned march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0), left = load(r_.left + i), left2 = left * left, per_left = one / left;
    const Pack xi0 = load(r_.xi + i), w0 = load(r_.w + i), a = load(r_.a + i), a_next = fetch(r_.next + i);
    const Pack weight = load(r_.weight + i) * left2, weight_g = load(r_.weight_g + i) * left2;
    const Pack friction = load(r_.friction + i) * weight_g, sigma = load(r_.sigma + i);
    FlatSeries<N, Pack> y;
    typename Friction::template Factor<N> factor(r_.law, i);
    y.xi[0] = xi0;
    y.w[0] = w0 * left;
    y.slide(friction, weight * a, weight * (a_next - a), r_.law.to_speed(i, sigma, left), factor);
    const Pack xi = y.sum(y.xi), w = y.sum(y.w), first = factor.first(), last = factor.last();

    Pack bow(0.0), bend = xsimd::abs(factor.factor()[2]);
#pragma GCC unroll 16
    for (int k = 3; k <= N; ++k) {
      bow = bow + xsimd::abs(y.w[k]);
      bend = bend + xsimd::abs(factor.factor()[k]);
    }
    const Pack size = load(r_.size + i), seen = load(r_.seen + i), peak = load(r_.peak + i);
    const Pack slower = xsimd::min(sigma * y.w[0], sigma * w), most = xsimd::max(first, last);
    const Pack force = friction * most, square = force * force / (left2 * left2);
    const Pack square_term = xsimd::abs(y.w[2]);  // which leaves its chord by a quarter
    const PackMask starts = (sigma * y.w[0] >= zero) & (sigma * y.w[1] > square_term + bow);
    const PackMask stops = ~((slower > Pack(0.25) * square_term + bow) | starts),
                   tips = ~(most + bend < load(r_.tips + i));
    const PackMask turns = (square * Pack(1.1) > seen) & ~(xsimd::abs(y.w[1]) > Pack(2.0) * (square_term + bow));
    const PackMask stays = stops | tips | turns | ~(xsimd::abs(y.w[N + 1]) < Pack(neglected_by_laws) * size * left);

    store(r_.xi + i, choose(stays, xi0, xi));
    store(r_.w + i, choose(stays, w0, w * per_left));
    store(r_.seen + i, choose(stays, seen, xsimd::max(seen, square)));
    store(r_.peak + i, choose(stays, peak, xsimd::max(peak, xsimd::abs(xi))));
    store(r_.a + i, choose(stays, a, a_next));
    store(r_.left + i, choose(stays, left, one));
    const unsigned all = bits(stays) & here;
    advance(r_.next + i, here & ~all);
    return all;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
