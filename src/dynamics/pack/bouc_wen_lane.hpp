// One sample on a Bouc-Wen contact under a piecewise linear record, between its yields: what is cheap enough to be done
// alone. Elastic swings go by the exact propagator of a whole interval, sliding by quadratics.
//
// Dimensionless: time in intervals (the steps of the record, cut into `parts` where the contact rings fast), lengths in
// y. Everything is told in the direction of the motion: p = zeta' + slip' >= 0, and a push A + slope tau that opposes it:
//   elastic   zeta'' = -(A + slope tau) - W zeta,  W = w^2 = G/y per interval squared
//   yielding  p' = -(A + slope tau) - W zeta,  zeta' = p (1 - q),  slip' = p q
//   sliding   p' = -(A + slope tau) - W,  slip' = p
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/bouc_wen_ring.hpp"
#include "dynamics/pack/bouc_wen_stop.hpp"
#include "dynamics/pack/power.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr double longest_part = 0.5;  // of an interval, times w
constexpr double short_part = 0.2;    // for which series of order 8 are as good as round-off

class BoucWenLane {
 public:
  enum class Next { yields, done, declined, turned };  // turned: only within

  Next begin(const BatchCase& sample) {
    sample_ = &sample;
    const MotionTable& t = *sample.table;
    const BoucWenContact& contact = sample.contact;
    const double rate = std::sqrt(contact.strength * sample.g / contact.yield) * t.step_s;
    parts_ = 1 + static_cast<int>(rate / longest_part);
    const double w = rate / parts_, step = t.step_s / parts_;
    W = w * w;
    n = contact.n;
    over_w = 1 / w;
    size_ = sample.scale * step * step / contact.yield;
    elastic_.set(W);
    limit_ = contact.linear;
    knots_ = t.knots - 1;
    knot_ = part_ = 0;
    events_ = 0;
    turns_ = 0;
    slip_ = path_ = peak_ = peak_zeta_ = 0;
    slides_ = false;
    zeta = p = slip = 0;
    dir_ = 1;
    load_interval();
    while (A == 0 && slope == 0) {
      if (knot_ >= knots_) return finish(), Next::done;
      next_interval();
    }
    if (A > 0 || (A == 0 && slope > 0)) mirror();
    return on_from(Next::turned);
  }

  // The state, in the direction of the motion. `fraction` of the interval lies ahead; `slip` is u_p of the present motion.
  double zeta, p, slip, A, slope, fraction;
  double W, n, over_w;

  // The interval is over.
  void next_interval() {
    if (++part_ == parts_) {
      part_ = 0;
      ++knot_;
      load_interval();
    } else {
      A = first_ + part_ * slope;
      fraction = 1;
    }
  }

  // From a yield: zeta has come to 1.
  Next saturate() {
    slip += zeta - 1;
    zeta = 1;
    return on_from(slide());
  }

  // From a yield: p may reach zero within tau of this interval. The series are those of p, zeta and slip. False: it does
  // not.
  template <int N>
  bool stops(const double* p_series, const double* zeta_series, const double* slip_series, double tau, Next& next) {
    double stop = quick_stop<N>(p_series, zeta_series, A, slope, W, tau);
    if (stop < 0) stop = first_stop<N>(p_series, tau);
    if (stop < 0) return false;
    zeta = polynomial<N>(zeta_series, stop);
    slip = polynomial<N>(slip_series, stop);
    next = on_from(turn(stop));
    return true;
  }

  Response result;

 private:
  // Advances zeta and p over a whole interval.
  struct Propagator {
    double cosine, sine, slow, slower, fast;  // cos w, sin w/w, (1 - cos w)/W, (1 - sin w/w)/W, w sin w
    void set(double W) {
      // Taylor series in W <= 1/4.
      cosine = sine = slow = slower = 0;
      for (int k = 9; k >= 0; --k) {
        const double even = (2.0 * k + 1) * (2 * k + 2), odd = (2.0 * k + 2) * (2 * k + 3);
        cosine = 1 - cosine * W / even;
        sine = 1 - sine * W / odd;
        slow = 1 - slow * W / ((2.0 * k + 3) * (2 * k + 4));
        slower = 1 - slower * W / ((2.0 * k + 4) * (2 * k + 5));
      }
      slow /= 2;
      slower /= 6;
      fast = W * sine;
    }
  };

  template <int N>
  struct Swing {
    double p[N + 1], zeta[N + 1];
  };
  template <int N>
  Swing<N> swing() const {
    Swing<N> s;
    s.p[0] = p;
    s.zeta[0] = zeta;
    const double minus_W = -W;
    s.zeta[1] = p;
    s.p[1] = balanced() ? 0.0 : minus_W * zeta - A;
    s.zeta[2] = 0.5 * s.p[1];
    s.p[2] = 0.5 * (minus_W * p - slope);
#pragma GCC unroll 16
    for (int k = 2; k < N; ++k) {
      const double over = 1.0 / (k + 1);
      s.p[k + 1] = (minus_W * over) * s.zeta[k];
      s.zeta[k + 1] = over * s.p[k];
    }
    return s;
  }

