// Pure sliding in packs. Under a piecewise linear record it is arithmetic, not integration: at rest the search is for
// |a| > mu_s g, while slipping for the knot at which a line is crossed (dynamics/pack/slide_stop.hpp), with one quadratic
// at the end. The displacement follows from D = int int a; |u| has its peaks where the slip ends only.
//
// Every lane carries its own sample. One round takes each from rest to rest: the searches lane by lane, each with whole
// packs of knots, the arithmetic of the breaks and stops for all lanes at once. All in units of the scale.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/search.hpp"
#include "dynamics/pack/slide_stop.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int slide_slots = 16;
alignas(64) const double still_knot[2 * table_columns] = {};

struct SlideRows {
  alignas(64) double gs[slide_slots], gk[slide_slots];  // friction limits in units of |scale|
  alignas(64) double step[slide_slots], rate[slide_slots];
  // Where the lane is: tau after knot m, with the floor's acceleration and its integrals there.
  alignas(64) const double* knot[slide_slots];
  alignas(64) double m[slide_slots], tau[slide_slots], a[slide_slots], V[slide_slots], D[slide_slots];
  alignas(64) double pushed[slide_slots];  // 1: |a| > mu_s g here, so that a slip starts at once
  alignas(64) double sigma[slide_slots], G[slide_slots], next[slide_slots];  // the slip
  alignas(64) const double* stop[slide_slots];                               // and its end
  alignas(64) double stop_m[slide_slots], stop_tau[slide_slots];             // tau < 0: to be found
  alignas(64) double u[slide_slots], path[slide_slots], peak[slide_slots];
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
      r_.a[i] = r_.u[i] = r_.path[i] = r_.peak[i] = 0;
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
    int events = 0;
    bool broke = false;  // a rest ended because the floor pushed hard enough
    int at = 0;          // knot before
    bool rises = false;  // the speed still does at the first knot of the slip
  };

  // The next sample, at rest at the record's start.
  void take(int i) {
    Lane& lane = lanes_[i];
    lane.sample = nullptr;
    for (; taken_ < count_; ++taken_) {
      const BatchCase& c = cases_[taken_];
      const std::size_t number = taken_;
      declined_[number] = !(c.mu_k > 0) || c.scale == 0;
      if (declined_[number]) continue;
      const double size = magnitude(c.scale);
      lane = Lane{.sample = &c};
      r_.gs[i] = c.mu_s * c.g / size;
      r_.gk[i] = c.mu_k * c.g / size;
      r_.step[i] = c.table->step_s;
      r_.rate[i] = c.table->rate_hz;
      r_.m[i] = r_.tau[i] = r_.u[i] = r_.path[i] = r_.peak[i] = 0;
      r_.a[i] = c.table->acceleration[0];
      r_.knot[i] = c.table->columns.data();
      r_.pushed[i] = magnitude(r_.a[i]) > r_.gs[i];
      lane.events = r_.pushed[i] > 0;
      ++taken_;
      return;
    }
  }

  // Every lane to its next slip. False: no samples are left.
  bool leave_rest() {
    bool any = false;
    for (int i = 0; i < slide_slots; ++i) {
      Lane& lane = lanes_[i];
      while (lane.sample && !(r_.pushed[i] > 0)) {
        const MotionTable& t = *lane.sample->table;
        const int j = next_above(t, lane.at + 1, r_.gs[i]);
        if (j < t.knots) {
          r_.m[i] = lane.at = j - 1;
          r_.knot[i] = t.columns.data() + static_cast<std::size_t>(j - 1) * table_columns;
          lane.broke = true;
          ++lane.events;
          break;
        }
        finish_at_rest(i);
        take(i);
      }
      any = any || lane.sample;
    }
    return any;
  }

  // The start of the slips: when, and their lines.
  void set_out(int first) {
    const Pack one(1.0), zero(0.0), h = load(r_.step + first), rate_hz = load(r_.rate + first);
    const Pack gs = load(r_.gs + first), gk = load(r_.gk + first);
    const Within floor(r_.knot + first, rate_hz);
    const PackMask pushed = load(r_.pushed + first) > zero;
    const Pack a_next = fetch(r_.knot + first, table_columns), limit = choose(a_next < zero, zero - gs, gs);
    const Pack tau = choose(pushed, load(r_.tau + first), (limit - floor.a) * h / (a_next - floor.a));
    const Pack a = choose(pushed, load(r_.a + first), limit), V = floor.velocity(tau);
    const Pack sigma = choose(a > zero, zero - one, one), G = gk * h, left = h - tau;
    const Pack rate = zero - sigma * a - gk, half = Pack(-0.5) * sigma * floor.slope;
    const Pack next = left * (rate + half * left);
    const PackMask brief = next < zero;  // ends before the first knot
    Pack stop_tau = zero - one;
    if (bits(brief))
      stop_tau = choose(brief, xsimd::min(tau + choose(rate > zero, zero - rate / half, zero), h), stop_tau);
    const unsigned rises = bits(zero - sigma * a_next - gk >= zero);
    for (int l = 0; l < pack_lanes; ++l) lanes_[first + l].rises = rises >> l & 1U;
    store(r_.tau + first, tau);
    store(r_.V + first, V);
    store(r_.D + first, floor.displacement(tau));
    store(r_.sigma + first, sigma);
    store(r_.G + first, G);
    store(r_.next + first, next);
    store(r_.stop_tau + first, stop_tau);
  }

  Slip slip(int i) const {
    return {lanes_[i].sample->table, lanes_[i].at, r_.tau[i], r_.V[i], r_.sigma[i], r_.gk[i], r_.G[i], r_.next[i]};
  }

  // The knot around which the slip may end.
  void find_end(int i) {
    Lane& lane = lanes_[i];
    r_.stop[i] = r_.knot[i];
    r_.stop_m[i] = lane.at;
    if (!lane.sample || r_.stop_tau[i] >= 0) return;
    const MotionTable& t = *lane.sample->table;
    const int j = first_stop(slip(i), lane.at + (lane.rises ? 2 : 1));
    if (j >= t.knots - 1) return look_closer(i, j);  // the floor may jump at the last knot
    set_stop(i, j);
  }

  // A knot that may be an alarm for nothing.
  void look_closer(int i, int j) {
    double tau = 0;
    const int before = lanes_[i].sample ? find_stop(slip(i), j, tau) : -1;
    r_.stop_tau[i] = tau;
    if (before >= 0)
      set_stop(i, before);
    else if (lanes_[i].sample)
      finish_after_motion(i);
  }

  void set_stop(int i, int j) {
    r_.stop[i] = lanes_[i].sample->table->columns.data() + static_cast<std::size_t>(j) * table_columns;
    r_.stop_m[i] = j;
    __builtin_prefetch(r_.stop[i] - table_columns);
    __builtin_prefetch(r_.stop[i] + table_columns);
  }

  // The ends of the slips: in the interval before the knot that was found, or after it.
  void end(int first) {
    const Pack one(1.0), zero(0.0), two(2.0), h = load(r_.step + first), gk = load(r_.gk + first);
    const Pack start_m = load(r_.m + first), start = load(r_.tau + first), next = load(r_.next + first);
    const Pack sigma = load(r_.sigma + first), start_V = load(r_.V + first), found = load(r_.stop_tau + first);
    const auto speed = [&](const Pack& V, const Pack& intervals) {
      return choose(intervals == one, next, sigma * (start_V - V) - gk * (intervals * h - start));
    };
    const Pack knot = load(r_.stop_m + first) - start_m;
    const PackMask open = found < zero, past = open & (speed(fetch(r_.stop + first, 1), knot) <= zero);
    advance(r_.stop + first, bits(past), -table_columns);
    const Pack intervals = knot - choose(past, one, zero), m = start_m + intervals;
    const Within floor(r_.stop + first, load(r_.rate + first));
    const Pack w = speed(floor.V, intervals);
    const Pack w_next = speed(fetch(r_.stop + first, table_columns + 1), intervals + one);
    const Pack rate = zero - sigma * floor.a - gk, half = Pack(-0.5) * sigma * floor.slope;
    // A knot passed above zero while the speed rises again: it may have been lower before.
    const PackMask doubt = open & ((w_next > zero) | (knot == one) | ((rate > zero) & (intervals == knot)));
    if (bits(doubt)) {
      advance(r_.stop + first, bits(past), table_columns);
      for (unsigned lanes = bits(doubt); lanes; lanes &= lanes - 1) {
        const int i = first + __builtin_ctz(lanes);
        look_closer(i, static_cast<int>(r_.stop_m[i]));
      }
      return end(first);
    }
    const Pack square = xsimd::max(rate * rate - Pack(4.0) * half * w, zero);
    const Pack fall = choose(w > zero, two * w / (xsimd::sqrt(square) - rate), zero);
    const Pack tau = choose(open, xsimd::min(fall, h), found);
    const Pack time = intervals * h + (tau - start), a = floor.acceleration(tau);
    const Pack moved =
        time * (start_V - Pack(0.5) * sigma * gk * time) - (floor.displacement(tau) - load(r_.D + first));
    const Pack u = load(r_.u + first) + moved;
    store(r_.u + first, u);
    store(r_.path + first, load(r_.path + first) + xsimd::abs(moved));
    store(r_.peak + first, xsimd::max(load(r_.peak + first), xsimd::abs(u)));
    store(r_.m + first, m);
    store(r_.tau + first, tau);
    store(r_.a + first, a);
    store(r_.pushed + first, choose(xsimd::abs(a) > load(r_.gs + first), one, zero));
    for (int l = 0; l < pack_lanes; ++l) {
      const int i = first + l;
      lanes_[i].at = static_cast<int>(r_.m[i]);
      lanes_[i].events += lanes_[i].sample != nullptr;
      r_.knot[i] = r_.stop[i];
    }
  }

  // Friction alone brings the block to rest.
  void finish_after_motion(int i) {
    Lane& lane = lanes_[i];
    const Slip slip = this->slip(i);
    const BatchCase& c = *lane.sample;
    const int last = c.table->knots - 1;
    const double w = slip.speed_at(last), coast = w / slip.gk;
    vacant_ |= 1U << i;
    if (!(coast < c.free_vibration_s)) {
      declined_[number(lane)] = 1;
      lane.sample = nullptr;
      return;
    }
    if (w > 0) {
      const double time = (last - slip.m) * c.table->step_s - slip.tau;
      move(i, time * (slip.V - 0.5 * slip.sigma * slip.gk * time) -
                  (c.table->displacement[static_cast<std::size_t>(last)] - r_.D[i]));
      move(i, 0.5 * slip.sigma * w * coast);
    }
    ++lane.events;
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
    const bool broke = lane.broke;
    finish(i, (t.knots - 1) * t.step_s);
    if (broke) return;
    const double most = larger(magnitude(r_.a[i]), peak_from(t, lane.at + 1));
    out.peak_acceleration_mps2 = larger(out.peak_acceleration_mps2, most * magnitude(c.scale));
  }

  void finish(int i, double time) {
    Lane& lane = lanes_[i];
    const double scale = lane.sample->scale, size = magnitude(scale);
    Response& out = responses_[number(lane)];
    out = Response{};
    out.outcome = lane.events > 0 ? Outcome::moved : Outcome::at_rest;
    out.peak_slip_m = r_.peak[i] * size;
    out.residual_slip_m = r_.u[i] * scale;
    out.slid_path_m = r_.path[i] * size;
    out.peak_acceleration_mps2 = (lane.broke ? r_.gs[i] : lane.events > 0 ? r_.gk[i] : 0.0) * size;
    out.events = lane.events;
    out.end_time_s = time;
    lane.sample = nullptr;
  }

  std::size_t number(const Lane& lane) const { return static_cast<std::size_t>(lane.sample - cases_); }

  const BatchCase* cases_;
  std::size_t count_;
  Response* responses_;
  std::uint8_t* declined_;
  std::size_t taken_ = 0;
  unsigned vacant_ = 0;  // bit i: slot i's sample has ended within the round
  SlideRows r_;
  Lane lanes_[slide_slots];
};

inline void slide_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  SlidePool(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
