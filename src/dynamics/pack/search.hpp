// Searches along the rows of a record's table, several knots at a time.
#pragma once

#include "base/motion_table.hpp"
#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

inline double larger(double a, double b) { return a < b ? b : a; }
inline double magnitude(double x) { return x < 0 ? -x : x; }

// Largest of p[0 ... n - 1], n >= 8.
inline double largest(const double* p, int n) {
  Pack most = load_any(p + n - pack_lanes);
  for (int i = 0; i + pack_lanes < n; i += pack_lanes) most = xsimd::max(most, load_any(p + i));
  alignas(64) double values[pack_lanes];
  store(values, most);
  double all = values[0];
  for (int i = 1; i < pack_lanes; ++i) all = larger(all, values[i]);
  return all;
}

// Bit i: |p[i]| > limit, i = 0 ... 7.
inline unsigned greater_8(const double* p, const Pack& limit) {
  unsigned found = 0;
  for (int i = 0; i < table_run; i += pack_lanes) found |= bits(xsimd::abs(load_any(p + i)) > limit) << i;
  return found;
}

// First knot j >= from with |a_j| > limit; t.knots: none.
inline int first_above(const MotionTable& t, int from, double limit) {
  if (from >= t.knots) return t.knots;
  const Pack bound(limit);
  const double *a = t.acceleration.data(), *peaks = t.run_peak.data();
  int run = from / table_run;
  unsigned found = greater_8(a + run * table_run, bound) >> (from % table_run) << (from % table_run);
  if (!found) {
    if (t.later_peak[static_cast<std::size_t>(run) + 1] <= limit) return t.knots;
    unsigned any = 0;
    for (++run; !(any = greater_8(peaks + run, bound)); run += table_run) {
    }
    run += __builtin_ctz(any);
    found = greater_8(a + run * table_run, bound);
  }
  return run * table_run + __builtin_ctz(found);
}

// max |a_j| over all j >= from.
inline double peak_from(const MotionTable& t, int from) {
  const int run = (from + table_run - 1) / table_run;
  double most = t.later_peak[static_cast<std::size_t>(run)];
  for (int j = from; j < run * table_run; ++j)
    most = larger(most, magnitude(t.acceleration[static_cast<std::size_t>(j)]));
  return most;
}

// max |a_j|, j = from ... to - 1, by whole runs (an upper bound).
inline double bound_between(const MotionTable& t, int from, int to) {
  double most = 0;
  for (int run = from / table_run; run * table_run < to; ++run)
    most = larger(most, t.run_peak[static_cast<std::size_t>(run)]);
  return most;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
