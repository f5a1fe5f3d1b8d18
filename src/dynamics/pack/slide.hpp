// Pure sliding in packs. Under a piecewise linear record it is arithmetic, not integration: at rest the search is for
// |a| > mu_s g, while slipping for the knot at which a line is crossed (dynamics/pack/slide_search.hpp), with one quadratic
// at the end. The displacement follows from D = int int a; |u| has its peaks where the slip ends only.
//
// Every lane carries its own sample. One turn takes each from slip to slip: the searches lane by lane, each with whole
// packs of knots, and the end of the slip and the start of the next for a pack of lanes at once. The search for the next
// start goes before the arithmetic has told whether the slip ends there. A slip that does not, one whose search named a
// knot too early by a trifle, and a new sample are all the same to the arithmetic: slips that go on, or of no length.
// The lanes are in two halves, and while the one is searched the arithmetic of the other has time.
// All in units of the scale.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/search.hpp"
#include "dynamics/pack/slide_search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int slide_slots = 16, half_slots = slide_slots / 2;
// While the block slips, the terms of a height stay within the 64,000 heights over which the floor's velocity swings: they round
// off to 1e-11 of one each.
constexpr double height_slack = 1e-6;
alignas(64) const double still_knot[2 * table_columns] = {};

struct SlideRows {
  alignas(64) double gs[slide_slots], gk[slide_slots], step[slide_slots];  // friction limits in units of |scale|
  alignas(64) double heights_to_one[slide_slots], backwards[slide_slots];
  // The slip: it began tau after knot m, with the floor's integrals there.
  alignas(64) double m[slide_slots], tau[slide_slots], V[slide_slots], D[slide_slots];
  alignas(64) double sigma[slide_slots], next[slide_slots];  // direction, and speed at knot m + 1
  alignas(64) double known[slide_slots];                     // when it ends within that interval; else < 0
  // Where its end is searched from: knot, place in the row of heights, line.
  alignas(64) int from[slide_slots], place[slide_slots], height[slide_slots], drop[slide_slots];
  alignas(64) int crossing[slide_slots], exceeding[slide_slots];  // the knots found
  alignas(64) const double* stop[slide_slots];                    // and those before them
  alignas(64) const double* start[slide_slots];
  alignas(64) double a[slide_slots];  // the floor's acceleration where the block stopped last
  alignas(64) double u[slide_slots], path[slide_slots], peak[slide_slots];
  alignas(64) double hardest[slide_slots], events[slide_slots];  // largest |acceleration|, changes of mode
};

// The floor within an interval.
struct Within {
  Pack a, V, D, slope;
  explicit Within(const double* const* knot) { fetch_columns(knot, a, V, D, slope); }
  Within(const PackMask& mask, const Within& yes, const Within& no)
      : a(choose(mask, yes.a, no.a)),
        V(choose(mask, yes.V, no.V)),
        D(choose(mask, yes.D, no.D)),
        slope(choose(mask, yes.slope, no.slope)) {}
  Pack acceleration(const Pack& tau) const { return a + slope * tau; }
  Pack velocity(const Pack& tau) const { return V + tau * (a + Pack(0.5) * slope * tau); }
  Pack displacement(const Pack& tau) const {
    return D + tau * (V + tau * (Pack(0.5) * a + slope * tau * Pack(1.0 / 6)));
  }
};

class SlidePool {
 public:
  SlidePool(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined)
      : cases_(cases), count_(count), responses_(responses), declined_(declined) {
    for (int i = 0; i < slide_slots; ++i) {
      r_.gs[i] = r_.gk[i] = r_.step[i] = r_.sigma[i] = 1;
      r_.heights_to_one[i] = r_.backwards[i] = 0;
      r_.m[i] = r_.tau[i] = r_.V[i] = r_.D[i] = r_.next[i] = r_.known[i] = 0;
      r_.a[i] = r_.u[i] = r_.path[i] = r_.peak[i] = r_.hardest[i] = r_.events[i] = 0;
      r_.crossing[i] = r_.exceeding[i] = 1;
      r_.stop[i] = r_.start[i] = still_knot;
    }
  }

  void run() {
    for (int i = 0; i < slide_slots; ++i) take(i);
    find_ends(half_slots);
    find_starts(half_slots);
    while (busy_) {
      turn(half_slots, 0);
      turn(0, half_slots);
    }
  }

