#include "motion/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::motion {
namespace {

// One sign change of p between lower and upper, where the signs differ: secants kept inside by bisection (Illinois).
double root_between(const Polynomial& p, double lower, double upper, double at_lower, double at_upper) {
  double middle = lower;
  for (int i = 0; i < 200; ++i) {
    const double secant = upper - at_upper * (upper - lower) / (at_upper - at_lower);
    middle = i % 3 == 2 || !(secant > lower && secant < upper) ? lower + (upper - lower) / 2 : secant;
    if (middle <= lower || middle >= upper) break;
    const double value = p(middle);
    if (value == 0) break;
    if ((value < 0) == (at_lower < 0)) {
      lower = middle;
      at_lower = value;
    } else {
      upper = middle;
      at_upper = value;
    }
  }
  return middle;
}

// The straight line and the parabola, which are all that records need, without iteration.
Roots line_roots(const Polynomial& p, double length) {
  Roots roots;
  const double at_end = p(length);
  if ((p.c[0] < 0) != (at_end < 0) && p.c[0] != 0 && at_end != 0) roots.at[roots.count++] = -p.c[0] / p.c[1];
  return roots;
}

}  // namespace

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  d.degree = std::max(0, p.degree - 1);
  for (std::size_t k = 1; k <= static_cast<std::size_t>(p.degree); ++k) d.c[k - 1] = static_cast<double>(k) * p.c[k];
  return d;
}

Polynomial integral(const Polynomial& p, double start) {
  Polynomial sum;
  sum.degree = p.degree + 1;
  sum.c[0] = start;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(p.degree); ++k)
    sum.c[k + 1] = p.c[k] / static_cast<double>(k + 1);
  return sum;
}

Roots sign_changes(const Polynomial& p, double length) {
  if (p.degree == 0) return {};
  if (p.degree == 1) return line_roots(p, length);
  const Roots turns = sign_changes(derivative(p), length);
  Roots roots;
  double lower = 0, at_lower = p(0);
  for (int i = 0; i <= turns.count; ++i) {
    const double upper = i < turns.count ? turns.at[static_cast<std::size_t>(i)] : length;
    const double at_upper = p(upper);
    if (at_upper == 0) continue;  // touches zero or crosses it: the next bracket tells
    if (at_lower != 0 && (at_lower < 0) != (at_upper < 0))
      roots.at[static_cast<std::size_t>(roots.count++)] = root_between(p, lower, upper, at_lower, at_upper);
    lower = upper;
    at_lower = at_upper;
  }
  return roots;
}

double peak(const Polynomial& p, double length) {
  const Roots turns = sign_changes(derivative(p), length);
  double highest = std::max(std::abs(p(0)), std::abs(p(length)));
  for (int i = 0; i < turns.count; ++i) highest = std::max(highest, std::abs(p(turns.at[static_cast<std::size_t>(i)])));
  return highest;
}

}  // namespace freestand::motion
