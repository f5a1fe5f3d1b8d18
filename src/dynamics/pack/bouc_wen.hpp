// Blocks of samples of model bouc_wen. The yields, which are what costs, march in packs: Taylor steps of order N from
// knot to knot, many samples side by side, each at its own time. What lies between two yields of a sample is done alone
// (bouc_wen_lane.hpp).
#pragma once

#include "dynamics/pack/bouc_wen_lane.hpp"
#include "dynamics/pack/power.hpp"
#include "dynamics/pack/twin.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int yield_order = 8;
constexpr double longest_power = 5;  // of n times the change of ln zeta in one step

class BoucWenPool {
 public:
  BoucWenPool(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined)
      : cases_(cases), count_(count), responses_(responses), declined_(declined) {}

  void run() {
    for (int i = 0; i < slots; ++i) clear(i);
    for (int i = 0; i < slots; ++i) refill(i);
    for (int live = 1; live;) {
      live = 0;
      for (int from = 0; from < slots; from += twin_lanes)
        if (busy_[from / twin_lanes]) {
          ++live;
          march(from);
        }
    }
  }

 private:
  static constexpr int N = yield_order;
  static constexpr int slots = 32;

  struct Rows {
    alignas(64) double zeta[slots], p[slots], slip[slots], q[slots], A[slots], slope[slots], fraction[slots];
    alignas(64) double W[slots], over_w[slots], n[slots], saturated[slots], tolerance[slots], live[slots];
  };
  struct Terms {
    alignas(64) double p[N + 1][twin_lanes], zeta[N + 1][twin_lanes], slip[N + 1][twin_lanes], tau[twin_lanes],
        A[twin_lanes], fraction[twin_lanes];
  };

  void march(int from) {
    const Twin zeta0 = load_twin(r_.zeta + from), p0 = load_twin(r_.p + from), A = load_twin(r_.A + from),
               slope = load_twin(r_.slope + from);
    const Twin W = load_twin(r_.W + from), n = load_twin(r_.n + from), fraction = load_twin(r_.fraction + from);
    Twin p[N + 1], zeta[N + 1], slip[N + 1], q[N], d[N + 1], nd[N + 1], e[N];  // d_k = k zeta_k, e_k = k q_k
    p[0] = p0;
    zeta[0] = zeta0;
    slip[0] = load_twin(r_.slip + from);
    q[0] = load_twin(r_.q + from);
    const Twin over_zeta = Twin(1.0) / zeta0, n_q0 = n * q[0];
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) {
      const Twin over(1.0 / (k + 1));
      Twin plastic = p[0] * q[k];
      if (k > 0) {
        Twin earlier = p[k] * q[0];
#pragma GCC unroll 16
        for (int j = 1; j < k; ++j) earlier = earlier + p[k - j] * q[j];
        plastic = earlier + plastic;
      }
      d[k + 1] = p[k] - plastic;
      slip[k + 1] = plastic * over;
      zeta[k + 1] = d[k + 1] * over;
      Twin push = W * zeta[k];
      if (k == 0) push = push + A;
      if (k == 1) push = push + slope;
      p[k + 1] = push * Twin(-1.0 / (k + 1));
      if (k + 1 < N) {
        nd[k + 1] = n * d[k + 1];
        Twin sum = n_q0 * d[k + 1];
        if (k > 0) {
          Twin earlier = nd[k] * q[1] - e[1] * zeta[k];
#pragma GCC unroll 16
          for (int j = 2; j <= k; ++j) earlier = earlier + (nd[k + 1 - j] * q[j] - e[j] * zeta[k + 1 - j]);
          sum = earlier + sum;
        }
        e[k + 1] = sum * over_zeta;
        q[k + 1] = e[k + 1] * over;
      }
    }

    // The largest part of the interval over which the last terms are within the tolerance, and the terms that follow are
    // less: those of q, at worst, are those of exp(n ln zeta).
    const Twin last = max(abs(zeta[N]), abs(p[N]) * load_twin(r_.over_w + from));
    const Twin fastest = p0 + Twin(0.5) * abs(p[1]) * fraction;
    const Twin longest = min(fraction, Twin(longest_power) * zeta0 / (n * fastest));
    const Twin tau = min(longest, eighth_root(load_twin(r_.tolerance + from) / last));

