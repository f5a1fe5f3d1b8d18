// Pure rocking in packs. Every lane carries its own sample, with its own record, time and parameters; a lane whose
// sample ends takes the next one.
//
// Lanes that rock march side by side, one step per knot interval (dynamics/pack/rock_march.hpp). Those to which something
// may happen within the interval (impact, turning point higher than any before or near the floor, overturning) leave the
// others before the step. Plain impacts are gone through in packs (dynamics/pack/rock_strikes.hpp), as are rows of small
// hops (dynamics/pack/rock_hops.hpp); the rest is gathered here and gone through event by event, again in packs: roots by
// Halley's method on the polynomials, kept in their brackets.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/rock_hops.hpp"
#include "dynamics/pack/rock_series.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// N: order of the series where something happens.
template <int N>
class RockPool : RockHops {
 public:
  using RockHops::RockHops;

  void run() {
    while (live_ > 0) {
      const bool few = rocks_.count() < pack_lanes;  // fewer than a pack
      if (hopping() >= 3 * pack_lanes || (hopping() > 0 && waiting_ + striking() == 0 && few))
        hop();
      else if (striking() >= strikes_at_once || (striking() > 0 && few))
        strike_all();
      else if (waiting_ >= 2 * pack_lanes || (waiting_ > 0 && few))
        resolve();
      else
        march();
    }
  }

 private:
  using Step = StepOf<N>;
  static constexpr bool strikes_in_packs = std::is_same_v<Step, RockStep>;

  // One interval for every lane to which nothing happens. Those to which something does wait for each other.
  void march() {
    std::uint64_t falls;
    const std::uint64_t apart = rocks_.march<Step>(falls);
    for (std::uint64_t open = apart; open;) {  // downwards, as the last one fills a gap
      const int k = 63 - __builtin_clzll(open), slot = rocks_.lane(k);
      open &= ~(std::uint64_t{1} << k);
      if (strikes_in_packs && (falls >> k & 1U)) {
        to_strike(k);
        continue;
      }
      typename RockHops::Marcher marcher{*this, slot};
      rocks_.remove(marcher, k);
      if (free_of(slot) <= 0)
        end_record(slot);
      else
        queue_[waiting_++] = slot;
    }
  }

  // Lanes that stand aside, and the interval of each.
  struct Aside {
    int slots[pack_lanes];
    int count;
    Pack fraction, fraction2, a, rate, side, gravity, push;
    RockSeries<N> y;
    Pack last, theta_end, omega_end, sense;
    PackMask turns, falls;
  };

  // One round of events for them, in two packs where they are so many.
  void resolve() {
    if (waiting_ > pack_lanes)
      resolve_packs<2>();
    else
      resolve_packs<1>();
  }

  template <int count>
  void resolve_packs() {
    Aside aside[count];
    Bracket turns[count], falls[count];
    for (int q = 0; q < count; ++q) {
      gather(aside[q]);
      turns[q] = turn(aside[q]);
    }
    narrow_all<N + 1>(turns);
    for (int q = 0; q < count; ++q) falls[q] = fall(aside[q], choose(aside[q].turns, turns[q].x, aside[q].last));
    narrow_all<N + 1>(falls);
    for (int q = 0; q < count; ++q)
      settle_all(aside[q], choose(aside[q].turns, turns[q].x, aside[q].last),
                 choose(aside[q].falls, falls[q].x, aside[q].last));
  }

