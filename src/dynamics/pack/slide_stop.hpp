// Where a slip under a piecewise linear record ends.
//
// In units of the scale, while the block slips in direction sigma from t_0 = (m + tau/h) h on, its speed at knot j is
//     sigma w_j = sigma (V(t_0) - V_j) - G (j - m - tau/h),   G = mu_k g h,   V = int a dt,
// and between knots a parabola, so that the slip ends where V crosses a line. The margin M_j of the table makes sure that
// no knot is passed after which, or before which, the parabola could dip to zero unseen.
#pragma once

#include <cmath>

#include "base/motion_table.hpp"
#include "base/pack.hpp"
#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct Slip {
  const MotionTable* table;
  int m;  // knot before the start
  double tau, V, sigma, gk;
  double G, next;  // next: speed at knot m + 1

  double speed_at(int j) const {
    const double time = (j - m) * table->step_s - tau;
    return sigma * (V - table->velocity[static_cast<std::size_t>(j)]) - gk * time;
  }
};

// First knot j >= from, m < from, at which sigma w_j <= margin, or may be by the rounding of the search; knots of the
// table: none. Many knots at a time, whether they are needed or not, so that the processor can go on to the next search
// meanwhile.
inline int first_stop(const Slip& s, int from) {
  constexpr double slack = 1e-6;
  const MotionTable& t = *s.table;
  const double size = s.sigma * s.V + s.gk * s.tau;
  const float A = static_cast<float>(size - slack * magnitude(size)), G = static_cast<float>(s.G * (1 + slack));
  const float* row = (s.sigma > 0 ? t.above : t.below).data();
  alignas(64) static constexpr float ramp[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  int j = from & ~15;
  std::uint64_t keep = ~std::uint64_t{0} << (from - j);
  for (; j < t.knots; j += table_search, keep = ~std::uint64_t{0}) {
    std::uint64_t found = 0;
    for (int i = 0; i < table_search; i += float_lanes) {
      const Floats at = Floats::load_aligned(ramp + i % 16) + Floats(static_cast<float>(j - s.m + i / 16 * 16));
      found |= bits(Floats(A) - Floats(G) * at <= Floats::load_aligned(row + j + i)) << i;
    }
    found &= keep;
    if (found) return j + __builtin_ctzll(found);
  }
  return t.knots;
}

// Does sigma w, from w > 0 at knot m to w_next at the next one, have a zero there? Then tau says when.
inline bool ends_in(const Slip& s, int m, double w, double w_next, double& tau) {
  const double h = s.table->step_s, *a = s.table->acceleration.data() + m;
  const double slope = (a[1] - a[0]) * s.table->rate_hz;
  const double rate = -s.sigma * a[0] - s.gk, half = -0.5 * s.sigma * slope;
  if (w_next > 0 && rate >= 0) return false;
  const double square = rate * rate - 4 * half * w;
  if (w_next > 0 && square < 0) return false;
  const double below = std::sqrt(square > 0 ? square : 0.0) - rate;
  tau = w > 0 ? 2 * w / below : 0.0;
  if (w_next > 0 && !(tau <= h)) return false;
  tau = tau < h ? tau : h;
  return true;
}

// The interval in which the slip ends, and when in it, for knots j on that may be alarms for nothing; -1: it outlasts the
// record.
inline int find_stop(const Slip& s, int j, double& tau) {
  const int last = s.table->knots - 1;
  for (;; j = first_stop(s, j + 1)) {
    if (j > last) return -1;
    const double w = j == s.m + 1 ? s.next : s.speed_at(j);
    if (j > s.m + 1 && ends_in(s, j - 1, j == s.m + 2 ? s.next : s.speed_at(j - 1), w, tau)) return j - 1;
    if (j < last && ends_in(s, j, w, s.speed_at(j + 1), tau)) return j;
  }
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
