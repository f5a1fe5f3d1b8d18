// Blocks that rock, side by side, in packs: one Taylor step per knot interval (dynamics/pack/rock_series.hpp), or over
// what is left of the first, as long as it is certain that nothing happens within: no impact, no turn that could be a
// peak, no loss of grip.
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/rock_series.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N, class Gravity>
class SlideRockMarch : public LaneGroup<SlideRockRows<Gravity>> {
  using Group = LaneGroup<SlideRockRows<Gravity>>;
  using Group::r_;
  using Interval = typename Gravity::Interval;

 public:
  using Group::count;
  // Bits of the lanes in which something happens; of those that strike the floor, and nothing else.
  struct Apart {
    unsigned all = 0, strikes = 0;
  };
  static constexpr int packs = march_slots / pack_lanes;

  // One interval for every lane; none may be at the end of its record.
  void march(Apart (&apart)[packs]) {
    const Pack one(1.0);
    for (int i = 0; i < count(); i += pack_lanes) {
      const int used = count() - i;
      const unsigned here = used < pack_lanes ? (1U << used) - 1 : (1U << pack_lanes) - 1;
      const bool whole = !bits(load(r_.left + i) != one);
      apart[i / pack_lanes] = whole ? march<true>(i, here) : march<false>(i, here);
    }
  }

  // How many intervals every lane can go before one meets the end of its record; 0: lane `which` has met it.
  int free(int& which) const {
    int least = 1 << 30;
    for (int i = 0; i < count(); ++i) {
      const int free = static_cast<int>(r_.stop[i] - r_.next[i]) / Gravity::stride + 1;
      if (free < least) least = free, which = i;
    }
    return least;
  }

  // Impacts in the lanes from i on: after which part of what is left of the interval, with which rate.
  void strike(int i, double* parts, double* rates) const {
    const Pack zero(0.0), one(1.0), left = load(r_.left + i), a = load(r_.a + i), push = load(r_.push + i);
    RockSeries<N> y;
    expand<false>(y, i, left, load(r_.omega + i), Interval(r_.shakes, i, r_.next + i).per_inertia(load(r_.gravity + i)),
                  push, a, fetch(r_.next + i) - a);
    const Pack end = y.sum(y.theta), guess = first_zero(y.theta[0], y.omega[0], end);
    const Pack part = bracketed_root<N + 1>(y.theta, one, zero, one, guess, end <= zero);
    store(parts, part);
    store(rates, y.at(y.omega, part) / left);
  }