  void load_interval() {
    fraction = 1;
    if (knot_ >= knots_) {
      A = first_ = slope = 0;
      return;
    }
    const double* a = sample_->table->acceleration.data() + knot_;
    A = first_ = a[0] * size_ * dir_;
    slope = (a[1] * size_ * dir_ - A) / parts_;
  }

  void mirror() {
    dir_ = -dir_;
    zeta = -zeta;
    A = -A;
    first_ = -first_;
    slope = -slope;
  }

  // From turn to turn, as long as it does not yield.
  Next on_from(Next next) {
    while (next == Next::turned) {
      if (zeta > limit_)
        next = zeta < 1 ? Next::yields : slide();
      else
        next = W < short_part * short_part ? swing_on<8>() : swing_on<12>();
    }
    return next;
  }

  // Elastic, to the yield or the turn.
  template <int N>
  Next swing_on() {
    for (Next next;;) {
      if (fraction == 1 && pass_intervals()) return Next::declined;
      if (event<N>(next)) return next;
      if (knot_ > last_knot()) return Next::declined;
    }
  }

  // Whole intervals in which nothing happens. True: the sample's time is over.
  bool pass_intervals() {
    while (knot_ < knots_) {
      if (part_ == 0 ? !pass_record() : !pass_parts()) return false;
    }
    while (pass_parts())
      if (knot_ > last_knot()) return true;
    return false;
  }

  bool passes(double push, double rise, const Propagator& e, double& z, double& v) const {
    const double z1 = (e.cosine * z + e.sine * v) - (e.slow * push + e.slower * rise);
    const double v1 = (e.cosine * v - e.fast * z) - (e.sine * push + e.slow * rise);
    const double fastest = v > v1 ? v : v1;
    const double margin = 0.125 * (rise < 0 ? -rise : rise) + 0.1875 * W * fastest;
    if (!(v > margin && v1 > margin && z1 < limit_)) return false;
    z = z1;
    v = v1;
    return true;
  }

  // Intervals of the record, as long as there is one part to each; false: something happens in this one.
  bool pass_record() {
    if (parts_ > 1) return pass_parts();
    const double size = size_ * dir_;
    const Propagator e = elastic_;
    const double* a = sample_->table->acceleration.data();
    double z = zeta, v = p, before = A;
    int knot = knot_;
    for (; knot < knots_; ++knot) {
      const double after = a[knot + 1] * size;
      if (!passes(before, after - before, e, z, v)) break;
      before = after;
    }
    zeta = z;
    p = v;
    knot_ = knot;
    load_interval();
    return knot == knots_;
  }

  // The parts of the present interval of the record; false: something happens in one of them.
  bool pass_parts() {
    const Propagator e = elastic_;
    double z = zeta, v = p;
    int part = part_;
    for (; part < parts_; ++part)
      if (!passes(first_ + part * slope, slope, e, z, v)) break;
    zeta = z;
    p = v;
    part_ = part;
    if (part == parts_) {
      part_ = 0;
      ++knot_;
      load_interval();
      return true;
    }
    A = first_ + part * slope;
    return false;
  }

  // One interval, or what is left of it, by series. True: something happened in it.
  template <int N>
  bool event(Next& next) {
    const double limit = limit_;
    const Swing<N> s = swing<N>();
    const double p1 = polynomial<N>(s.p, fraction);
    const double fastest = p > p1 ? p : p1;
    const double margin = fraction * fraction * (0.125 * (slope < 0 ? -slope : slope) + 0.1875 * W * fastest);
    double stop = -1, end = fraction;
    if (!(p > margin && p1 > margin)) {
      if (p1 <= 0) stop = quick_stop<N>(s.p, s.zeta, A, slope, W, fraction);
      if (stop < 0) stop = first_stop<N>(s.p, fraction);
      if (stop >= 0) end = stop;
    }
    const double z1 = polynomial<N>(s.zeta, end);
    if (z1 > limit) {
      const double at = entrance(s, z1, end);
      p = polynomial<N>(s.p, at);
      zeta = polynomial<N>(s.zeta, at);
      go(at);
      next = Next::yields;
      return true;
    }
    zeta = z1;
    if (stop >= 0) {
      next = turn(stop);
      return true;
    }
    p = p1;
    next_interval();
    return false;
  }