  void gather(Aside& lanes) {
    lanes.count = waiting_ < pack_lanes ? waiting_ : pack_lanes;
    waiting_ -= lanes.count;
    int(&slots)[pack_lanes] = lanes.slots;
    for (int l = 0; l < pack_lanes; ++l) slots[l] = queue_[waiting_ + (l < lanes.count ? l : 0)];
    const auto gathered = [&](const double* row) {
      alignas(64) double values[pack_lanes];
      for (int l = 0; l < pack_lanes; ++l) values[l] = row[slots[l]];
      return load(values);
    };
    alignas(64) double nexts[pack_lanes];
    for (int l = 0; l < pack_lanes; ++l) nexts[l] = *r_.next[slots[l]];
    lanes.fraction = gathered(r_.fraction);
    lanes.fraction2 = lanes.fraction * lanes.fraction;
    lanes.a = gathered(r_.a);
    lanes.rate = load(nexts) - lanes.a;
    lanes.side = gathered(r_.side);
    lanes.gravity = gathered(r_.gravity) * lanes.fraction2;
    lanes.push = gathered(r_.push) * lanes.fraction2;
    RockSeries<N>& y = lanes.y;
    y.theta[0] = gathered(r_.theta);
    y.omega[0] = gathered(r_.omega) * lanes.fraction;
    y.rx[0] = gathered(r_.rx);
    y.ry[0] = gathered(r_.ry);
    y.expand(lanes.gravity, lanes.push * lanes.a, lanes.push * lanes.rate);
  }

  // The turning point. Where the angular velocity may turn twice, the step goes first to the point between where its
  // rate is zero.
  static Bracket turn(Aside& lanes) {
    const Pack zero(0.0), one(1.0);
    const RockSeries<N>& y = lanes.y;
    lanes.last = one;
    lanes.theta_end = y.sum(y.theta);
    lanes.omega_end = y.sum(y.omega);
    const PackMask twice = turns_twice(y, lanes.omega_end);
    if (bits(twice)) {
      const Pack rate_end = y.sum(y.rx) * lanes.gravity - y.sum(y.ry) * (lanes.push * (lanes.a + lanes.rate));
      const Pack middle = y.omega[1] / (y.omega[1] - rate_end);
      lanes.last = choose(twice & (middle > zero) & (middle < one), middle, one);
      lanes.theta_end = y.at(y.theta, lanes.last);
      lanes.omega_end = y.at(y.omega, lanes.last);
    }
    const Pack side = lanes.side, last = lanes.last;
    lanes.sense = choose((side * y.omega[0] > zero) | (y.omega[0] == zero), side, zero - side);
    lanes.turns = lanes.sense * lanes.omega_end < zero;
    const Pack guess =
        last * first_zero(lanes.sense * y.omega[0], lanes.sense * y.omega[1] * last, lanes.sense * lanes.omega_end);
    return {y.omega, lanes.sense, zero, last, guess, lanes.turns};
  }

  // The impact.
  static Bracket fall(Aside& lanes, const Pack& turn) {
    const Pack zero(0.0), side = lanes.side, last = lanes.last;
    const RockSeries<N>& y = lanes.y;
    const Pack theta_turn = y.at(y.theta, turn);
    const PackMask dips = lanes.turns & (side * theta_turn <= zero), rises = lanes.sense == side;
    lanes.falls = (side * lanes.theta_end <= zero) | dips;
    const Pack from = choose(lanes.turns & rises, turn, zero), to = choose(dips, turn, last);
    const Pack end = choose(dips, theta_turn, lanes.theta_end);
    const Pack guess = to * first_zero(side * y.theta[0], side * y.omega[0] * to, side * end);
    return {y.theta, side, from, to, guess, lanes.falls};
  }

  // `part`: how far the lanes go.
  void settle_all(const Aside& lanes, const Pack& turn, const Pack& part) {
    const RockSeries<N>& y = lanes.y;
    const Pack side = lanes.side;
    const RockEnd end{y.at(y.omega, part), y.at(y.rx, part), y.at(y.ry, part), lanes.a + lanes.rate * part};
    const Pack theta = y.at(y.theta, part), low_turn = side * y.at(y.theta, turn);
    alignas(64) double seen[pack_lanes], weights[pack_lanes];
    for (int l = 0; l < pack_lanes; ++l) {
      seen[l] = r_.force2[lanes.slots[l]];
      weights[l] = r_.weight[lanes.slots[l]];
    }
    const Pack fraction4 = lanes.fraction2 * lanes.fraction2;
    const Pack force2 = watch_force(y, load(weights) * lanes.fraction2, lanes.gravity, lanes.push, lanes.a, lanes.rate,
                                    end, part, load(seen) * fraction4, true) /
                        fraction4;
    const PackMask rises = lanes.sense == side;
    const Pack highest = xsimd::max(side * y.theta[0], choose(lanes.turns & rises, low_turn, side * theta));

    Ends ends;
    store(ends.theta, theta);
    store(ends.omega, end.omega / lanes.fraction);
    store(ends.rx, end.rx);
    store(ends.ry, end.ry);
    store(ends.part, part);
    store(ends.a, end.a);
    store(ends.force2, force2);
    store(ends.highest, highest);
    const unsigned hits = bits(lanes.falls);
    for (int l = 0; l < lanes.count; ++l) settle(lanes.slots[l], ends, l, hits >> l & 1U);
  }

