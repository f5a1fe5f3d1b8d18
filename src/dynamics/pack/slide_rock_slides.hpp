// Blocks that slide flat at present, under a law of friction or pulled by a spring and a drag, side by side, and their steps in packs: an interval, or what is
// left of it, as long as nothing happens in it: no end of the slip, no turn of the friction that could be a peak, no tipping.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/flat_series.hpp"
#include "dynamics/pack/friction.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/rock_series.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N, class Gravity, class Friction>
class SlideRockSlides : public LaneGroup<FlatRows<Gravity, Friction>> {
  using Group = LaneGroup<FlatRows<Gravity, Friction>>;
  using Group::r_;

 public:
  static constexpr bool ends_in_packs = true;

  template <class Lane>
  static void release(Lane& lane) {
    lane.go_on();
  }

  // One interval for every block; bits of the blocks to which something happens, or whose record ends.
  std::uint64_t march() {
    ends_ = 0;
    return Group::each_pack([this](int i, unsigned here) { return march(i, here); });
  }
  // Those of them whose slip ends.
  std::uint64_t ends() const { return ends_; }

  // The blocks from lane i on go to the end of their slips.
  void finish(int i, unsigned here, SlipEnds& ends) {
    const Pack zero(0.0), one(1.0), two(2.0), fraction = load(r_.fraction + i), sigma = load(r_.sigma + i);
    const Step s(r_, i, fraction, sigma, load(r_.a + i), fetch(r_.next + i));
    const auto& y = s.y;
    const Pack w = y.sum(y.w), guess = first_zero(sigma * y.w[0], sigma * y.w[1], sigma * w);
    const PackMask stops = sigma * w <= zero;
    const PackMask slows = sigma * y.w[1] + two * xsimd::abs(y.w[2]) + Pack(6.0) * xsimd::abs(y.w[3]) < zero;
    const Pack x = bracketed_root<N + 1>(y.w, sigma, zero, one, guess, stops);
    const Pack first = s.factor.first(), last = s.factor.at(x), square = s.felt(first, last, s.pull.with(zero, x));
    const Pack xi = y.at(y.xi, x), seen = load(r_.seen + i), peak = load(r_.peak + i);
    const PackMask found = stops & slows & (sigma * y.w[0] > zero) & (x > zero) & settled(y, i, fraction) &
                           (xsimd::max(first, last) + s.curvature() < load(r_.tips + i)) & ~s.may_peak(square, seen) &
                           (xsimd::min(first, last) >= zero);
    r_.law.slid(i, found, xsimd::abs(xi - y.xi[0]));
    store_where(found, r_.xi + i, xi);
    store_where(found, r_.w + i, zero);
    store_where(found, r_.seen + i, xsimd::max(seen, square));
    store_where(found, r_.peak + i, xsimd::max(peak, xsimd::abs(xi)));
    store(ends.parts, x);
    ends.found = bits(found) & here;
    ends.impacts = 0;
  }

 private:
  // What is left of an interval.
  struct Step {
    const Pack fraction2, weight;
    FlatSeries<N, Pack> y;
    typename Friction::template Factor<N> factor;
    decltype(Gravity::template pull<N>(typename Gravity::Rows{}, 0, fraction2, fraction2, fraction2)) pull;
    const Pack friction;  // of Coulomb's law, in the units of the series

    [[gnu::always_inline]] Step(const FlatRows<Gravity, Friction>& r, int i, const Pack& fraction, const Pack& sigma,
                                const Pack& a, const Pack& a_next)
        : fraction2(fraction * fraction),
          weight(load(r.weight + i) * fraction2),
          factor(r.law, i, sigma),
          pull(Gravity::template pull<N>(r.shakes, i, fraction, load(r.xi + i), Pack(0.0))),
          friction(load(r.friction + i) * (load(r.weight_g + i) * fraction2)) {
      y.xi[0] = load(r.xi + i);
      y.w[0] = load(r.w + i) * fraction;
      y.slide(friction, weight * a, weight * (a_next - a), r.law.to_speed(i, sigma, fraction), factor, pull, weight);
    }

