// Truncated Taylor series: the number that the physics is written in.
//
// A quantity over one step is y(tau) = sum_k c[k] tau^k, k = 0..N. The equations of motion give coefficient k + 1 of
// the state from coefficients 0..k, so one text of the physics yields the derivative (N = 1, first coefficient), the
// Taylor step, its dense output, and the polynomials in which events are found. Real is double, or a pack of doubles.
#pragma once

#include <cmath>

namespace freestand::dynamics {

template <class Real, int N>
struct Series {
  Real c[N + 1];

  Real& operator[](int k) { return c[k]; }
  const Real& operator[](int k) const { return c[k]; }

  static Series zero() {
    Series series;
    for (Real& coefficient : series.c) coefficient = Real(0.0);
    return series;
  }

  // y(tau), Horner.
  Real at(const Real& tau) const {
    Real value = c[N];
    for (int k = N - 1; k >= 0; --k) value = value * tau + c[k];
    return value;
  }
};

// Of a series that is known to order N - 1: it is zero to that order.
template <int N>
bool vanishes(const Series<double, N>& y) {
  for (int k = 0; k < N; ++k)
    if (y[k] != 0) return false;
  return true;
}

// Coefficient k of the product a b.
template <class Real, int N>
[[gnu::always_inline]] inline Real product(const Series<Real, N>& a, const Series<Real, N>& b, int k) {
  Real sum = a[0] * b[k];
#pragma GCC unroll 16
  for (int i = 1; i <= k; ++i) sum = sum + a[i] * b[k - i];
  return sum;
}

// The same of a polynomial b of that degree.
template <int degree, class Real, int N>
[[gnu::always_inline]] inline Real product(const Series<Real, N>& a, const Series<Real, N>& b, int k) {
  const int first = k > degree ? k - degree : 0;
  Real sum = a[first] * b[k - first];
#pragma GCC unroll 16
  for (int i = first + 1; i <= k; ++i) sum = sum + a[i] * b[k - i];
  return sum;
}

// dy/dtau; the last coefficient is zero.
template <class Real, int N>
Series<Real, N> derivative(const Series<Real, N>& y) {
  Series<Real, N> d;
  for (int k = 0; k < N; ++k) d[k] = Real(k + 1.0) * y[k + 1];
  d[N] = Real(0.0);
  return d;
}

// factor * y.
template <class Real, int N>
Series<Real, N> scaled(const Real& factor, const Series<Real, N>& y) {
  Series<Real, N> z;
  for (int k = 0; k <= N; ++k) z[k] = factor * y[k];
  return z;
}

// sum over k >= first of |c[k]| h^k.
template <int first, class Real, int N>
[[gnu::always_inline]] inline Real size_of_rest(const Series<Real, N>& y, const Real& h) {
  using std::abs;
  if constexpr (first > N) return Real(0.0);
  Real sum = abs(y[N]);
#pragma GCC unroll 16
  for (int k = N - 1; k >= first; --k) sum = sum * h + abs(y[k]);
#pragma GCC unroll 4
  for (int k = 0; k < first; ++k) sum = sum * h;
  return sum;
}

// y > 0 on all of [0, h] beyond doubt: its straight part outweighs the rest. For a pack, lane by lane.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_positive(const Series<Real, N>& y, const Real& h) {
  using std::abs;
  if constexpr (N == 0) {
    return y[0] > Real(0.0);
  } else {
    const Real rise = y[1] * h, lowest = y[0] + Real(0.5) * (rise - abs(rise));
    return lowest > size_of_rest<2>(y, h);
  }
}

// y[0] = 0 and y > 0 on all of (0, h] beyond doubt: y[1] is above `least`, >= 0.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_rises_from_zero(const Series<Real, N>& y, const Real& h, const Real& least) {
  Series<Real, N - 1> over_tau;
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) over_tau[k] = y[k + 1];
  return (y[0] == Real(0.0)) & (y[1] > least) & surely_positive(over_tau, h);
}

// y > 0 on (0, h] beyond doubt, by its shape: not negative at the start, and rising all the way; or, with an end that is more than what
// round-off makes of zero, falling all the way, or bent downwards all the way, over its chord.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_positive_by_shape(const Series<Real, N>& y, const Real& h) {
  using std::abs;
  Real least_slope(0.0), most_slope(0.0), most_bend(0.0), end(0.0), size(0.0);
#pragma GCC unroll 16
  for (int k = N; k >= 1; --k) {
    const Real times(static_cast<double>(k)), here = y[k], bound = abs(here);
    least_slope = least_slope * h + times * (k > 1 ? -bound : here);
    most_slope = most_slope * h + times * (k > 1 ? bound : here);
    if (k > 1) most_bend = most_bend * h + times * Real(k - 1.0) * (k > 2 ? bound : here);
    end = end * h + here;
    size = size * h + bound;
  }
  end = y[0] + end * h;
  size = abs(y[0]) + size * h;
  const auto starts = (y[0] > Real(0.0)) | ((y[0] == Real(0.0)) & (y[1] > Real(0.0)));
  const auto is_above = end > Real(1e-12) * size, keeps = (most_slope < Real(0.0)) | (most_bend < Real(0.0));
  return starts & ((least_slope > Real(0.0)) | (is_above & keeps));
}

// |y| <= limit on all of [0, h] beyond doubt.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_within(const Series<Real, N>& y, const Real& h, const Real& limit) {
  return size_of_rest<0>(y, h) <= limit;
}

// The same by the ends: between them y leaves its chord by no more than h^2/8 times the largest |y''|. `last`: y(h). The bound is given
// away a little, so that no round-off in a search for the extremes comes above the limit.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_within_by_ends(const Series<Real, N>& y, const Real& last, const Real& h,
                                                         const Real& limit) {
  using std::abs;
  Series<Real, N> off_chord;
#pragma GCC unroll 16
  for (int k = 0; k <= N; ++k) off_chord[k] = Real(0.125 * k * (k - 1)) * y[k];
  const Real first_end = abs(y[0]), last_end = abs(last), beyond = size_of_rest<2>(off_chord, h);
  return (first_end + beyond < Real(1 - 1e-12) * limit) & (last_end + beyond < Real(1 - 1e-12) * limit);
}

// y rises, or falls, on all of [0, h] beyond doubt, or stays the same.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_monotonic(const Series<Real, N>& y, const Real& h) {
  using std::abs;
  Series<Real, N - 1> slope;
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) slope[k] = Real(k + 1.0) * y[k + 1];
  return abs(slope[0]) >= size_of_rest<1>(slope, h);
}

// The same by the ends of its slope, `slope_at_end` at h.
template <class Real, int N>
[[gnu::always_inline]] inline auto surely_monotonic_by_ends(const Series<Real, N>& y, const Real& slope_at_end,
                                                            const Real& h) {
  using std::abs;
  Series<Real, N - 1> off_chord;
#pragma GCC unroll 16
  for (int k = 0; k < N; ++k) off_chord[k] = Real(0.125 * k * (k - 1) * (k + 1)) * y[k + 1];
  const Real beyond = size_of_rest<2>(off_chord, h);
  return (y[1] * slope_at_end > Real(0.0)) & (abs(y[1]) > beyond) & (abs(slope_at_end) > beyond);
}

// factor_a * a + factor_b * b.
template <class Real, int N>
Series<Real, N> combination(const Real& factor_a, const Series<Real, N>& a, const Real& factor_b,
                            const Series<Real, N>& b) {
  Series<Real, N> z;
  for (int k = 0; k <= N; ++k) z[k] = factor_a * a[k] + factor_b * b[k];
  return z;
}

}  // namespace freestand::dynamics
