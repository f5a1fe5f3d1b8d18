// Roots of short polynomials on [0, 1], for single lanes.
#pragma once

#include <cmath>

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <int M>
double evaluate(const double* c, double x) {
  double value = c[M];
#pragma GCC unroll 16
  for (int k = M - 1; k >= 0; --k) value = value * x + c[k];
  return value;
}

// Newton's method in a bracket: f(lo) > 0 >= f(hi), f = sum_k c[k] x^k. Where it does not find the root in so many steps,
// the bracket is halved until nothing is left of it.
template <int M>
double newton_in(const double* c, double lo, double hi, double x) {
  if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
  for (int round = 0; round < 60; ++round) {
    double value = c[M], slope = 0;
#pragma GCC unroll 16
    for (int k = M - 1; k >= 0; --k) {
      slope = slope * x + value;
      value = value * x + c[k];
    }
    (value > 0 ? lo : hi) = x;
    double next = x - value / slope;
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    const double step = next - x;
    x = next;
    if (step < 1e-10 && step > -1e-10) return x;  // the step after this one is within round-off
  }
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (lo + hi);
    (evaluate<M>(c, middle) > 0 ? lo : hi) = middle;
  }
  return hi;
}

// Where f changes its sign on (0, end], given that f(0) and f(end) differ in sign.
template <int M>
double sign_change(const double* c, double end) {
  double p[M + 1];
  const double sign = c[0] > 0 ? 1 : -1;
  for (int k = 0; k <= M; ++k) p[k] = sign * c[k];
  const double at_end = evaluate<M>(p, end);
  return newton_in<M>(p, 0, end, end * p[0] / (p[0] - at_end));
}

// First x in (0, end] at which f, positive just after 0, falls to zero; 2: none. A zero at the start is divided out; f
// that starts out negative falls at 0.
template <int M>
double first_fall(const double* c, double end, int depth = 0) {
  if constexpr (M == 0) {
    return c[0] < 0 ? 0 : 2;
  } else {
    if (c[0] == 0) return first_fall<M - 1>(c + 1, end, depth);
    if (c[0] < 0) return 0;
    double bound = 0;
    for (int k = M; k >= 1; --k) bound = (bound + (c[k] < 0 ? -c[k] : c[k])) * end;
    if (c[0] > bound) return 2;
    double slope[M];
    for (int k = 0; k < M; ++k) slope[k] = (k + 1) * c[k + 1];
    const double at_end = evaluate<M>(c, end), slope_end = evaluate<M - 1>(slope, end);
    double hi = end;
    if constexpr (M >= 3) {  // f may turn twice: the half with one turn each
      double curve[M - 1];
      for (int k = 0; k + 1 < M; ++k) curve[k] = (k + 1) * slope[k + 1];
      const double curve_end = evaluate<M - 2>(curve, end);
      const double change = curve[0] * end;  // twice what the slope can change before its rate turns, and more
      if (depth < 3 && slope[0] * slope_end >= 0 && curve[0] * curve_end < 0 &&
          slope[0] * slope[0] <= change * change) {
        const double middle = sign_change<M - 2>(curve, end), first = first_fall<M>(c, middle, 3);
        if (first <= middle) return first;
        double p[M + 1];
        for (int k = 0; k <= M; ++k) p[k] = c[k];
        for (int i = 0; i < M; ++i)
          for (int k = M - 1; k >= i; --k) p[k] += middle * p[k + 1];
        const double second = first_fall<M>(p, end - middle, 3);
        return second <= end - middle ? middle + second : 2;
      }
    }
    if (at_end > 0) {  // can it dip in between?
      if (!(slope[0] < 0) || !(slope_end > 0)) return 2;
      double p[M];
      for (int k = 0; k < M; ++k) p[k] = -slope[k];
      hi = newton_in<M - 1>(p, 0, end, 0.5 * end);
      if (evaluate<M>(c, hi) > 0) return 2;
    }
    const double f_hi = hi == end ? at_end : evaluate<M>(c, hi);
    const double half_curvature = f_hi - c[0] - slope[0] * hi;  // of the parabola through both ends, in x/hi
    const double rate = slope[0] * hi, square = rate * rate - 4 * half_curvature * c[0];
    const double root = std::sqrt(square > 0 ? square : 0.0);
    const double guess = hi * (rate > 0 ? (rate + root) / (-2 * half_curvature) : 2 * c[0] / (root - rate));
    return newton_in<M>(c, 0, hi, guess);
  }
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
