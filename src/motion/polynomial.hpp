// Small polynomials c[0] + c[1] t + ... on a segment [0, length]: what the exact peaks and integrals are made of.
#pragma once

#include <array>
#include <cstddef>

namespace freestand::motion {

struct Polynomial {
  static constexpr int max_degree = 11;
  int degree = 0;
  std::array<double, max_degree + 1> c{};

  double operator()(double t) const {
    double value = c[static_cast<std::size_t>(degree)];
    for (int k = degree - 1; k >= 0; --k) value = value * t + c[static_cast<std::size_t>(k)];
    return value;
  }
};

Polynomial derivative(const Polynomial& p);

// Integral from 0 to t, plus `start`. Needs degree < max_degree.
Polynomial integral(const Polynomial& p, double start);

// Places in (0, length) where the sign of p changes, increasing: between the turning points of p (found the same way)
// p is monotone, so that each bracket holds one root, which bisection and secants pin down to rounding.
struct Roots {
  int count = 0;
  std::array<double, Polynomial::max_degree> at{};
};
Roots sign_changes(const Polynomial& p, double length);

// max |p| on [0, length].
double peak(const Polynomial& p, double length);

}  // namespace freestand::motion
