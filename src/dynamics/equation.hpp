// The root of miss(x) near a guess: an equation for a force or a speed that a law follows while it sets it.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

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

// Of one sample, or of each lane of a pack.
template <class Real>
struct Root {
  Real x;
  decltype(Real() < Real()) found;
};

// By the secant method; miss() is called with the root at last. Numbers: as in single_root.hpp.
template <class Numbers, class Real, class Miss>
Root<Real> secant(const Real& guess, Miss&& miss) {
  using std::abs;
  Real x = guess, missed = miss(x), next = x + missed;
  auto open = next != x;
  for (int i = 0; i < 30 && Numbers::any(open); ++i) {
    const Real missed_next = miss(next), slope = (missed_next - missed) / (next - x);
    const Real nearer = Numbers::choose(open & (slope != Real(0.0)), next - missed_next / slope, next);
    x = Numbers::choose(open, next, x);
    missed = Numbers::choose(open, missed_next, missed);
    next = nearer;
    open = open & (abs(next - x) > Real(1e-16) * abs(next));
  }
  const Real left = miss(next);
  return {next, abs(left) <= Real(detail::found) * (Real(1.0) + abs(next))};
}

// Of one sample: between two ends where the secant method finds none. As there, miss() is called with the root at last.
template <class Miss>
double solved_between(double guess, Miss&& miss) {
  const double x = detail::root_between(guess, miss);
  miss(x);
  return x;
}
template <class Numbers, class Miss>
double solved(double guess, Miss&& miss) {
  const Root<double> root = secant<Numbers>(guess, miss);
  return root.found ? root.x : solved_between(guess, miss);
}

// A force x = act(x) that laws look at while they set it, of one sample or of each lane of a pack.
template <class Numbers, class Real>
class Feedback {
 public:
  // Coefficient 0 of its series; act() is called with it at last.
  template <class Act>
  Real first(const Real& guess, Act&& act) {
    const auto miss = [&](const Real& x) { return act(x) - x; };
    if constexpr (std::is_same_v<Real, double>) {
      return solved<Numbers>(guess, miss);
    } else {
      const Root<Real> root = secant<Numbers>(guess, miss);
      found_ = root.found;
      return root.x;
    }
  }
  // Not that of a second root, at which the floor pulls: friction that grows as the pressure falls has one. none: there is no force.
  template <class Act, class Mask>
  Real first_upward(const Real& guess, Act&& act, const Mask& none) {
    const Real x = first(guess, act);
    if constexpr (std::is_same_v<Real, double>) {
      return x < 0 ? solved_between(0.0, [&](double y) { return act(y) - y; }) : x;
    } else {
      found_ = found_ & (x >= Real(0.0)) & ~none;
      return x;
    }
  }
  // Coefficient k > 0 enters linearly, with the same slope in each order.
  template <class Act>
  Real next(int k, Act&& act) {
    using std::abs;
    const Real at_zero = act(Real(0.0));
    if (k == 1) {
      const Real some = Real(1.0) + abs(at_zero);
      gain_ = some / (some - (act(some) - at_zero));
    }
    return at_zero * gain_;
  }
  // Lanes that have a root. Single samples look further where there is none at hand.
  auto found() const { return found_; }

 private:
  Real gain_;
  decltype(Real() < Real()) found_ = Real(0.0) == Real(0.0);
};

}  // namespace freestand::dynamics