 private:
  struct Lane {
    const BatchCase* sample = nullptr;  // null: none
    const MotionTable* table = nullptr;
    const std::uint16_t *heights = nullptr, *levels = nullptr, *run_levels = nullptr;
    const double* columns = nullptr;
    int knots = 0;
    std::uint16_t level = 0;  // of mu_s g
  };
  // Slips in the intervals before their crossings: when the speed is zero, if it was a parabola for ever.
  struct Approach {
    Pack knot, fall;
    PackMask rises, turns;  // the speed is above zero at the crossing; it has no zero that counts
  };
  // Where they are then: tau after the knot before.
  struct Reached {
    Pack knot, tau, a;
    PackMask on, pushed;  // the slip goes on; or it ends, and the next starts at once
  };

  // The next sample, at rest at the record's start.
  void take(int i) {
    Lane& lane = lanes_[i];
    lane.sample = nullptr;
    busy_ &= ~(1U << i);
    for (; taken_ < count_; ++taken_) {
      const BatchCase& c = cases_[taken_];
      declined_[taken_] = !(c.mu_k > 0) || c.scale == 0;
      if (declined_[taken_]) continue;
      const double size = magnitude(c.scale), gs = c.mu_s * c.g / size;
      const MotionTable& t = *c.table;
      lane = {&c, &t, t.heights.data(), t.levels.data(), t.run_levels.data(), t.columns.data(), t.knots, t.level(gs)};
      busy_ |= 1U << i;
      r_.gs[i] = gs;
      r_.gk[i] = c.mu_k * c.g / size;
      r_.step[i] = t.step_s;
      r_.heights_to_one[i] = t.heights_to_one;
      r_.backwards[i] = t.backwards;
      r_.u[i] = r_.path[i] = r_.peak[i] = r_.hardest[i] = 0;
      r_.events[i] = magnitude(t.acceleration[0]) > gs;
      stand(i, 0);
      ++taken_;
      return;
    }
  }

  // A lane at rest at knot j: its last slip ends there.
  void stand(int i, int j) {
    r_.m[i] = j;
    r_.tau[i] = r_.known[i] = r_.V[i] = 0;
    r_.D[i] = lanes_[i].table->displacement[static_cast<std::size_t>(j)];
    r_.from[i] = r_.place[i] = j + 1;
    r_.height[i] = r_.drop[i] = 0;
    r_.events[i] -= 1;
  }

  // The intervals before the knots at which the slips have ended or may have.
  void find_ends(int first) {
    for (int i = first; i < first + half_slots; ++i) {
      if (!lanes_[i].sample) continue;
      int k = r_.from[i] + first_crossing(lanes_[i].heights + r_.place[i], {r_.height[i], r_.drop[i]});
      if (k >= lanes_[i].knots) [[unlikely]] {
        finish_after_motion(i);
        take(i);
        if (!lanes_[i].sample) continue;
        k = r_.from[i];
      }
      r_.crossing[i] = k;
      r_.stop[i] = before(lanes_[i], k);
    }
  }

  // And before those after them at which the floor pushes hard enough or may.
  void find_starts(int first) {
    for (int i = first; i < first + half_slots; ++i) {
      const Lane& lane = lanes_[i];
      if (!lane.sample) continue;
      const unsigned j = first_loud(lane.levels, lane.run_levels, lane.level, static_cast<unsigned>(r_.crossing[i]));
      r_.exceeding[i] = static_cast<int>(j);
      r_.start[i] = before(lane, r_.exceeding[i]);
    }
  }

  static const double* before(const Lane& lane, int knot) {
    const double* p = lane.columns + static_cast<std::size_t>(knot - 1) * table_columns;
    __builtin_prefetch(p);
    return p;
  }

  // The arithmetic of one half and the searches of the other.
  [[gnu::noinline]] void turn(int first, int other) {
    Approach approaches[half_slots / pack_lanes];
    for (int i = 0; i < half_slots / pack_lanes; ++i) approach(first + i * pack_lanes, approaches[i]);
    find_ends(other);
    for (int i = 0; i < half_slots / pack_lanes; ++i) set_out(first + i * pack_lanes, approaches[i]);
    find_starts(other);
  }

