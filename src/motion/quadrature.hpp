// Integrals of polynomials over a segment, for the files of this folder.
#pragma once

namespace freestand::motion {

// Integral of f over [0, length], exact for polynomials up to degree 13 (Gauss-Legendre, 7 points).
template <class F>
double gauss(double length, const F& f) {
  constexpr double node[] = {0.0, 0.405845151377397166907, 0.741531185599394439864, 0.949107912342758524526};
  constexpr double weight[] = {0.417959183673469387755, 0.381830050505118944950, 0.279705391489276667901,
                               0.129484966168869693271};
  const double half = length / 2;
  double sum = weight[0] * f(half);
  for (int i = 1; i < 4; ++i) sum += weight[i] * (f(half * (1 - node[i])) + f(half * (1 + node[i])));
  return half * sum;
}

}  // namespace freestand::motion
