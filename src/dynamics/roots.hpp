// Where a polynomial that starts out positive first falls to zero.
//
// An event is a witness (a series that is >= 0 while the mode lasts) and its first root. Two ideas make the search safe:
//  * a root at the very start is not nudged away from but divided out: with c[0] = 0, witness(tau)/tau has the same
//    later roots and a sign at 0;
//  * Descartes' rule counts the roots within an interval, or too many of them: it is halved until there is one or none.
//    Double crossings inside a step cannot be missed.
#pragma once

#include "dynamics/series.hpp"

namespace freestand::dynamics {

// How zero is told from round-off in the leading coefficients of a witness. Coefficients below `level` are set by
// resets and exact; from `level` on they are accelerations (times `size`) and their rates, known to about
// `acceleration`.
struct ZeroTolerance {
  int level;            // 0: force, 1: velocity, 2: displacement
  double acceleration;  // [unit of the witness / s^level]
};

// Largest order for which the root search is compiled.
inline constexpr int max_root_order = 10;

namespace detail {
int sign_after(const double* c, int order, ZeroTolerance zero);
bool first_root(const double* c, int order, double h, ZeroTolerance zero, double& tau);
double max_abs(const double* c, int order, double h, double floor);
int turns(const double* c, int order, double h, double* values);
double max_of(const double* c, int order, double h, double floor);
}  // namespace detail

// Sign of the series just after its start: +1, -1, or 0 when all coefficients vanish within the tolerance.
template <int N>
int sign_after(const Series<double, N>& y, ZeroTolerance zero) {
  return detail::sign_after(y.c, N, zero);
}

// First tau in [0, h] at which y falls below zero; false: none. tau = 0 when y is negative just after the start.
template <int N>
bool first_root(const Series<double, N>& y, double h, ZeroTolerance zero, double& tau) {
  static_assert(N <= max_root_order);
  if (surely_positive(y, h)) return false;
  if constexpr (N > 1)
    if (zero.level > 0 && surely_rises_from_zero(y, h, zero.level == 1 ? zero.acceleration : 0.0)) return false;
  return detail::first_root(y.c, N, h, zero, tau);
}

// Beyond doubt y rises or falls on all of [0, h], or stays the same: then its extremes are at the ends.
template <int N>
bool extremes_at_ends(const Series<double, N>& y, double h) {
  if constexpr (N < 2)
    return true;
  else
    return surely_monotonic(y, h) || surely_monotonic_by_ends(y, derivative(y).at(h), h);
}

// max(floor, max over [0, h] of |y|).
template <int N>
double max_abs(const Series<double, N>& y, double h, double floor) {
  static_assert(N <= max_root_order);
  if (surely_within(y, h, floor)) return floor;
  const double last = y.at(h);
  if (surely_within_by_ends(y, last, h, floor)) return floor;
  if (extremes_at_ends(y, h)) return std::fmax(floor, std::fmax(std::abs(y[0]), std::abs(last)));
  return detail::max_abs(y.c, N, h, floor);
}

// Calls see(y) at each point within (0, h) where y is stationary, in their order.
template <int N, class See>
void for_each_turn(const Series<double, N>& y, double h, const See& see) {
  static_assert(0 < N && N <= max_root_order);
  if (surely_monotonic(y, h)) return;
  double values[N];
  const int found = detail::turns(y.c, N, h, values);
  for (int i = 0; i < found; ++i) see(values[i]);
}

// max(floor, max over [0, h] of y).
template <int N>
double max_of(const Series<double, N>& y, double h, double floor) {
  static_assert(N <= max_root_order);
  if (surely_within(y, h, floor)) return floor;
  const double last = y.at(h);
  if (surely_within_by_ends(y, last, h, floor)) return floor;
  if (extremes_at_ends(y, h)) return std::fmax(floor, std::fmax(y[0], last));
  return detail::max_of(y.c, N, h, floor);
}

}  // namespace freestand::dynamics
