// Searches along the rows of a record's table, several knots at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

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

// The same for a sample that asks often: it notes once which runs of `level_run` knots may hold such a knot, a bit for
// each of 1024 of them.
class LoudRuns {
 public:
  void start(const MotionTable& table, double limit) {
    table_ = &table;
    level_ = Shorts(table.level(limit));
    runs_ = static_cast<unsigned>((table.knots + level_run - 1) / level_run);
    look(0);
  }

  // First knot j >= from that may have |a_j| > limit; a knot after the record: none. Sure but for one part in 32000 of
  // the record's peak.
  int next(unsigned from) {
    for (unsigned run = from / level_run; (run = next_run(run)) < runs_; run += knots_at_once / level_run) {
      const unsigned start = run * level_run, passed = from > start ? from - start : 0;
      const std::uint64_t found = not_below(table_->levels.data() + start) & ~std::uint64_t{0} << passed;
      if (found) return static_cast<int>(start) + __builtin_ctzll(found);
    }
    return table_->knots;
  }

 private:
  static constexpr unsigned window = 1024, knots_at_once = 32;

  unsigned next_run(unsigned run) {
    while (run < runs_) {
      if (run >= first_ + window) look(run);
      const unsigned bit = run - first_;
      std::uint64_t ahead;
      std::memcpy(&ahead, loud_ + bit / 8, sizeof ahead);
      ahead >>= bit % 8;
      if (ahead) return run + static_cast<unsigned>(__builtin_ctzll(ahead));
      run = first_ + std::min(bit / 8 * 8 + 64, window);
    }
    return run;
  }

  // Bit i: levels[i] is not below that of the limit.
  std::uint32_t not_below(const std::int16_t* levels) const {
    std::uint32_t found = 0;
    for (unsigned i = 0; i < knots_at_once; i += short_lanes)
      found |= static_cast<std::uint32_t>(bits_not_below(Shorts::load_unaligned(levels + i), level_)) << i;
    return found;
  }

  void look(unsigned run) {
    first_ = run;
    for (unsigned i = 0; i < window; i += knots_at_once) {
      const std::uint32_t found = first_ + i < runs_ ? not_below(table_->run_levels.data() + first_ + i) : 0;
      std::memcpy(loud_ + i / 8, &found, sizeof found);
    }
  }

  const MotionTable* table_ = nullptr;
  Shorts level_;
  unsigned runs_ = 0, first_ = 0;
  std::uint8_t loud_[window / 8 + 8] = {};
};

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
