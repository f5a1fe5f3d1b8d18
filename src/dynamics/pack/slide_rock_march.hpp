// Blocks that rock, side by side, in packs: one Taylor step per knot interval (dynamics/pack/rock_series.hpp), or over
// what is left of the first, as long as it is certain that nothing happens within: no impact, no turn that could be a
// peak, no loss of grip.
#pragma once

#include <type_traits>

#include "base/pack.hpp"
#include "dynamics/pack/corner_series.hpp"
#include "dynamics/pack/lane_group.hpp"
#include "dynamics/pack/rock_series.hpp"
#include "dynamics/pack/rock_step.hpp"
#include "dynamics/pack/slide_rock_rows.hpp"
#include "dynamics/pack/slide_rock_strikes.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int N, class Gravity>
class SlideRockMarch : public LaneGroup<SlideRockRows<Gravity>> {
  using Group = LaneGroup<SlideRockRows<Gravity>>;
  using Group::r_;
  using Interval = typename Gravity::Interval;
  // Short steps of a floor that does not shake vertically, and without spring and drag, go by derivatives.
  using Step = std::conditional_t<Gravity::shaken || Gravity::pulls, RockSeries<N>, StepOf<N>>;

 public:
  using Group::count;
  // Bits of the lanes that strike the floor, and nothing else; of the others in which something happens.
  struct Apart {
    unsigned strikes, others;
  };
  static constexpr int packs = march_slots / pack_lanes;