  struct Ends {
    alignas(64) double theta[pack_lanes], omega[pack_lanes], rx[pack_lanes], ry[pack_lanes], part[pack_lanes],
        a[pack_lanes], force2[pack_lanes], highest[pack_lanes];
  };

  // What follows for one lane: it goes on from the end of its interval, or from the impact within.
  void settle(int i, const Ends& ends, int l, bool hits) {
    if (ends.highest[l] >= 0.5 * pi) return overturn(i);
    if (!(ends.highest[l] < 0.5 * pi)) return decline(i);
    if (ends.force2[l] > r_.force2[i]) r_.force2[i] = ends.force2[l];
    r_.peak[i] = larger(r_.peak[i], ends.highest[l]);
    if (hits) {
      r_.fraction[i] -= r_.fraction[i] * ends.part[l];
      r_.a[i] = ends.a[l];
      return strike(i, ends.omega[l]);
    }
    r_.theta[i] = ends.theta[l];
    r_.omega[i] = ends.omega[l];
    r_.rx[i] = ends.rx[l];
    r_.ry[i] = ends.ry[l];
    if (ends.part[l] < 1) {
      r_.fraction[i] -= r_.fraction[i] * ends.part[l];
      r_.a[i] = ends.a[l];
    } else {
      to_next_knot(i);
    }
    go_on(i);
  }

  // Goes through the interval again with bisection: when |theta| = pi/2.
  void overturn(int i) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    RockSeries<N> y;
    const double fraction = r_.fraction[i], change = *r_.next[i] - r_.a[i];
    y.theta[0] = Pack(r_.theta[i]);
    y.omega[0] = Pack(r_.omega[i] * fraction);
    y.rx[0] = Pack(r_.rx[i]);
    y.ry[0] = Pack(r_.ry[i]);
    const double push = r_.push[i] * fraction * fraction;
    y.expand(Pack(r_.gravity[i] * fraction * fraction), Pack(push * r_.a[i]), Pack(push * change));
    double lo = 0, hi = 1;
    for (int round = 0; round < 50; ++round) {
      const double middle = 0.5 * (lo + hi);
      (r_.side[i] * y.at(y.theta, Pack(middle)).get(0) < 0.5 * pi ? lo : hi) = middle;
    }
    const Pack at(hi);
    const RockEnd end{y.at(y.omega, at), y.at(y.rx, at), y.at(y.ry, at), Pack(r_.a[i] + change * hi)};
    const double fraction2 = fraction * fraction, fraction4 = fraction2 * fraction2;
    r_.force2[i] = watch_force(y, Pack(r_.weight[i] * fraction2), Pack(r_.gravity[i] * fraction2), Pack(push),
                               Pack(r_.a[i]), Pack(change), end, at, Pack(r_.force2[i] * fraction4), true)
                       .get(0) /
                   fraction4;
    r_.peak[i] = 0.5 * pi;
    ++lane.events;
    const double intervals = knot(i) + 1 - fraction + fraction * hi,
                 knots = (lane.after ? c.table->knots - 1 : 0) + intervals;
    if (lane.after && c.table->step_s * intervals > c.free_vibration_s) return decline(i);
    finish(i, Outcome::overturned, c.table->step_s * knots, r_.side[i] * 0.5 * pi);
    refill(i);
  }
};

template <int N>
void rock_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  RockPool<N> pool(cases, count, responses, declined);
  pool.run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
