// Pure sliding in packs. Under a piecewise linear record it is arithmetic, not integration: at rest the search is for
// |a| > mu_s g, while slipping for the knot at which a line is crossed (dynamics/pack/slide_stop.hpp), with one quadratic
// at the end. The displacement follows from D = int int a; |u| has its peaks where the slip ends only.
//
// Every lane carries its own sample. One round takes each from rest to rest: the searches lane by lane, each with whole
// packs of knots, the arithmetic of the breaks and stops for all lanes at once. A search may name a knot too early by a
// trifle or by a dip that is none; the arithmetic finds out, and the lane goes on from there in the next round. What the
// arithmetic needs is asked of the memory when a search ends, so that it comes while other lanes are being searched.
// All in units of the scale.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/search.hpp"
#include "dynamics/pack/slide_stop.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int slide_slots = 16;
constexpr unsigned all_lanes = (1U << pack_lanes) - 1;
alignas(64) const double still_knot[2 * table_columns] = {};

struct SlideRows {
  alignas(64) double gs[slide_slots], gk[slide_slots];  // friction limits in units of |scale|
  alignas(64) double step[slide_slots], rate[slide_slots];
  // Where the lane is: tau after knot m, with the floor's acceleration and its integrals there.
  alignas(64) const double* knot[slide_slots];
  alignas(64) double m[slide_slots], tau[slide_slots], a[slide_slots], V[slide_slots], D[slide_slots];
  alignas(64) double pushed[slide_slots];                         // 1: |a| > mu_s g here, so that a slip starts at once
  alignas(64) double sigma[slide_slots], next[slide_slots];       // the slip
  alignas(64) double ahead[slide_slots];                          // knots from m to where its end is searched
  alignas(64) float line[slide_slots], drop[slide_slots];         // where it crosses the floor's velocity
  alignas(64) const double* stop[slide_slots];                    // and its end: the interval,
  alignas(64) double stop_m[slide_slots], stop_tau[slide_slots];  // tau < 0: to be found
  alignas(64) double u[slide_slots], path[slide_slots], peak[slide_slots];
  alignas(64) double hardest[slide_slots], events[slide_slots];  // largest |acceleration|, changes of mode
};