    Twin p1 = p[N], zeta1 = zeta[N], slip1 = slip[N];
#pragma GCC unroll 16
    for (int k = N - 1; k >= 0; --k) {
      p1 = p1 * tau + p[k];
      zeta1 = zeta1 * tau + zeta[k];
      slip1 = slip1 * tau + slip[k];
    }
    const Twin q1 = power_of(zeta1, n);
    const Twin margin = tau * tau * (Twin(0.125) * abs(slope) + Twin(0.1875) * W * max(p0, p1));
    const unsigned live = bits(load_twin(r_.live + from) > Twin(0.5));
    const unsigned full = bits(load_twin(r_.saturated + from) >= Twin(1.0) - q1) & live;
    const unsigned at_knot = bits(tau >= fraction) & live;
    const unsigned slow = ~bits(min(p0, p1) > margin) & live;
    store(r_.zeta + from, zeta1);
    store(r_.p + from, p1);
    store(r_.slip + from, slip1);
    store(r_.q + from, q1);
    store(r_.A + from, A + slope * tau);
    store(r_.fraction + from, fraction - tau);
    unsigned stopped = 0;
    if (slow) {
      Terms terms;
#pragma GCC unroll 16
      for (int k = 0; k <= N; ++k) {
        store(terms.p[k], p[k]);
        store(terms.zeta[k], zeta[k]);
        store(terms.slip[k], slip[k]);
      }
      store(terms.tau, tau);
      store(terms.A, A);
      store(terms.fraction, fraction);
      for (unsigned rest = slow; rest; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        if (look_for_stop(from, lane, terms)) stopped |= 1U << lane;
      }
    }
    for (unsigned rest = at_knot & ~stopped; rest; rest &= rest - 1) next_interval(from + __builtin_ctz(rest));
    for (unsigned rest = full & ~stopped; rest; rest &= rest - 1) {
      const int i = from + __builtin_ctz(rest);
      take_over(i);
      settle(i, lanes_[i].saturate());
    }
  }

  // True: it stopped, and has gone on to where it yields next, or made place for another sample.
  bool look_for_stop(int from, int lane, const Terms& terms) {
    const int i = from + lane;
    double p[N + 1], zeta[N + 1], slip[N + 1];
    for (int k = 0; k <= N; ++k) {
      p[k] = terms.p[k][lane];
      zeta[k] = terms.zeta[k][lane];
      slip[k] = terms.slip[k][lane];
    }
    BoucWenLane& one = lanes_[i];
    one.A = terms.A[lane];
    one.fraction = terms.fraction[lane];
    BoucWenLane::Next next;
    if (!one.stops<N>(p, zeta, slip, terms.tau[lane], next)) return false;
    settle(i, next);
    return true;
  }

  void next_interval(int i) {
    BoucWenLane& lane = lanes_[i];
    lane.next_interval();
    r_.A[i] = lane.A;
    r_.slope[i] = lane.slope;
    r_.fraction[i] = 1;
  }

  // The lane's own copy of what the rows hold.
  void take_over(int i) {
    BoucWenLane& lane = lanes_[i];
    lane.zeta = r_.zeta[i];
    lane.p = r_.p[i];
    lane.slip = r_.slip[i];
    lane.A = r_.A[i];
    lane.fraction = r_.fraction[i];
  }

  void settle(int i, BoucWenLane::Next next) {
    if (next == BoucWenLane::Next::yields) return enter(i);
    const std::size_t sample = number_[i];
    declined_[sample] = next == BoucWenLane::Next::declined;
    if (next == BoucWenLane::Next::done) responses_[sample] = lanes_[i].result;
    leave(i);
    refill(i);
  }

  void refill(int i) {
    while (taken_ < count_) {
      const std::size_t sample = taken_++;
      const auto next = lanes_[i].begin(cases_[sample]);
      number_[i] = sample;
      if (next == BoucWenLane::Next::yields) {
        ++busy_[i / twin_lanes];
        r_.live[i] = 1;
        r_.n[i] = lanes_[i].n;
        r_.W[i] = lanes_[i].W;
        r_.over_w[i] = lanes_[i].over_w;
        r_.saturated[i] = cases_[sample].contact.saturated;
        r_.tolerance[i] = cases_[sample].tolerance;
        return enter(i);
      }
      declined_[sample] = next == BoucWenLane::Next::declined;
      if (next == BoucWenLane::Next::done) responses_[sample] = lanes_[i].result;
    }
    take_last(i);
  }

  // No more samples: lanes of the last slots fill the gaps before them, so that few packs are left to march.
  void take_last(int i) {
    int last = slots - 1;
    while (last > i && r_.live[last] == 0) --last;
    if (last / twin_lanes == i / twin_lanes) return;
    for (double* row : {r_.zeta, r_.p, r_.slip, r_.q, r_.A, r_.slope, r_.fraction, r_.W, r_.over_w, r_.n, r_.saturated,
                        r_.tolerance, r_.live})
      row[i] = row[last];
    lanes_[i] = lanes_[last];
    number_[i] = number_[last];
    ++busy_[i / twin_lanes];
    leave(last);
  }

  void enter(int i) {
    const BoucWenLane& lane = lanes_[i];
    r_.zeta[i] = lane.zeta;
    r_.p[i] = lane.p;
    r_.slip[i] = lane.slip;
    r_.A[i] = lane.A;
    r_.slope[i] = lane.slope;
    r_.fraction[i] = lane.fraction;
    r_.q[i] = power_of_one(lane.zeta, lane.n);
  }

  void leave(int i) {
    --busy_[i / twin_lanes];
    clear(i);
  }

  void clear(int i) {
    r_.zeta[i] = r_.q[i] = 0.5;
    r_.p[i] = r_.n[i] = r_.fraction[i] = r_.over_w[i] = r_.tolerance[i] = 1;
    r_.slip[i] = r_.A[i] = r_.slope[i] = r_.W[i] = r_.saturated[i] = r_.live[i] = 0;
  }

  const BatchCase* cases_;
  std::size_t count_, taken_ = 0;
  Response* responses_;
  std::uint8_t* declined_;
  Rows r_;
  BoucWenLane lanes_[slots];
  std::size_t number_[slots] = {};
  int busy_[slots / twin_lanes] = {};
};

inline void bouc_wen_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  BoucWenPool(cases, count, responses, declined).run();
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