  // An instant at which zeta, on its way up beyond the limit, is not far below it; exact it need not be.
  template <int N>
  double entrance(const Swing<N>& s, double z1, double end) const {
    const double limit = limit_, aim = 0.75 * limit;
    if (zeta >= 0.5 * limit) return 0;
    double low = 0, at_low = zeta, high = end, at_high = z1;
    for (int i = 0; i < 100; ++i) {
      double tau = low + (high - low) * (aim - at_low) / (at_high - at_low);
      if (i > 4) tau = 0.5 * (low + high);
      const double z = polynomial<N>(s.zeta, tau);
      if (z >= 0.5 * limit && z <= limit) return tau;
      (z < aim ? low : high) = tau;
      (z < aim ? at_low : at_high) = z;
    }
    return high;
  }

  void go(double tau) {
    A += slope * tau;
    fraction -= tau;
    if (fraction < 1e-13) next_interval();  // [s]: round-off of the interval's length; a push of 1e-12 m/s
  }

  // Sliding, to the turn.
  Next slide() {
    for (;;) {
      const double pull = A + W;
      const double p1 = p - fraction * (pull + 0.5 * fraction * slope);
      const double margin = 0.125 * fraction * fraction * (slope < 0 ? -slope : slope);
      if (p > margin && p1 > margin) {
        slip += fraction * (p - fraction * (0.5 * pull + fraction * slope * (1.0 / 6)));
        p = p1;
        next_interval();
        if (knot_ > last_knot()) return Next::declined;
        continue;
      }
      const double series[3] = {p, -pull, -0.5 * slope};
      const double stop = first_stop<2>(series, fraction);
      const double end = stop < 0 ? fraction : stop;
      slip += end * (p - end * (0.5 * pull + end * slope * (1.0 / 6)));
      if (stop >= 0) return turn(stop);
      p = p1;
      next_interval();
    }
  }

  // The motion stops at tau of what is left of the interval; zeta and slip are those of that instant.
  Next turn(double tau) {
    slip_ += dir_ * slip;
    path_ += slip;
    slip = 0;
    p = 0;
    const double u = slip_ + dir_ * zeta;
    peak_ = larger(peak_, u);
    peak_zeta_ = larger(peak_zeta_, zeta);
    if (zeta > sample_->contact.sliding) {
      events_ += 2;
      slides_ = true;
    }
    go(tau);
    if (knot_ >= knots_ && power_of_one(zeta < 0 ? -zeta : zeta, n) <= 0.75) return finish(), Next::done;
    if (++turns_ > most_turns) return Next::declined;
    // Under a push that rises from nothing the contact comes to stand again and again without turning.
    const double back = balanced() ? slope : A + W * zeta;
    if (back == 0) return Next::declined;
    if (back > 0) mirror();
    return Next::turned;
  }

  // Stands, and nothing but round-off accelerates it: 1e-12 of the forces that cancel, ten thousand times their last digit and a hundredth of
  // the single samples' force_zero.
  bool balanced() const {
    const double pull = W * zeta, sum = A + pull;
    return p == 0 && (sum < 0 ? -sum : sum) <= 1e-12 * ((A < 0 ? -A : A) + (pull < 0 ? -pull : pull));
  }

  static double larger(double most, double x) {
    x = x < 0 ? -x : x;
    return most < x ? x : most;
  }

  int last_knot() const {
    const double more = sample_->free_vibration_s / sample_->table->step_s;
    return knots_ + (more < 1e8 ? static_cast<int>(more) : 100000000);
  }

  void finish() {
    const double y = sample_->contact.yield;
    const RingOut out = zeta != 0 ? ring_out(sample_->contact, zeta < 0 ? -zeta : zeta) : RingOut{};
    const double towards = (zeta > 0) == (dir_ > 0) ? -1 : 1;
    peak_ = larger(larger(peak_, slip_ + towards * out.reach_m / y), slip_ - towards * out.second_reach_m / y);
    result = Response{};
    result.outcome = slides_ ? Outcome::moved : Outcome::at_rest;
    result.peak_slip_m = peak_ * y;
    result.residual_slip_m = slip_ * y + towards * out.slip_m;
    result.slid_path_m = path_ * y;
    result.peak_acceleration_mps2 = peak_zeta_ * sample_->contact.strength * sample_->g;
    result.events = events_;
    result.end_time_s = (knot_ + (part_ + 1 - fraction) / parts_) * sample_->table->step_s;
  }

  static constexpr long most_turns = 2000000;

  const BatchCase* sample_ = nullptr;
  Propagator elastic_{};
  double limit_ = 0;            // elastic up to this zeta
  double size_ = 0;             // of the unit record, dimensionless
  double first_ = 0;            // A at the start of the interval of the record
  int parts_ = 1, part_ = 0;    // of an interval of the record
  int knots_ = 0, knot_ = 0;    // intervals of the record; the present one
  double dir_ = 1;              // direction of the motion
  double slip_ = 0, path_ = 0;  // u_p and its path up to the last turn
  double peak_ = 0, peak_zeta_ = 0;
  int events_ = 0;
  long turns_ = 0;
  bool slides_ = false;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
