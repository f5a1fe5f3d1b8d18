// Pure sliding under a piecewise linear record is arithmetic, not integration. In units of the scale, while the block
// slips in direction sigma from t_0 on,
//     w(t) = C - V(t) - sigma mu_k g (t - t_0),   C = V(t_0) + w(t_0),   V = int a dt from the table,
// so that a slip ends where V(t) crosses a line: searched 8 knots at a time, one quadratic at the end. The displacement
// follows from D = int V dt; |u| has its peaks where w = 0 only. At rest the search is for |a| > mu_s g.
#pragma once

#include <cmath>

#include "base/pack.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct Slip {
  double C, x0, sigma, G;  // w_j = C - V_j - sigma G (j - x0)
};

// First knot j >= from at which sigma w_j <= margin; table's end: none.
inline int first_stop(const MotionTable& t, int from, const Slip& s) {
  const double *V = t.velocity.data(), *M = t.margin.data();
  const Pack sigma(s.sigma), A(s.sigma * s.C + s.G * s.x0), G(s.G);
  alignas(64) static constexpr double ramp[] = {0, 1, 2, 3, 4, 5, 6, 7};
  int j = from / table_run * table_run;
  unsigned keep = 0xffU << (from - j);
  for (; j < t.knots; j += table_run, keep = 0xff) {
    unsigned found = 0;
    for (int i = 0; i < table_run; i += pack_lanes) {
      const Pack at = load(ramp + i) + Pack(static_cast<double>(j));
      found |= bits((A - sigma * load_any(V + j + i)) - G * at <= load_any(M + j + i)) << i;
    }
    found &= keep;
    if (found) return j + __builtin_ctz(found);
  }
  return t.knots;
}

// A point inside interval m (between knots m and m + 1).
struct Instant {
  int m;
  double tau, a, V, D;
};

inline Instant instant(const MotionTable& t, int m, double tau) {
  const auto i = static_cast<std::size_t>(m);
  const double a = t.acceleration[i], slope = (t.acceleration[i + 1] - a) * t.rate_hz;
  return {m, tau, a + slope * tau, t.velocity[i] + tau * (a + 0.5 * slope * tau),
          t.displacement[i] + tau * (t.velocity[i] + tau * (0.5 * a + slope * tau * (1.0 / 6)))};
}

class Slide {
 public:
  Slide(const BatchCase& sample)
      : t_(*sample.table),
        scale_(sample.scale),
        gs_(sample.mu_s * sample.g / std::abs(sample.scale)),
        gk_(sample.mu_k * sample.g / std::abs(sample.scale)),
        last_(t_.knots - 1),
        free_vibration_s_(sample.free_vibration_s) {}

  // False: not covered.
  bool run(Response& out) {
    now_ = instant(t_, 0, 0.0);
    bool slips = std::abs(now_.a) > gs_;
    if (slips) begin_slip();
    for (;;) {
      if (slips) {
        if (!slip()) return finish_after_motion(out);
        slips = std::abs(now_.a) > gs_;
        ++events_;
        if (slips) begin_slip(), --events_;
      } else {
        const int j = first_above(t_, now_.m + 1, gs_);
        if (j >= t_.knots) return finish_at_rest(out);
        const auto i = static_cast<std::size_t>(j);
        const double before = t_.acceleration[i - 1], after = t_.acceleration[i];
        const double tau = (std::copysign(gs_, after) - before) * t_.step_s / (after - before);
        now_ = instant(t_, j - 1, tau);
        now_.a = std::copysign(gs_, after);
        broke_ = true;
        begin_slip();
        slips = true;
      }
    }
  }

 private:
  void begin_slip() {
    start_ = now_;
    sigma_ = now_.a > 0 ? -1.0 : 1.0;
    ++events_;
  }

  // To the end of the slip; false: it outlasts the record.
  bool slip() {
    const double h = t_.step_s;
    const auto first = static_cast<std::size_t>(start_.m);
    const double left = h - start_.tau, slope = (t_.acceleration[first + 1] - t_.acceleration[first]) * t_.rate_hz;
    const double rate = -sigma_ * start_.a - gk_, half = -0.5 * sigma_ * slope;
    const double next = left * (rate + half * left);  // sigma w at the first knot
    if (next < 0) {
      const double tau = start_.tau + (rate > 0 ? -rate / half : 0.0);
      now_ = instant(t_, start_.m, tau < h ? tau : h);
    } else if (!slip_past(next)) {
      return false;
    }
    end_slip();
    return true;
  }

