// Searches along a record that only slide-rock asks for.
#pragma once

#include <algorithm>

#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

// max |a_j|, j = from ... to - 1.
inline double peak_between(const MotionTable& t, int from, int to) {
  double most = 0;
  int j = from;
  const auto step_to = [&](int end) {
    for (; j < end; ++j) most = larger(most, magnitude(t.acceleration[static_cast<std::size_t>(j)]));
  };
  const int first = (from + table_run - 1) / table_run, last = to / table_run;
  if (first >= last) {
    step_to(to);
    return most;
  }
  step_to(first * table_run);
  Pack peaks(0.0);
  int run = first;
  for (; run + pack_lanes <= last; run += pack_lanes) peaks = xsimd::max(peaks, load_any(t.run_peak.data() + run));
  for (; run < last; ++run) most = larger(most, t.run_peak[static_cast<std::size_t>(run)]);
  for (int l = 0; l < pack_lanes; ++l) most = larger(most, peaks.get(static_cast<std::size_t>(l)));
  j = last * table_run;
  step_to(to);
  return most;
}

// max (scale a_j)^2 + (lift v_j)^2, j = from ... to - 1, if it is above `seen`.
inline double peak_of_both(const MotionTable& t, int from, int to, double scale, double lift, double seen) {
  if (from >= to) return seen;
  const auto run = static_cast<std::size_t>(from / table_run);
  const double bound_a = scale * t.later_peak[run], bound_v = lift * t.later_vertical_peak[run];
  if (bound_a * bound_a + bound_v * bound_v <= seen) return seen;
  const double *a = t.acceleration.data(), *v = t.vertical.data();
  const auto square = [](const auto& x, const auto& y) { return x * x + y * y; };
  Pack most(seen);
  int j = from;
  for (; j + pack_lanes <= to; j += pack_lanes)
    most = xsimd::max(most, square(Pack(scale) * load_any(a + j), Pack(lift) * load_any(v + j)));
  for (int l = 0; l < pack_lanes; ++l) seen = larger(seen, most.get(static_cast<std::size_t>(l)));
  for (; j < to; ++j) seen = larger(seen, square(scale * a[j], lift * v[j]));
  return seen;
}

// Of p[0 ... n]: the largest |p_j|, and the sum of |p_{j+1} - p_j|, in an order of its own; rows of table_run values may
// be read beyond the end.
struct Swing {
  double most, path;
};
inline Swing swing(const double* p, int n) {
  static_assert(table_run == 8);
  alignas(64) static constexpr double places[] = {0, 1, 2, 3, 4, 5, 6, 7};
  alignas(64) double most[table_run], path[table_run];
  for (int i = 0; i < table_run; i += pack_lanes) {
    const Pack zero(0.0), place = load(places + i);
    Pack high(magnitude(p[0])), sum(0.0);
    for (int j = 0; j < n; j += table_run) {
      const Pack here = load_any(p + i + j), next = load_any(p + i + j + 1);
      const PackMask within = place < Pack(static_cast<double>(n - j));
      high = xsimd::max(high, choose(within, xsimd::abs(next), zero));
      sum = sum + choose(within, xsimd::abs(next - here), zero);
    }
    store(most + i, high);
    store(path + i, sum);
  }
  const auto all = [](const double(&x)[table_run], auto&& both) {
    return both(both(both(x[0], x[4]), both(x[2], x[6])), both(both(x[1], x[5]), both(x[3], x[7])));
  };
  return {all(most, [](double x, double y) { return larger(x, y); }),
          all(path, [](double x, double y) { return x + y; })};
}

// First knot j >= from at which |scale a_j| may be above share (g + lift v_j); t.knots: none.
inline int first_loud(const MotionTable& t, int from, double scale, double lift, double share, double g) {
  const double *a = t.acceleration.data(), *v = t.vertical.data();
  const Pack unit(scale), lifts(share * lift), weight(share * g * (1 - 1e-12));
  int j = from / table_run * table_run;
  unsigned keep = 0xffU << (from - j);
  for (; j < t.knots; j += table_run, keep = 0xff) {
    unsigned found = 0;
    for (int i = 0; i < table_run; i += pack_lanes)
      found |= bits(xsimd::abs(unit * load_any(a + j + i)) >= weight + lifts * load_any(v + j + i)) << i;
    found &= keep;
    if (found) return std::min(j + __builtin_ctz(found), t.knots);
  }
  return t.knots;
}

// A block that slides in direction sigma (of the unit record) from knot m on with speed sigma w > 0, slowed by friction and slope:
// G = (mu_k g + sigma g_along) h a knot, which may be negative, all over the record's scale: the first knot j >= m at which its speed
//     sigma w_j = sigma (w + V_m - V_j) - G (j - m)
// is not above the margin of the table, so that it certainly slides on up to knot j - 1.
inline int first_doubt(const MotionTable& t, int m, double w, double sigma, double G) {
  const double *V = t.velocity.data(), *M = t.margin.data();
  const Pack way(sigma), start(sigma * (w + V[m])), slows(G);
  alignas(64) static constexpr double knots_on[] = {0, 1, 2, 3, 4, 5, 6, 7};
  int j = m / table_run * table_run;
  unsigned keep = 0xffU << (m - j);
  for (; j < t.knots; j += table_run, keep = 0xff) {
    unsigned found = 0;
    for (int i = 0; i < table_run; i += pack_lanes) {
      const Pack knots = load(knots_on + i) + Pack(static_cast<double>(j - m));
      found |= bits(start - way * load_any(V + j + i) - slows * knots <= load_any(M + j + i)) << i;
    }
    found &= keep;
    if (found) return j + __builtin_ctz(found);
  }
  return t.knots;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
