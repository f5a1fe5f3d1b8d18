// The root of a polynomial that falls to zero once, beyond doubt. Numbers: of one sample, or of a pack, whose lanes go the way
// of single numbers, to the bit (OwnNumbers in tape.hpp, LaneNumbers in pack/lane_numbers.hpp). c: coefficients of 1, x ... x^N,
// x = 0 ... 1; zeros behind the last one change nothing.
#pragma once

#include <cmath>

namespace freestand::dynamics {

// Positive at 0, not so at 1, and either falling or bent downwards all the way.
template <int N, class Real>
[[gnu::always_inline]] inline auto falls_once(const Real* c) {
  using std::abs;
  Real falls(0.0), bends(0.0), end(0.0);
#pragma GCC unroll 16
  for (int k = N; k >= 1; --k) {
    const Real size = Real(static_cast<double>(k)) * (k > 1 ? abs(c[k]) : c[k]);
    falls = falls + size;
    if (k > 1) bends = bends + Real(k - 1.0) * (k > 2 ? size : Real(2.0) * c[k]);
  }
#pragma GCC unroll 16
  for (int k = N; k >= 0; --k) end = end + c[k];
  return (c[0] > Real(0.0)) & (end <= Real(0.0)) & ((falls < Real(0.0)) | (bends < Real(0.0)));
}

// The only root on (0, 1] of polynomials with c(0) > 0 >= c(1), where `wanted`: Halley's method from the root of a parabola,
// kept inside the bracket by bisection.
template <int N, class Numbers, class Real, class Mask>
Real only_root(const Real* c, const Mask& wanted) {
  using std::abs;
  const auto choose = [](const auto& which, const Real& yes, const Real& no) {
    return Numbers::choose(which, yes, no);
  };
  const Real zero(0.0), half(0.5);
  Real lo(0.0), hi(1.0), end(0.0);
#pragma GCC unroll 16
  for (int k = N; k >= 0; --k) end = end + c[k];
  const Real rate = N > 0 ? c[1] : zero, bow = end - c[0] - rate, square = rate * rate - Real(4.0) * bow * c[0];
  const Real root = Numbers::sqrt(choose(square < zero, zero, square));
  Real x = choose(rate > zero, (rate + root) / (Real(-2.0) * bow), Real(2.0) * c[0] / (root - rate));
  x = choose((x > lo) & (x < hi), x, half);
  Mask sought = wanted;
  for (int i = 0; i < 100; ++i) {
    Real value = c[N], slope = zero, curve = zero;  // curve: half the second derivative
#pragma GCC unroll 16
    for (int k = N - 1; k >= 0; --k) {
      curve = curve * x + slope;
      slope = slope * x + value;
      value = value * x + c[k];
    }
    const auto before = value > zero;
    lo = choose(before, x, lo);
    hi = choose(before, hi, x);
    // Near a turning point that is no root, Halley's step leads to that point: there the bracket is halved.
    const Real steep = slope * slope, bent = value * curve;
    Real next = x - value * slope / (steep - bent);
    next = choose((next >= lo) & (next <= hi) & (steep > abs(bent)), next, half * (lo + hi));
    const Real step = abs(next - x);
    x = choose(sought, next, x);
    sought = sought & (step > Real(1e-8) * x);  // what is left is the third power of that
    if (!Numbers::any(sought)) return x;
  }
  return choose(sought, hi, x);
}

}  // namespace freestand::dynamics