    // Squared acceleration, the larger one of both ends, of which the factor and the pull are given.
    Pack felt(const Pack& first, const Pack& last, const Pack& pull_last) const {
      Pack start = friction * first, end = friction * last;
      if constexpr (Gravity::pulls) {
        start = start + weight * pull.terms()[0];
        end = end + weight * pull_last;
      }
      return xsimd::max(start * start, end * end) / (fraction2 * fraction2);
    }
    // A new peak of it is near, and the force may turn within.
    PackMask may_peak(const Pack& square, const Pack& seen) const {
      const Pack* f = terms();
      Pack bends(0.0);
#pragma GCC unroll 16
      for (int k = 2; k <= N; ++k) bends = bends + Pack(double(k)) * xsimd::abs(f[k]);
      return (square * Pack(1.1) > seen) & ~(xsimd::abs(f[1]) >= bends);
    }
    // What the factor leaves its chord by, at most.
    Pack curvature() const {
      if constexpr (!Friction::by_slip) {
        return Pack(0.0);
      } else {
        Pack sum = xsimd::abs(terms()[2]);
#pragma GCC unroll 16
        for (int k = 3; k <= N; ++k) sum = sum + xsimd::abs(terms()[k]);
        return sum;
      }
    }

   private:
    // Of what changes.
    const Pack* terms() const {
      if constexpr (Gravity::pulls)
        return pull.terms();
      else
        return factor.factor();
    }
  };

  PackMask settled(const FlatSeries<N, Pack>& y, int i, const Pack& fraction) const {
    return xsimd::abs(y.w[N + 1]) < Pack(neglected_by_laws) * load(r_.size + i) * fraction;
  }

  unsigned march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0), fraction = load(r_.fraction + i), per_fraction = one / fraction;
    const Pack a_next = fetch(r_.next + i), sigma = load(r_.sigma + i);
    const Step s(r_, i, fraction, sigma, load(r_.a + i), a_next);
    const auto& y = s.y;
    const Pack xi = y.sum(y.xi), w = y.sum(y.w), first = s.factor.first(), last = s.factor.last();

    Pack bow(0.0);
#pragma GCC unroll 16
    for (int k = 3; k <= N; ++k) bow = bow + xsimd::abs(y.w[k]);
    const Pack seen = load(r_.seen + i), peak = load(r_.peak + i);
    const Pack slower = xsimd::min(sigma * y.w[0], sigma * w), most = xsimd::max(first, last);
    const Pack square = s.felt(first, last, s.pull.with_last(zero));
    const Pack square_term = xsimd::abs(y.w[2]);  // which leaves its chord by a quarter
    const PackMask starts = (sigma * y.w[0] >= zero) & (sigma * y.w[1] > square_term + bow);
    const PackMask stops = ~((slower > Pack(0.25) * square_term + bow) | starts);
    const PackMask tips = ~(most + s.curvature() < load(r_.tips + i));
    const PackMask settles = settled(y, i, fraction) & (xsimd::min(first, last) >= zero),
                   stays = stops | tips | s.may_peak(square, seen) | ~settles;

    r_.law.slid(i, ~stays, xsimd::abs(xi - y.xi[0]));
    store_where(~stays, r_.xi + i, xi);
    store_where(~stays, r_.w + i, w * per_fraction);
    store_where(~stays, r_.seen + i, xsimd::max(seen, square));
    store_where(~stays, r_.peak + i, xsimd::max(peak, xsimd::abs(xi)));
    store_where(~stays, r_.a + i, a_next);
    store_where(~stays, r_.fraction + i, one);
    const unsigned all = bits(stays) & here;
    advance(r_.next + i, here & ~all);
    ends_ |= static_cast<std::uint64_t>(all & bits(settles & (sigma * w <= zero))) << i;
    return all;
  }

  std::uint64_t ends_ = 0;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
