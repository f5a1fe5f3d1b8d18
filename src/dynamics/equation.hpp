// The root of miss(x) near a guess: an equation for a force or a speed that a law follows while it sets it.
#pragma once

#include <cmath>
#include <limits>

namespace freestand::dynamics {

namespace detail {
// What is left further off than this, over the size of x, is not found: a tenth of what the default tolerance lets a step neglect.
inline constexpr double found = 1e-10;

// Between two ends, by regula falsi in Illinois' form. Where x is asked for that grows with itself, the answer may lie far above
// the guess. NaN: there is none.
template <class Miss>
double root_between(double guess, Miss&& miss) {
  double a = guess, at_a = miss(a), b = a + at_a, at_b = miss(b);
  for (int wider = 0; wider < 60 && b > 0 && at_a > 0 && at_b > 0; ++wider) {
    a = b, at_a = at_b;
    at_b = miss(b *= 2);
  }
  const bool held = at_a * at_b < 0;
  for (int i = 0; held && i < 100 && std::abs(b - a) > 1e-16 * std::abs(b) && at_b != 0; ++i) {
    const double c = b - at_b * (b - a) / (at_b - at_a), at_c = miss(c);
    if (at_b * at_c < 0)
      a = b, at_a = at_b;
    else
      at_a *= 0.5;
    b = c, at_b = at_c;
  }
  return held && std::abs(at_b) <= found * (1 + std::abs(b)) ? b : std::numeric_limits<double>::quiet_NaN();
}
}  // namespace detail

// By the secant method, which needs two values where x enters linearly; between two ends where that finds none.
template <class Miss>
double solved(bool bent, double guess, Miss&& miss) {
  double x = guess, missed = miss(x), next = x + missed;
  for (int i = 0; i < (bent ? 30 : 1) && next != x; ++i) {
    const double missed_next = miss(next), slope = (missed_next - missed) / (next - x);
    x = next, missed = missed_next;
    if (slope != 0) next = x - missed / slope;
    if (std::abs(next - x) <= 1e-16 * std::abs(next)) break;
  }
  const double left = miss(next);
  return !bent || std::abs(left) <= detail::found * (1 + std::abs(next)) ? next : detail::root_between(guess, miss);
}

}  // namespace freestand::dynamics