  // One interval for every lane; none may be at the end of its record. How many lanes strike the floor.
  int march(Apart (&apart)[packs]) {
    const Pack one(1.0);
    int strikes = 0;
    for (int i = 0; i < count(); i += pack_lanes) {
      const int used = count() - i;
      const unsigned here = used < pack_lanes ? (1U << used) - 1 : (1U << pack_lanes) - 1;
      const bool whole = !bits(load(r_.fraction + i) != one);
      Apart& lanes = apart[i / pack_lanes];
      lanes = whole ? march<true>(i, here) : march<false>(i, here);
      strikes += __builtin_popcount(lanes.strikes);
    }
    return strikes;
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

  // A pack of impacts.
  struct Strikes {
    StrikeRows rows;
    alignas(64) double parts[pack_lanes], rates[pack_lanes];  // of what is left of the interval; falling
    unsigned found;                                           // bits of the impacts of which that is certain
    unsigned told, rock;  // those that count; that rock on, as far as the knot ahead
  };

  // The blocks of the first pack strike the floor. Those that rock on, certainly without a slip, or a row of hops that die
  // out, stand on the other corner then, at the knot ahead unless something more happens before.
  void strike(Strikes& s, unsigned here) {
    StrikeRows& k = s.rows;
    const Pack zero(0.0), one(1.0), fraction = load(r_.fraction), a = load(r_.a),
                                    a_next = fetch(r_.next) + load(r_.slope), change = a_next - a;
    RockSeries<N> y;
    auto pull = pull_of(0, fraction);
    expand<false>(y, 0, fraction, load(r_.omega), Interval(r_.shakes, 0, r_.next).per_inertia(load(r_.gravity)),
                  load(r_.push), a, change, pull);
    const Pack end = y.sum(y.theta), guess = first_zero(y.theta[0], y.omega[0], end);
    const Pack part = bracketed_root<N + 1>(y.theta, one, zero, one, guess, end <= zero);
    const Pack falls = y.at(y.omega, part) / fraction, omega = zero - load(k.kept) * falls;
    const Pack ahead = fraction - fraction * part, now = a + change * part;
    // A block that rises first falls all the while.
    const Pack bow = Pack(2.0) * xsimd::abs(y.omega[2]) + Pack(6.0) * xsimd::abs(y.omega[3]);
    const PackMask rises = y.omega[0] > zero, once = (y.omega[0] < zero) | (y.omega[1] + bow < zero);
    const PackMask tops = rises & once & top_matters(y, end);
    if (bits(tops) & here) {
      turn(y, 0, y.sum(y.omega), tops);
      const Pack peak = load(k.peak);
      store(k.peak, choose(tops, xsimd::max(peak, load(r_.room) - load(k.shift)), peak));
    }
    store(s.parts, part);
    store(s.rates, falls);
    s.found = bits(once & (part > zero) & (falls < zero)) & here;
    s.told = bits(falls * falls >= load(k.told));
    s.rock = Gravity::shaken ? 0 : bits(stand(k, omega, now, ahead, a_next)) & s.found;
    if (s.rock) march<false>(0, s.rock);
  }

 private:
  // The block may rise higher than ever before, or slip farther then; theta: at the end of the step.
  PackMask top_matters(const RockSeries<N>& y, const Pack& theta) const {
    const Pack reach = xsimd::abs(y.omega[0]) + xsimd::abs(y.sum(y.omega)) + xsimd::abs(y.omega[1]);
    return xsimd::max(y.theta[0], theta) + reach > load(r_.look);
  }

  // On the corner that came down, with a rate; true: there is nothing else to it.
  PackMask stand(const StrikeRows& k, const Pack& omega, const Pack& a, const Pack& ahead, const Pack& a_next) {
    const Pack zero(0.0), two(2.0), arm = load(k.arm), height = load(k.height), omega2 = omega * omega;
    const Pack gravity = load(k.gravity), push = load(k.push), weight = zero - load(r_.weight);
    const Pack weight_g = load(r_.weight_g), mu_left = load(r_.mu_right), mu_right = load(r_.mu_left),
               turned = load(r_.turned), base = load(r_.half_base);
    const Pack held = Gravity::turn_over(r_.shakes, arm, height, base), slope = load(r_.slope) + held, now = a + held;
    const Pack pull = arm * gravity + height * (push * now), floor = weight * now;
    const Pack fx = arm * omega2 - height * pull + floor, lift = zero - arm * pull - height * omega2;
    const Pack grip = choose(fx > zero, mu_left, mu_right) * (weight_g + lift) - xsimd::abs(fx);
    const Pack room = xsimd::max(load(k.peak) - load(k.shift), zero);

    const Pack most = xsimd::max(xsimd::abs(floor), xsimd::abs(weight * (a_next + held))),
               swing = two * height * omega2;
    const Pack hop_fx = load(k.fx) + load(k.fx1) * most + swing, hop_lift = load(k.lift) + load(k.lift1) * most + swing;
    const Pack along = weight * slope, ax = fx - along, hop_ax = hop_fx + xsimd::abs(along);
    const PackMask dies = (load(k.row) * omega <= load(k.slow)) & (omega2 < load(k.last_told)) &
                          (hop_ax * hop_ax + hop_lift * hop_lift < load(r_.seen)) &
                          (hop_fx < xsimd::min(mu_left, mu_right) * (weight_g - hop_lift));
    const Pack limit2 = Pack(4.0) * xsimd::min(load(k.limit2), turned * turned);
    const PackMask hops = (omega2 * omega2 < limit2 * (pull * pull)) & (xsimd::abs(floor) <= load(k.tips));
    const PackMask rocks =
        (grip > zero) & (omega2 >= load(k.rests)) & (ahead > Pack(1e-9)) & (omega > zero) & ~(dies | hops);

    store(r_.theta, zero);
    store(r_.omega, omega);
    store(r_.rx, zero - arm);
    store(r_.ry, height);
    store(r_.a, a);
    store(r_.fraction, ahead);
    store(r_.grip, grip);
    store(r_.square, ax * ax + lift * lift);
    store(r_.mu_left, mu_left);
    store(r_.mu_right, mu_right);
    store(r_.gravity, gravity);
    store(r_.push, push);
    store(r_.weight, weight);
    store(r_.room, room);
    store(r_.look, xsimd::min(turned, xsimd::sqrt(two * room / base)));
    store(r_.curvature0, load(k.curvature0));
    store(r_.curvature1, load(k.curvature1));
    store(r_.curvature2, load(k.curvature2));
    return rocks;
  }

  template <bool Whole>
  Apart march(int i, unsigned here) {
    const Pack zero(0.0), one(1.0), fraction = Whole ? one : load(r_.fraction + i);
    Step y;
    const Pack slope = load(r_.slope + i), a = load(r_.a + i), a_next = fetch(r_.next + i) + slope, change = a_next - a;
    const Pack push = load(r_.push + i), gravity = load(r_.gravity + i), omega0 = load(r_.omega + i);
    const Interval shakes(r_.shakes, i, r_.next + i);
    const auto field = shakes.per_inertia(gravity);
    auto pull = pull_of(i, fraction);
    expand<Whole>(y, i, fraction, omega0, field, push, a, change, pull);
    RockEnd end = y.end(a_next);
    const Pack theta = end.theta, rx = end.rx, ry = end.ry;
    Pack omega = end.omega;

    const Pack rate = xsimd::abs(y.omega[0]), reach = rate + xsimd::abs(omega) + xsimd::abs(y.omega[1]);
    const Pack low = xsimd::min(y.theta[0], theta), high = xsimd::max(y.theta[0], theta);
    const PackMask matters = (high + reach > load(r_.look + i)) | (low < reach);
    // Does the rotation turn? It may turn twice where its acceleration is large enough; from standstill it rises.
    const Pack start = y.omega[0] + Pack(1e-280), rises_by = y.omega[1] + (start + start) + Pack(1e-11) * gravity;
    const Pack turning = start * omega, twice = start * rises_by;
    const PackMask wavers = (turning >= zero) & (twice <= zero) & matters;
    const Pack omega1 = omega;
    if constexpr (!Whole) omega = omega * (one / fraction);

    const Pack weight_g = load(r_.weight_g + i), weight = load(r_.weight + i);
    const Pack floor = pull.with_last(a_next), alpha = rx * at_end(field) - ry * (push * floor), omega2 = omega * omega;
    const Pack fx = ry * alpha - rx * omega2 + weight * floor, lift = shakes.lifted(zero) - rx * alpha - ry * omega2;
    const Pack mu = choose(fx > zero, load(r_.mu_left + i), load(r_.mu_right + i));
    const Pack grip0 = load(r_.grip + i), grip = mu * (weight_g + lift) - xsimd::abs(fx);
    const Pack ax = fx - weight * pull.with_last(slope), square0 = load(r_.square + i), square = ax * ax + lift * lift;
    const Pack curvature = curvature_within(i, change, rate, shakes, pull);
    const Pack ends = xsimd::max(square0, square), curvature2 = curvature * curvature;
    const Pack most = ends * Pack(1 + 1.0 / 256) + Pack(257.0) * curvature2;
    const Pack seen = load(r_.seen + i);
    // Nothing but an impact.
    const PackMask sure = (xsimd::min(grip0, grip) > curvature) & (theta < Pack(1.57)) &
                          (xsimd::abs(y.last()) <= Pack(neglected)) & ~wavers;
    PackMask goes = sure & (theta > zero);
    if (const PackMask about = goes & matters & (turning < zero); bits(about)) goes = goes & ~turn(y, i, omega1, about);
    // No top within where the force rises or falls all through: it leaves its chord by 4 curvature x (1 - x) at most.
    const Pack rises = square - square0;
    const PackMask bows = goes & (most > seen) & (rises * rises <= Pack(64.0) * (curvature2 * ends));
    store_where(goes, r_.seen + i, xsimd::max(seen, ends));
    if (bits(bows)) watch<Whole>(y, i, fraction, {omega, rx, ry, a_next}, bows, shakes, pull);

    store_where(goes, r_.theta + i, theta);
    store_where(goes, r_.omega + i, omega);
    store_where(goes, r_.rx + i, rx);
    store_where(goes, r_.ry + i, ry);
    store_where(goes, r_.a + i, a_next);
    shakes.keep(r_.shakes, i, ~goes);
    store_where(goes, r_.grip + i, grip);
    store_where(goes, r_.square + i, square);
    if constexpr (!Whole) store_where(goes, r_.fraction + i, one);
    const unsigned on = bits(goes),
                   strikes = bits(sure & (theta <= zero) & (most <= seen) & (omega < zero) & (omega0 != zero));
    advance(r_.next + i, here & on, Gravity::stride);
    return {here & strikes, here & ~(on | strikes)};
  }

  auto pull_of(int i, const Pack& fraction) const {
    if constexpr (!Gravity::pulls)
      return NoPull{};
    else
      return Gravity::template pull<N>(r_.shakes, i, fraction, load(r_.shakes.xi + i),
                                       load(r_.half_base + i) * versine(load(r_.theta + i)));
  }

  template <bool Whole, class Series, class Field, class Pull>
  [[gnu::always_inline]] void expand(Series& y, int i, const Pack& fraction, const Pack& omega, const Field& gravity,
                                     const Pack& push, const Pack& a, const Pack& change, Pull& pull) const {
    y.theta[0] = load(r_.theta + i);
    y.rx[0] = load(r_.rx + i);
    y.ry[0] = load(r_.ry + i);
    if constexpr (Whole) {
      y.omega[0] = omega;
      expand(y, gravity, push * a, push * change, pull, push);
    } else {
      const Pack fraction2 = fraction * fraction, pushed = push * fraction2;
      y.omega[0] = omega * fraction;
      expand(y, gravity * fraction2, pushed * a, pushed * change, pull, pushed);
    }
  }
  template <class Series, class Field, class Pull>
  [[gnu::always_inline]] static void expand(Series& y, const Field& gravity, const Pack& a0, const Pack& a1, Pull& pull,
                                            const Pack& per) {
    if constexpr (Pull::pulls)
      y.expand(gravity, a0, a1, pull, per);
    else
      y.expand(gravity, a0, a1);
  }

  // How far, at most, the forces leave their chords (CornerConstants::bound_curvatures). A pull makes the field larger, sways as the
  // floor does, and bends by its higher terms, which friction's share of f_y has part in.
  template <class Pull>
  [[gnu::always_inline]] Pack curvature_within(int i, const Pack& change, const Pack& rate, const Interval& shakes,
                                               const Pull& pull) const {
    Pack all = load(r_.curvature0 + i), field = load(r_.curvature2 + i), changes = xsimd::abs(change), bends(0.0);
    if constexpr (Pull::pulls) {
      const auto& p = pull.terms();
      for (int k = 2; k <= N; ++k) bends = bends + xsimd::abs(p[k]);
      const Pack sways = xsimd::abs(p[1]) + bends,
                 larger = Pack(1.0) + load(r_.shakes.share + i) * (xsimd::abs(p[0]) + sways);
      all = all * larger * larger;
      field = field * larger;
      changes = changes + sways;
      bends = bends * xsimd::abs(load(r_.weight + i)) *
              (Pack(1.5) + xsimd::max(load(r_.mu_left + i), load(r_.mu_right + i)));
    }
    const Pack bound = all + (shakes.curvature_with(load(r_.curvature1 + i) * changes) + field * rate) * rate;
    return Pull::pulls ? bound + bends : bound;
  }

  // The rotation turns, near a peak or the floor: the peaks. Lanes that touch the floor.
  template <class Series>
  PackMask turn(const Series& y, int i, const Pack& omega, const PackMask& lanes) {
    const Pack zero(0.0), theta = y.theta_at(turning_point(y, omega));
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
  template <bool Whole, class PullOf>
  void watch(const Step& y, int i, const Pack& fraction, const RockEnd& end, const PackMask& feels,
             const Interval& shakes, const PullOf& pull) {
    const Pack seen = load(r_.seen + i), a = load(r_.a + i), fraction2 = fraction * fraction,
               left4 = fraction2 * fraction2;
    RockEnd there = end;
    there.omega = end.omega * fraction;
    const Pack top =
        watch_force(y, load(r_.weight + i) * fraction2, shakes.per_inertia(load(r_.gravity + i)) * fraction2,
                    load(r_.push + i) * fraction2, a, end.a - a, there, Pack(1.0), seen * left4, true,
                    shakes.lift() * fraction2, load(r_.slope + i), pull);
    store(r_.seen + i, choose(feels, Whole ? top : top / left4, seen));
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