// The floor within an interval.
struct Within {
  Pack a, slope, V, D;
  Within(const double* const* knot, const Pack& rate_hz)
      : a(fetch(knot, 0)), slope((fetch(knot, table_columns) - a) * rate_hz), V(fetch(knot, 1)), D(fetch(knot, 2)) {}
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
      r_.gs[i] = r_.gk[i] = r_.step[i] = r_.rate[i] = r_.tau[i] = r_.m[i] = r_.pushed[i] = 1;
      r_.a[i] = r_.u[i] = r_.path[i] = r_.peak[i] = r_.hardest[i] = r_.events[i] = r_.ahead[i] = 0;
      r_.knot[i] = still_knot;
    }
  }

  void run() {
    for (int i = 0; i < slide_slots; ++i) take(i);
    while (leave_rest()) {
      for (int i = 0; i < slide_slots; i += pack_lanes) set_out(i);
      for (int i = 0; i < slide_slots; ++i) find_end(i);
      for (int i = 0; i < slide_slots; i += pack_lanes) end(i);
      for (; vacant_; vacant_ &= vacant_ - 1) take(__builtin_ctz(vacant_));
    }
  }

 private:
  struct Lane {
    const BatchCase* sample = nullptr;  // null: none
    int at = 0;                         // knot before
    int from = 0;                       // knot from which on the end of the slip is searched
    const float* rows[2] = {};          // for slips forwards and backwards
    LoudRuns loud = {};                 // beyond mu_s g
  };

  // The next sample, at rest at the record's start.
  void take(int i) {
    Lane& lane = lanes_[i];
    lane.sample = nullptr;
    busy_ &= ~(1U << i);
    for (; taken_ < count_; ++taken_) {
      const BatchCase& c = cases_[taken_];
      const std::size_t number = taken_;
      declined_[number] = !(c.mu_k > 0) || c.scale == 0;
      if (declined_[number]) continue;
      const double size = magnitude(c.scale);
      lane.sample = &c;
      busy_ |= 1U << i;
      lane.at = 0;
      lane.from = 2;
      r_.ahead[i] = 2;
      lane.rows[0] = c.table->above.data();
      lane.rows[1] = c.table->below.data();
      r_.gs[i] = c.mu_s * c.g / size;
      r_.gk[i] = c.mu_k * c.g / size;
      r_.step[i] = c.table->step_s;
      r_.rate[i] = c.table->rate_hz;
      r_.m[i] = r_.tau[i] = r_.u[i] = r_.path[i] = r_.peak[i] = r_.hardest[i] = 0;
      r_.a[i] = c.table->acceleration[0];
      r_.knot[i] = c.table->columns.data();
      r_.pushed[i] = magnitude(r_.a[i]) > r_.gs[i];
      lane.loud.start(*c.table, r_.gs[i]);
      r_.events[i] = r_.pushed[i];
      ++taken_;
      return;
    }
  }

  // Every lane to its next slip. False: no samples are left.
  bool leave_rest() {
    bool any = false;
    for (int i = 0; i < slide_slots; ++i) {
      if (!(r_.pushed[i] > 0)) wait(i, lanes_[i].at + 1);
      any = any || lanes_[i].sample;
    }
    return any;
  }

  // A lane at rest to the interval before the knot at which the floor pushes hard enough, of this sample or the next that
  // moves.
  void wait(int i, int from) {
    Lane& lane = lanes_[i];
    while (lane.sample) {
      const MotionTable& t = *lane.sample->table;
      const int j = lane.loud.next(static_cast<unsigned>(from));
      if (j < t.knots) {
        r_.knot[i] = t.columns.data() + static_cast<std::size_t>(j - 1) * table_columns;
        __builtin_prefetch(r_.knot[i]);
        __builtin_prefetch(r_.knot[i] + table_columns);
        r_.m[i] = lane.at = j - 1;
        lane.from = j + 1;
        r_.ahead[i] = 2;
        return;
      }
      finish_at_rest(i);
      take(i);
      if (r_.pushed[i] > 0) return;
      from = 1;
    }
  }

  // The start of the slips: when, and their lines.
  void set_out(int first) {
    const Pack one(1.0), zero(0.0), h = load(r_.step + first), rate_hz = load(r_.rate + first);
    const Pack gs = load(r_.gs + first), gk = load(r_.gk + first);
    const Within floor(r_.knot + first, rate_hz);
    const PackMask pushed = load(r_.pushed + first) > zero;
    const Pack a_next = fetch(r_.knot + first, table_columns), limit = choose(a_next < zero, zero - gs, gs);
    // Named by the search for nothing.
    if (unsigned quiet = ~bits(pushed | (xsimd::abs(a_next) > gs)) & busy_ >> first & all_lanes) {
      for (; quiet; quiet &= quiet - 1) {
        const int i = first + __builtin_ctz(quiet);
        wait(i, lanes_[i].at + 2);
      }
      return set_out(first);
    }
    const Pack tau = choose(pushed, load(r_.tau + first), (limit - floor.a) * h / (a_next - floor.a));
    const Pack a = choose(pushed, load(r_.a + first), limit), V = floor.velocity(tau);
    const Pack sigma = choose(a > zero, zero - one, one), G = gk * h, left = h - tau;
    const Pack rate = zero - sigma * a - gk, half = Pack(-0.5) * sigma * floor.slope;
    const Pack next = left * (rate + half * left);
    const PackMask brief = next < zero;  // ends before the first knot
    Pack stop_tau = zero - one;
    if (bits(brief))
      stop_tau = choose(brief, xsimd::min(tau + choose(rate > zero, zero - rate / half, zero), h), stop_tau);
    const Pack size = sigma * V + gk * tau, slack(line_slack);
    store(r_.tau + first, tau);
    store(r_.events + first, load(r_.events + first) + choose(pushed, zero, one));
    store(r_.hardest + first, xsimd::max(load(r_.hardest + first), choose(pushed, gk, gs)));
    store(r_.a + first, a);
    store(r_.V + first, V);
    store(r_.D + first, floor.displacement(tau));
    store(r_.sigma + first, sigma);
    alignas(64) double line[pack_lanes], drop[pack_lanes];
    store(line, size - slack * xsimd::abs(size) - G * load(r_.ahead + first));
    store(drop, G * (one + slack));
    for (int i = first; i < first + pack_lanes; ++i) {
      r_.line[i] = static_cast<float>(line[i - first]);
      r_.drop[i] = static_cast<float>(drop[i - first]);
      r_.stop[i] = r_.knot[i];
      r_.stop_m[i] = r_.m[i];
    }
    store(r_.next + first, next);
    store(r_.stop_tau + first, stop_tau);
  }

  // The interval before the knot at which the slip has ended or may have.
  void find_end(int i) {
    const Lane& lane = lanes_[i];
    if (!lane.sample || r_.stop_tau[i] >= 0) return;
    const MotionTable& t = *lane.sample->table;
    const int k = first_crossing(lane.rows[r_.sigma[i] < 0], r_.line[i], r_.drop[i], lane.from, t.knots);
    if (k >= t.knots) return finish_after_motion(i);
    r_.stop[i] = t.columns.data() + static_cast<std::size_t>(k - 1) * table_columns;
    r_.stop_m[i] = k - 1;
    __builtin_prefetch(r_.stop[i]);
    __builtin_prefetch(r_.stop[i] + table_columns);
  }

  // The ends of the slips. A lane whose speed turns before it is zero stays where its slip began, and looks on from the
  // next knot in the next round.
  void end(int first) {
    const Pack one(1.0), zero(0.0), two(2.0), h = load(r_.step + first), gk = load(r_.gk + first);
    const Pack start_m = load(r_.m + first), start = load(r_.tau + first), start_a = load(r_.a + first);
    const Pack start_V = load(r_.V + first), sigma = load(r_.sigma + first), next = load(r_.next + first);
    const Pack stop_m = load(r_.stop_m + first), intervals = stop_m - start_m, found = load(r_.stop_tau + first);
    const auto speed = [&](const Pack& V, const Pack& after) {
      return choose(after == one, next, sigma * (start_V - V) - gk * (after * h - start));
    };
    const Within floor(r_.stop + first, load(r_.rate + first));
    const Pack w = speed(floor.V, intervals),
               w_next = speed(fetch(r_.stop + first, table_columns + 1), intervals + one);
    const Pack rate = zero - sigma * floor.a - gk, half = Pack(-0.5) * sigma * floor.slope;
    const Pack square = rate * rate - Pack(4.0) * half * w;
    const Pack fall = choose(w > zero, two * w / (xsimd::sqrt(xsimd::max(square, zero)) - rate), zero);
    const PackMask open = found < zero;
    const PackMask on = open & (w_next > zero) & ((rate >= zero) | (square < zero) | (fall > h));
    const Pack tau = choose(open, xsimd::min(fall, h), found);
    const Pack time = intervals * h + (tau - start), a = choose(on, start_a, floor.acceleration(tau));
    const Pack moved =
        time * (start_V - Pack(0.5) * sigma * gk * time) - (floor.displacement(tau) - load(r_.D + first));
    const Pack u = load(r_.u + first), at = choose(on, u, u + moved);
    store(r_.u + first, at);
    store(r_.events + first, load(r_.events + first) + choose(on, zero, one));
    store(r_.path + first, load(r_.path + first) + choose(on, zero, xsimd::abs(moved)));
    store(r_.peak + first, xsimd::max(load(r_.peak + first), xsimd::abs(at)));
    store(r_.ahead + first, choose(on, intervals + two, two));
    store(r_.m + first, choose(on, start_m, stop_m));
    store(r_.tau + first, choose(on, start, tau));
    store(r_.a + first, a);
    store(r_.pushed + first, choose(xsimd::abs(a) > load(r_.gs + first) | on, one, zero));
    const unsigned stay = bits(on);
    for (int l = 0; l < pack_lanes; ++l) {
      const int i = first + l, next_m = static_cast<int>(r_.stop_m[i]);
      const bool ended = !(stay >> l & 1U);
      Lane& lane = lanes_[i];
      lane.at = ended ? next_m : lane.at;
      lane.from = next_m + 2;
      r_.knot[i] = ended ? r_.stop[i] : r_.knot[i];
    }
  }

  // Friction alone brings the block to rest.
  void finish_after_motion(int i) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const int last = c.table->knots - 1;
    const double time = (last - lane.at) * c.table->step_s - r_.tau[i], sigma = r_.sigma[i], gk = r_.gk[i];
    const double V = c.table->velocity[static_cast<std::size_t>(last)];
    const double w = last == lane.at + 1 ? r_.next[i] : sigma * (r_.V[i] - V) - gk * time, coast = w / gk;
    vacant_ |= 1U << i;
    if (!(coast < c.free_vibration_s)) {
      declined_[number(lane)] = 1;
      lane.sample = nullptr;
      busy_ &= ~(1U << i);
      return;
    }
    if (w > 0) {
      move(i, time * (r_.V[i] - 0.5 * sigma * gk * time) -
                  (c.table->displacement[static_cast<std::size_t>(last)] - r_.D[i]));
      move(i, 0.5 * sigma * w * coast);
    }
    r_.events[i] += 1;
    finish(i, last * c.table->step_s + coast);
  }

  void move(int i, double moved) {
    r_.u[i] += moved;
    r_.path[i] += magnitude(moved);
    r_.peak[i] = larger(r_.peak[i], magnitude(r_.u[i]));
  }

  void finish_at_rest(int i) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const MotionTable& t = *c.table;
    Response& out = responses_[number(lane)];
    finish(i, (t.knots - 1) * t.step_s);
    if (r_.hardest[i] >= r_.gs[i]) return;
    const double most = larger(magnitude(r_.a[i]), peak_from(t, lane.at + 1));
    out.peak_acceleration_mps2 = larger(out.peak_acceleration_mps2, most * magnitude(c.scale));
  }

  void finish(int i, double time) {
    Lane& lane = lanes_[i];
    const double scale = lane.sample->scale, size = magnitude(scale);
    Response& out = responses_[number(lane)];
    out = Response{};
    out.outcome = r_.events[i] > 0 ? Outcome::moved : Outcome::at_rest;
    out.peak_slip_m = r_.peak[i] * size;
    out.residual_slip_m = r_.u[i] * scale;
    out.slid_path_m = r_.path[i] * size;
    out.peak_acceleration_mps2 = r_.hardest[i] * size;
    out.events = static_cast<int>(r_.events[i]);
    out.end_time_s = time;
    lane.sample = nullptr;
    busy_ &= ~(1U << i);
  }

  std::size_t number(const Lane& lane) const { return static_cast<std::size_t>(lane.sample - cases_); }

  const BatchCase* cases_;
  std::size_t count_;
  Response* responses_;
  std::uint8_t* declined_;
  std::size_t taken_ = 0;
  unsigned busy_ = 0;    // bit i: slot i has a sample
  unsigned vacant_ = 0;  // bit i: slot i's sample has ended within the round
  SlideRows r_;
  Lane lanes_[slide_slots];
};

inline void slide_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  SlidePool(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