  // What takes long of the ends of the slips.
  [[gnu::always_inline]] void approach(int first, Approach& to) {
    const Within floor(r_.stop + first);
    const Pack one(1.0), zero(0.0), two(2.0), h = load(r_.step + first), gk = load(r_.gk + first);
    const Pack start = load(r_.tau + first), V = load(r_.V + first), sigma = load(r_.sigma + first);
    const Pack knot = load_whole(r_.crossing + first), known = load(r_.known + first);
    const Pack intervals = knot - one - load(r_.m + first);
    const Pack w =
        choose(intervals == one, load(r_.next + first), sigma * (V - floor.V) - gk * (intervals * h - start));
    const Pack rate = zero - sigma * floor.a - gk, half = Pack(-0.5) * sigma * floor.slope;
    const Pack square = rate * rate - Pack(4.0) * half * w, w_next = w + h * (rate + half * h);
    const Pack fall = choose(w > zero, two * w / (xsimd::sqrt(xsimd::max(square, zero)) - rate), zero);
    to.knot = knot;
    to.fall = fall;
    to.rises = (w_next > zero) & (known < zero);
    to.turns = (rate >= zero) | (square < zero);
  }

  // The ends of the slips. One whose speed turns before it is zero goes on.
  [[gnu::always_inline]] Reached arrive(int first, const Approach& to, const Within& floor) {
    const Pack one(1.0), zero(0.0), h = load(r_.step + first), gk = load(r_.gk + first);
    const Pack start = load(r_.tau + first), V = load(r_.V + first), sigma = load(r_.sigma + first);
    const Pack known = load(r_.known + first), intervals = to.knot - one - load(r_.m + first);
    const PackMask on = to.rises & (to.turns | (to.fall > h));
    const Pack tau = choose(known < zero, xsimd::min(to.fall, h), known), a = floor.acceleration(tau);
    const Pack time = intervals * h + (tau - start);
    const Pack slid = time * (V - Pack(0.5) * sigma * gk * time) - (floor.displacement(tau) - load(r_.D + first));
    const Pack moved = choose(on, zero, slid), u = load(r_.u + first) + moved;
    store(r_.u + first, u);
    store(r_.path + first, load(r_.path + first) + xsimd::abs(moved));
    store(r_.peak + first, xsimd::max(load(r_.peak + first), xsimd::abs(u)));
    store(r_.a + first, a);
    return {to.knot, tau, a, on, (!on) & (xsimd::abs(a) > load(r_.gs + first))};
  }

  // The start of the next slips, where the last have ended.
  [[gnu::always_inline]] void set_out(int first, const Approach& to) {
    const Within stopped(r_.stop + first);
    const Reached last = arrive(first, to, stopped);
    const Pack one(1.0), zero(0.0), h = load(r_.step + first);
    const Pack gs = load(r_.gs + first), gk = load(r_.gk + first);
    const PackMask& pushed = last.pushed;
    const Pack exceeding = load_whole(r_.exceeding + first), a_next = fetch(r_.start + first, table_columns);
    const Within waited(r_.start + first), floor(pushed, stopped, waited);
    const PackMask named_for_nothing = !(last.on | pushed | (xsimd::abs(a_next) > gs));
    const PackMask none = last.on | named_for_nothing;
    const Pack limit = choose(a_next < zero, zero - gs, gs);
    const Pack tau = choose(pushed, last.tau, (limit - waited.a) / waited.slope), a = choose(pushed, last.a, limit);
    const Pack sigma = choose(a > zero, zero - one, one), left = h - tau;
    const Pack rate = zero - sigma * a - gk, half = Pack(-0.5) * sigma * floor.slope;
    const Pack next = left * (rate + half * left);
    const PackMask brief = (!last.on) & (next < zero);  // ends before the first knot
    Pack known = zero - one;
    if (bits(brief)) known = choose(brief, xsimd::min(tau + choose(rate > zero, zero - rate / half, zero), h), known);
    const auto kept = [&](const double* row, const Pack& now) { return choose(last.on, load(row + first), now); };
    const Pack V = kept(r_.V, floor.velocity(tau)), D = kept(r_.D, floor.displacement(tau));
    const Pack way = kept(r_.sigma, sigma), begin = kept(r_.tau, tau),
               m = kept(r_.m, choose(pushed, last.knot, exceeding) - one);
    const Pack from = choose(last.on, last.knot + one, m + choose(brief, one, Pack(2.0)));
    store(r_.m + first, m);
    store(r_.tau + first, begin);
    store(r_.V + first, V);
    store(r_.D + first, D);
    store(r_.sigma + first, way);
    store(r_.next + first, kept(r_.next, next));
    store(r_.known + first, known);
    store(r_.events + first, load(r_.events + first) + choose(last.on, zero, one) + choose(none | pushed, zero, one));
    store(r_.hardest + first, xsimd::max(load(r_.hardest + first), choose(none, zero, choose(pushed, gk, gs))));
    draw_lines(first, from, way, way * V + gk * begin - gk * h * (from - m), brief);
    for (unsigned rest = bits(named_for_nothing) & busy_ >> first; rest; rest &= rest - 1)
      wait(first + __builtin_ctz(rest));
  }