 private:
  template <bool Whole>
  Apart march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0), left = Whole ? one : load(r_.left + i);
    RockSeries<N> y;
    const Pack a = load(r_.a + i), a_next = fetch(r_.next + i), change = a_next - a;
    const Pack push = load(r_.push + i), gravity = load(r_.gravity + i), omega0 = load(r_.omega + i);
    const Interval shakes(r_.shakes, i, r_.next + i);
    const auto field = shakes.per_inertia(gravity);
    expand<Whole>(y, i, left, omega0, field, push, a, change);
    const Pack theta = y.sum(y.theta), rx = y.sum(y.rx), ry = y.sum(y.ry);
    Pack omega = y.sum(y.omega);

    const Pack rate = xsimd::abs(y.omega[0]), reach = rate + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
    const Pack low = xsimd::min(y.theta[0], theta), high = xsimd::max(y.theta[0], theta);
    const PackMask matters = (high + reach > load(r_.look + i)) | (low < reach), falls = theta <= zero;
    const PackMask turns = y.omega[0] * omega < zero,
                   starts = (y.omega[0] == zero) & (y.omega[1] > Pack(-1e-11) * gravity);
    const PackMask wavers = turns_twice(y, omega) | ((y.omega[0] * omega == zero) & ~(starts & (omega > zero)));
    PackMask strange = (wavers & matters) | ~(theta < Pack(1.5)) | (xsimd::abs(y.omega[N + 1]) > Pack(neglected));
    const Pack omega1 = omega;
    if constexpr (!Whole) omega = omega * (one / left);

    const Pack weight_g = load(r_.weight_g + i), weight = load(r_.weight + i);
    const Pack alpha = rx * at_end(field) - ry * (push * a_next), omega2 = omega * omega;
    const Pack fx = ry * alpha - rx * omega2 + weight * a_next, lift = shakes.lifted(zero) - rx * alpha - ry * omega2;
    const Pack grip0 = load(r_.grip + i), grip = load(r_.mu + i) * (weight_g + lift) - xsimd::abs(fx);
    const Pack square0 = load(r_.square + i), square = fx * fx + lift * lift;
    const Pack bend =
        load(r_.bend0 + i) + (shakes.bent(load(r_.bend1 + i) * xsimd::abs(change)) + load(r_.bend2 + i) * rate) * rate;
    const Pack most = xsimd::max(square0, square) * Pack(1 + 1.0 / 256) + Pack(257.0) * (bend * bend);
    const Pack seen = load(r_.seen + i);
    const PackMask slips = xsimd::min(grip0, grip) <= bend, tops = most > seen;
    if (const PackMask about = turns & matters & ~(strange | slips | falls); bits(about))
      strange = strange | turn(y, i, omega1, about);
    const PackMask stays = strange | slips | falls;
    if (const PackMask feels = tops & ~stays; bits(feels))
      watch<Whole>(y, i, left, {omega, rx, ry, a_next}, feels, shakes);

    store(r_.theta + i, choose(stays, y.theta[0], theta));
    store(r_.omega + i, choose(stays, omega0, omega));
    store(r_.rx + i, choose(stays, y.rx[0], rx));
    store(r_.ry + i, choose(stays, y.ry[0], ry));
    store(r_.a + i, choose(stays, a, a_next));
    shakes.keep(r_.shakes, i, stays);
    store(r_.grip + i, choose(stays, grip0, grip));
    store(r_.square + i, choose(stays, square0, square));
    if constexpr (!Whole) store(r_.left + i, choose(stays, left, one));
    const unsigned all = bits(stays) & here;
    advance(r_.next + i, here & ~all, Gravity::stride);
    return {all, bits(falls & ~strange & ~slips & ~tops & (omega0 < zero) & (omega < zero)) & all};
  }

  template <bool Whole, class Field>
  void expand(RockSeries<N>& y, int i, const Pack& left, const Pack& omega, const Field& gravity, const Pack& push,
              const Pack& a, const Pack& change) const {
    y.theta[0] = load(r_.theta + i);
    y.rx[0] = load(r_.rx + i);
    y.ry[0] = load(r_.ry + i);
    if constexpr (Whole) {
      y.omega[0] = omega;
      y.expand(gravity, push * a, push * change);
    } else {
      const Pack left2 = left * left, pushed = push * left2;
      y.omega[0] = omega * left;
      y.expand(gravity * left2, pushed * a, pushed * change);
    }
  }

  // The rotation turns, near a peak or the floor: the peaks. Lanes that touch the floor.
  PackMask turn(const RockSeries<N>& y, int i, const Pack& omega, const PackMask& lanes) {
    const Pack zero(0.0), one(1.0), sense = choose(y.omega[0] > zero, one, zero - one);
    const Pack guess = first_zero(sense * y.omega[0], sense * y.omega[1], sense * omega);
    const Pack x = bracketed_root<N + 1>(y.omega, sense, zero, one, guess, lanes), theta = y.at(y.theta, x);
    const Pack base = load(r_.half_base + i), turned = load(r_.turned + i), room = load(r_.room + i);
    const Pack adds = base * versine(theta);
    const PackMask seen = lanes & (theta > zero);
    const Pack most = choose(seen, xsimd::max(turned, theta), turned),
               slid = choose(seen, xsimd::max(room, adds), room);
    store(r_.turned + i, most);
    store(r_.room + i, slid);
    store(r_.look + i, choose(seen, xsimd::min(most, xsimd::sqrt(Pack(2.0) * slid / base)), load(r_.look + i)));
    return lanes & ~seen;
  }

  // The squared acceleration may have a new peak.
  template <bool Whole>
  void watch(const RockSeries<N>& y, int i, const Pack& left, const RockEnd& end, const PackMask& feels,
             const Interval& shakes) {
    const Pack seen = load(r_.seen + i), a = load(r_.a + i), left2 = left * left, left4 = left2 * left2;
    RockEnd there = end;
    there.omega = end.omega * left;
    const Pack top = watch_force(y, load(r_.weight + i) * left2, shakes.per_inertia(load(r_.gravity + i)) * left2,
                                 load(r_.push + i) * left2, a, end.a - a, there, Pack(1.0), seen * left4, true,
                                 shakes.lift() * left2);
    store(r_.seen + i, choose(feels, Whole ? top : top / left4, seen));
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