  // The same for a slip that lives at the first knot after its start, with speed `next` there.
  bool slip_past(double next) {
    const double h = t_.step_s;
    const Slip s{start_.V, start_.m + start_.tau * t_.rate_hz, sigma_, gk_ * h};
    for (int j = start_.m + 1;; ++j) {
      j = first_stop(t_, j, s);
      if (j > last_) return false;
      const double w = j == start_.m + 1 ? next : speed_at(j);
      if (j > start_.m + 1 && ends_in(j - 1, j == start_.m + 2 ? next : speed_at(j - 1), w)) return true;
      if (j < last_ && ends_in(j, w, speed_at(j + 1))) return true;
    }
  }

  // Does sigma w, from w > 0 at knot m to w_next at the next one, have a zero there? Then now_ is set to it.
  bool ends_in(int m, double w, double w_next) {
    const double h = t_.step_s;
    const auto i = static_cast<std::size_t>(m);
    const double slope = (t_.acceleration[i + 1] - t_.acceleration[i]) * t_.rate_hz;
    const double rate = -sigma_ * t_.acceleration[i] - gk_, half = -0.5 * sigma_ * slope;
    if (w_next > 0 && rate >= 0) return false;
    const double square = rate * rate - 4 * half * w;
    if (w_next > 0 && square < 0) return false;
    const double below = std::sqrt(square > 0 ? square : 0.0) - rate;
    const double tau = w > 0 ? 2 * w / below : 0.0;
    if (w_next > 0 && !(tau <= h)) return false;
    now_ = instant(t_, m, tau < h ? tau : h);
    return true;
  }

  // sigma w at knot j.
  double speed_at(int j) const {
    const double time = (j - start_.m) * t_.step_s - start_.tau;
    return sigma_ * (start_.V - t_.velocity[static_cast<std::size_t>(j)]) - gk_ * time;
  }

  void end_slip() {
    const double time = (now_.m - start_.m) * t_.step_s + (now_.tau - start_.tau);
    const double moved = time * (start_.V - 0.5 * sigma_ * gk_ * time) - (now_.D - start_.D);
    u_ += moved;
    path_ += std::abs(moved);
    peak_ = larger(peak_, std::abs(u_));
  }

  bool finish_after_motion(Response& out) {
    const double w = speed_at(last_), time = w / gk_;
    if (!(time < free_vibration_s_)) return false;
    if (w > 0) {
      now_ = instant(t_, last_, 0.0);
      end_slip();
      const double moved = 0.5 * sigma_ * w * time;
      u_ += moved;
      path_ += std::abs(moved);
      peak_ = larger(peak_, std::abs(u_));
    }
    ++events_;
    fill(out, Outcome::moved);
    out.end_time_s = last_ * t_.step_s + time;
    return true;
  }

  bool finish_at_rest(Response& out) {
    fill(out, events_ > 0 ? Outcome::moved : Outcome::at_rest);
    out.end_time_s = last_ * t_.step_s;
    if (!broke_) {
      const double most = larger(std::abs(now_.a), peak_from(t_, now_.m + 1));
      out.peak_acceleration_mps2 = larger(out.peak_acceleration_mps2, most * std::abs(scale_));
    }
    return true;
  }

  void fill(Response& out, Outcome outcome) {
    const double size = std::abs(scale_);
    out = Response{};
    out.outcome = outcome;
    out.peak_slip_m = peak_ * size;
    out.residual_slip_m = u_ * scale_;
    out.slid_path_m = path_ * size;
    out.peak_acceleration_mps2 = (broke_ ? gs_ : events_ > 0 ? gk_ : 0.0) * size;
    out.events = events_;
  }

  const MotionTable& t_;
  double scale_, gs_, gk_;  // signed scale; friction limits in units of |scale|
  int last_;
  double free_vibration_s_;
  Instant now_{}, start_{};
  double sigma_ = 1, u_ = 0, path_ = 0, peak_ = 0;
  int events_ = 0;
  bool broke_ = false;  // a rest ended because the floor pushed hard enough
};

inline void slide_samples(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  for (std::size_t i = 0; i < count; ++i) {
    const BatchCase& c = cases[i];
    declined[i] = !(c.mu_k > 0) || c.scale == 0 || !Slide(c).run(responses[i]);
  }
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