  // Where the ends are searched from and with which line, which has the given height at its start.
  void draw_lines(int first, const Pack& from, const Pack& sigma, const Pack& start, const PackMask& known) {
    const Pack zero(0.0), to_one = load(r_.heights_to_one + first);
    const Pack per_look = Pack(look * (1 + 1e-12)) * load(r_.gk + first) * load(r_.step + first) * to_one;
    const PackMask flat = known | (per_look > Pack(steepest_drop));
    const Pack height = xsimd::floor(start * to_one + Pack(height_zero - height_slack));
    store_whole(r_.from + first, from);
    store_whole(r_.place + first, from + choose(sigma < zero, load(r_.backwards + first), zero));
    store_whole(r_.height + first, choose(flat, zero, xsimd::min(xsimd::max(height, zero), Pack(largest_short))));
    store_whole(r_.drop + first, choose(flat, zero, xsimd::ceil(per_look)));
  }

  // A lane at rest that found no push: from that knot on, if the record goes on.
  [[gnu::noinline]] void wait(int i) {
    if (r_.exceeding[i] < lanes_[i].table->knots) return stand(i, r_.exceeding[i]);
    finish_at_rest(i);
    take(i);
  }

  // Friction alone brings the block to rest.
  [[gnu::noinline]] void finish_after_motion(int i) {
    const Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const int last = lane.table->knots - 1;
    const double time = (last - r_.m[i]) * r_.step[i] - r_.tau[i], sigma = r_.sigma[i], gk = r_.gk[i];
    const double V = lane.table->velocity[static_cast<std::size_t>(last)];
    const double w = last == r_.m[i] + 1 ? r_.next[i] : sigma * (r_.V[i] - V) - gk * time, left = w / gk;
    declined_[number(lane)] = !(left < c.free_vibration_s);
    if (declined_[number(lane)]) return;
    if (w > 0) {
      move(i, time * (r_.V[i] - 0.5 * sigma * gk * time) -
                  (lane.table->displacement[static_cast<std::size_t>(last)] - r_.D[i]));
      move(i, 0.5 * sigma * w * left);
    }
    r_.events[i] += 1;
    finish(i, last * r_.step[i] + left);
  }

  void move(int i, double moved) {
    r_.u[i] += moved;
    r_.path[i] += magnitude(moved);
    r_.peak[i] = larger(r_.peak[i], magnitude(r_.u[i]));
  }

  void finish_at_rest(int i) {
    const Lane& lane = lanes_[i];
    const MotionTable& t = *lane.table;
    finish(i, (t.knots - 1) * t.step_s);
    if (r_.hardest[i] >= r_.gs[i]) return;
    Response& out = responses_[number(lane)];
    const double most = larger(magnitude(r_.a[i]), peak_from(t, r_.crossing[i]));
    out.peak_acceleration_mps2 = larger(out.peak_acceleration_mps2, most * magnitude(lane.sample->scale));
  }

  void finish(int i, double time) {
    const double scale = lanes_[i].sample->scale, size = magnitude(scale);
    Response& out = responses_[number(lanes_[i])];
    out = Response{};
    out.outcome = r_.events[i] > 0 ? Outcome::moved : Outcome::at_rest;
    out.peak_slip_m = r_.peak[i] * size;
    out.residual_slip_m = r_.u[i] * scale;
    out.slid_path_m = r_.path[i] * size;
    out.peak_acceleration_mps2 = r_.hardest[i] * size;
    out.events = static_cast<int>(r_.events[i]);
    out.end_time_s = time;
  }

  std::size_t number(const Lane& lane) const { return static_cast<std::size_t>(lane.sample - cases_); }

  const BatchCase* cases_;
  std::size_t count_;
  Response* responses_;
  std::uint8_t* declined_;
  std::size_t taken_ = 0;
  unsigned busy_ = 0;  // bit i: slot i has a sample
  SlideRows r_;
  Lane lanes_[slide_slots];
};

inline void slide_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  SlidePool(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
