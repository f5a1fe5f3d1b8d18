// Blocks that slide-rock at present, side by side, and their steps in packs: an interval, or what is left of it, as long
// as nothing happens in it: no impact, no end of the slip, no turn that could be a peak. Where the slip or the stay on the
// corner ends for certain, and nothing else happens before, up to there.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/rock_series.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N, class Gravity, class Friction>
class SlideRockSlips : public LaneGroup<SlipRows<Gravity, Friction>> {
  using Group = LaneGroup<SlipRows<Gravity, Friction>>;
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
    return Group::each_pack([this](int i, unsigned here) {
      const Apart apart = march(i, here);
      ends_ |= static_cast<std::uint64_t>(apart.ends) << i;
      return apart.all;
    });
  }
  // Those of them whose slip or whose stay on the corner ends.
  std::uint64_t ends() const { return ends_; }

  // The blocks from lane i on go to the end of their slips.
  void finish(int i, unsigned here, SlipEnds& ends) {
    const Pack zero(0.0), one(1.0), two(2.0);
    const Step s(r_, i);
    const auto& y = s.y;
    const Pack theta = y.sum(y.theta), omega = y.sum(y.omega), w = y.sum(y.w);
    const PackMask falls = theta <= zero, stops = s.sigma * w <= zero;
    // Each is positive before, and falls to zero once.
    const PackMask slows = (s.sigma * y.w[0] > zero) &
                           (s.sigma * y.w[1] + two * xsimd::abs(y.w[2]) + Pack(6.0) * xsimd::abs(y.w[3]) < zero);
    const PackMask sure = (s.domed() | ((y.omega[0] < zero) & (omega < zero)) | ~(falls | s.wavers(omega, theta))) &
                          ((stops & slows) | (s.slips_on(w) & ~stops)) & (falls | stops) & s.settled();
    const Pack lands = bracketed_root<N + 1>(y.theta, one, zero, one, first_zero(y.theta[0], y.omega[0], theta), falls);
    const Pack guess = first_zero(s.sigma * y.w[0], s.sigma * y.w[1], s.sigma * w);
    const Pack halts = bracketed_root<N + 1>(y.w, s.sigma, zero, one, guess, stops);
    const PackMask impacts = falls & ~(stops & (halts < lands));
    const Pack x = choose(impacts, lands, halts);

    Pack turned = load(r_.look + i), slid = load(r_.peak + i);
    if (const PackMask tops = s.tops(omega, theta); bits(tops) & here) s.turn(tops, omega, x, turned, slid);
    End end{choose(impacts, zero, y.at(y.theta, x)),
            y.at(y.omega, x),
            y.at(y.rx, x),
            y.at(y.ry, x),
            y.at(y.xi, x),
            choose(impacts, y.at(y.w, x), zero),
            value_at(s.field, x),
            s.factor.at(x),
            s.factor.rate_at(x),
            s.along_at(x),
            x};
    Pack seen, peak;
    const PackMask strange = s.watch(end, slid, seen, peak) | ~sure | ~(x > zero) | ~(end.theta < Pack(1.57));
    keep(s, end, strange, turned, seen, peak);
    store(ends.parts, x);
    ends.found = here & ~bits(strange);
    ends.impacts = bits(impacts);
  }

 private:
  struct Apart {
    unsigned all, ends;
  };
  // What slope, spring and drag take off the acceleration of the block, in units of the record.
  struct Along {
    Pack value, rate;
  };
  // Where a step ends.
  struct End {
    Pack theta, omega, rx, ry, xi, w, gravity, factor, factor_rate;
    Along along;
    Pack x;
  };

  // The force at the corner: its square, per interval, and the slope of that but for positive factors.
  struct Touch {
    Pack square, slope;
    PackMask holds;
  };
  struct Place {
    Pack rx, ry, omega, gravity, factor, factor_rate;
    Along along;
  };

  // What is left of an interval.
  struct Step {
    const SlipRows<Gravity, Friction>& r;
    const int i;
    const Pack fraction, fraction2, omega0, w0, slope, a, a_next, weight_g, k2, friction, sigma;
    const typename Gravity::Interval shakes;
    typename Friction::template Factor<N> factor;
    decltype(Gravity::template pull<N>(typename Gravity::Rows{}, 0, fraction, fraction, fraction)) pull;
    CornerSeries<N, Pack> y;
    decltype(shakes.gravity(weight_g) * fraction2) field;

    [[gnu::always_inline]] Step(const SlipRows<Gravity, Friction>& rows, int lane)
        : r(rows),
          i(lane),
          fraction(load(r.fraction + i)),
          fraction2(fraction * fraction),
          omega0(load(r.omega + i)),
          w0(load(r.w + i)),
          slope(load(r.slope + i)),
          a(load(r.a + i)),
          a_next(fetch(r.next + i) + slope),
          weight_g(load(r.weight_g + i)),
          k2(load(r.k2 + i)),
          friction(load(r.friction + i)),
          sigma(load(r.sigma + i)),
          shakes(r.shakes, i, r.next + i),
          factor(r.law, i, sigma),
          pull(Gravity::template pull<N>(r.shakes, i, fraction, load(r.xi + i), beside_corner(load(r.theta + i)))),
          field(shakes.gravity(weight_g) * fraction2) {
      const Pack weight = load(r.weight + i) * fraction2;
      y.theta[0] = load(r.theta + i);
      y.rx[0] = load(r.rx + i);
      y.ry[0] = load(r.ry + i);
      y.xi[0] = load(r.xi + i);
      y.omega[0] = omega0 * fraction;
      y.w[0] = w0 * fraction;
      y.slide_rock(field, weight * a, weight * (a_next - a), k2, friction, r.law.to_speed(i, sigma, fraction), factor,
                   pull, weight);
    }

    // The series' last terms are small enough.
    PackMask settled() const {
      const Pack size = load(r.size + i);
      return xsimd::max(xsimd::abs(y.omega[N + 1]) * size, xsimd::abs(y.w[N + 1])) <
             Friction::neglected(fraction) * size;
    }
    // The rotation is concave all through.
    PackMask domed() const {
      return y.omega[1] + Pack(2.0) * xsimd::abs(y.omega[2]) + Pack(6.0) * xsimd::abs(y.omega[3]) < Pack(0.0);
    }
    // It may rise higher than ever before; omega, theta: at the end of the interval.
    PackMask rises_high(const Pack& omega, const Pack& theta) const {
      const Pack reach = xsimd::abs(y.omega[0]) + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
      return xsimd::max(y.theta[0], theta) + reach > load(r.look + i);
    }
    // It turns once, from rising to falling, and may do so higher than ever before.
    PackMask tops(const Pack& omega, const Pack& theta) const {
      const Pack zero(0.0);
      return domed() & (y.omega[0] > zero) & (omega < zero) & rises_high(omega, theta);
    }
    // There, if it is before x: the largest rotation and slip.
    void turn(const PackMask& lanes, const Pack& omega, const Pack& x, Pack& turned, Pack& slid) const {
      const Pack zero(0.0), one(1.0), guess = first_zero(y.omega[0], y.omega[1], omega);
      const Pack at = bracketed_root<N + 1>(y.omega, one, zero, one, guess, lanes), top = y.at(y.theta, at);
      const PackMask seen = lanes & (at < x);
      turned = choose(seen, xsimd::max(turned, top), turned);
      slid = choose(seen, xsimd::max(slid, xsimd::abs(midpoint(y.at(y.xi, at), top))), slid);
    }
    // It may turn otherwise, where that matters.
    PackMask wavers(const Pack& omega, const Pack& theta) const {
      const Pack zero(0.0), reach = xsimd::abs(y.omega[0]) + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
      const Pack low = xsimd::min(y.theta[0], theta);
      const PackMask turns =
          (y.omega[0] * omega <= zero) |
          ((y.omega[0] * y.omega[1] < zero) & (xsimd::abs(y.omega[1]) > Pack(2.0) * xsimd::abs(y.omega[0])));
      return turns & ~domed() & (rises_high(omega, theta) | (low < reach));
    }
    // All through the interval; w: at its end. The slip leaves its chord by its higher terms at most. One that starts from
    // zero, or rises, does not come back to it.
    PackMask slips_on(const Pack& w) const {
      const Pack zero(0.0), slip0 = sigma * y.w[0], rises = sigma * y.w[1], curve = sigma * y.w[2];
      const Pack more = xsimd::abs(y.w[3]) + xsimd::abs(y.w[4]);
      const PackMask leaves =
          (slip0 >= zero) & (rises > Pack(-slip_zero) * weight_g * fraction2) & (rises + curve > more);
      return (xsimd::min(slip0, sigma * w) > Pack(0.25) * xsimd::abs(curve) + Pack(0.5) * more) | leaves;
    }
    // Slip of the midpoint: u = xi + B (1 - cos theta).
    Pack midpoint(const Pack& xi, const Pack& theta) const { return xi + beside_corner(theta); }
    Pack beside_corner(const Pack& theta) const { return load(r.half_base + i) * versine(theta); }

    Along along_first() const {
      if constexpr (Gravity::pulls) return {slope + pull.terms()[0], pull.terms()[1]};
      return {slope, Pack(0.0)};
    }
    Along along_last() const {
      if constexpr (Gravity::pulls) return {pull.with_last(slope), pull.rate_sum(pull.terms())};
      return {slope, Pack(0.0)};
    }
    Along along_at(const Pack& x) const {
      if constexpr (Gravity::pulls) return {pull.with(slope, x), pull.rate_at(pull.terms(), x)};
      return {slope, Pack(0.0)};
    }

    [[gnu::always_inline]] Touch touch(const Place& at) const {
      const Pack zero(0.0), two(2.0), &x = at.rx, &y1 = at.ry, &o = at.omega, mu = friction * at.factor;
      const Pack q = x + mu * y1, n = at.gravity - y1 * o * o, d = k2 + x * q, per_d = Pack(1.0) / d;
      const Pack f = n * k2 * per_d, lift = f - weight_g * fraction2;
      const Pack n_rate = plus_rate(x * o * o * o - two * y1 * o * (n * q * per_d), shakes.lift() * fraction2);
      Pack d_rate = o * (y1 * q + x * (y1 - mu * x)), change(0.0);
      if constexpr (Friction::by_slip) {
        const Pack mu_rate = friction * at.factor_rate;
        d_rate = d_rate + x * mu_rate * y1;
        change = mu * mu_rate * f * f * (d * d / k2);
      }
      const Pack weight = load(r.weight + i) * fraction2, along = weight * at.along.value;
      if constexpr (Gravity::pulls) change = weight * at.along.rate * (mu * f + along) * (d * d / k2);
      // The block's acceleration is -(mu f + along).
      const Pack rises = (n_rate * d - n * d_rate) * (mu * mu * f + lift + mu * along) + change;
      const Pack square = mu * mu * f * f + lift * lift + (two * mu * f + along) * along;
      PackMask holds = (n > zero) & (d > Pack(0.05) * k2);
      if constexpr (Friction::by_slip) holds = holds & (at.factor >= zero);
      return {square / (fraction2 * fraction2), rises, holds};
    }
    // The largest square, where its slope is positive at the start and negative at x.
    Pack top_between(const Touch& first, const Touch& last, const Pack& end) const {
      const Pack zero(0.0);
      Pack lo(0.0), hi = end, rises = first.slope, falls = last.slope, most = zero;
      for (int round = 0; round < (Gravity::pulls ? 4 : 2); ++round) {
        const Pack x = lo + (hi - lo) * (rises / (rises - falls));
        const Touch here = touch({y.at(y.rx, x), y.at(y.ry, x), y.at(y.omega, x), value_at(field, x), factor.at(x),
                                  factor.rate_at(x), along_at(x)});
        const PackMask before = here.slope > zero;
        lo = choose(before, x, lo);
        rises = choose(before, here.slope, rises);
        hi = choose(before, hi, x);
        falls = choose(before, falls, here.slope);
        most = xsimd::max(most, here.square);
      }
      return most;
    }

    // The largest slip, at least `slid`, and squared acceleration up to the end of the step; true where that may be wrong.
    [[gnu::always_inline]] PackMask watch(const End& end, const Pack& slid, Pack& seen, Pack& peak) const {
      const Pack zero(0.0), &rx = end.rx, &ry = end.ry, &omega = end.omega;
      // u' = w + (lever_y r_x + lever_x r_y) omega.
      const Pack lever_x = load(r.lever_x + i), lever_y = load(r.lever_y + i),
                 size_u = xsimd::abs(midpoint(end.xi, end.theta));
      const Pack before = y.w[0] + (lever_y * y.rx[0] + lever_x * y.ry[0]) * y.omega[0];
      const Pack after = end.w + (lever_y * rx + lever_x * ry) * omega;
      PackMask strange = (before * after < zero) & (size_u + xsimd::abs(before) + xsimd::abs(after) > slid);
      peak = xsimd::max(slid, size_u);

      const Touch first =
          touch({y.rx[0], y.ry[0], y.omega[0], at_start(field), factor.first(), factor.first_rate(), along_first()});
      const Touch last = touch({rx, ry, omega, end.gravity, end.factor, end.factor_rate, end.along});
      strange = strange | ~(first.holds & last.holds);
      seen = load(r.seen + i);
      const Pack square = xsimd::max(first.square, last.square);
      if (const PackMask feels = square * Pack(1.1) > seen; bits(feels)) {
        const PackMask tops = feels & (first.slope > zero) & (last.slope < zero);
        if (bits(tops & ~strange)) seen = xsimd::max(seen, choose(tops, top_between(first, last, end.x), zero));
      }
      seen = xsimd::max(seen, square);
      return strange;
    }
  };

  // The end of the step, but for the lanes that stay.
  void keep(const Step& s, const End& end, const PackMask& stays, const Pack& turned, const Pack& seen,
            const Pack& peak) {
    const Pack per_fraction = Pack(1.0) / s.fraction;
    const PackMask goes = ~stays;
    const int i = s.i;
    store_where(goes, r_.look + i, turned);
    store_where(goes, r_.seen + i, seen);
    store_where(goes, r_.peak + i, peak);
    store_where(goes, r_.theta + i, end.theta);
    store_where(goes, r_.omega + i, end.omega * per_fraction);
    store_where(goes, r_.rx + i, end.rx);
    store_where(goes, r_.ry + i, end.ry);
    r_.law.slid(i, goes, xsimd::abs(end.xi - s.y.xi[0]));
    store_where(goes, r_.xi + i, end.xi);
    store_where(goes, r_.w + i, end.w * per_fraction);
  }

  Apart march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0);
    const Step s(r_, i);
    const auto& y = s.y;
    const End end{y.sum(y.theta),  y.sum(y.omega),  y.sum(y.rx),          y.sum(y.ry),    y.sum(y.xi), y.sum(y.w),
                  at_end(s.field), s.factor.last(), s.factor.last_rate(), s.along_last(), one};
    Pack seen, peak, turned = load(r_.look + i), slid = load(r_.peak + i);
    const PackMask falls = end.theta <= zero;
    if (const PackMask tops = s.tops(end.omega, end.theta) & ~falls; bits(tops))
      s.turn(tops, end.omega, one, turned, slid);
    const PackMask stays = s.watch(end, slid, seen, peak) | s.wavers(end.omega, end.theta) | falls |
                           ~(end.theta < Pack(1.57)) | ~s.settled() | ~s.slips_on(end.w);

    keep(s, end, stays, turned, seen, peak);
    store_where(~stays, r_.a + i, s.a_next);
    s.shakes.keep(r_.shakes, i, stays);
    store_where(~stays, r_.fraction + i, one);
    const unsigned all = bits(stays) & here;
    advance(r_.next + i, here & ~all, Gravity::stride);
    return {all, all & bits((falls | (s.sigma * end.w <= zero)) & s.settled())};
  }

  std::uint64_t ends_ = 0;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
