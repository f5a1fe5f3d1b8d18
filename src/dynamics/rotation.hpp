// Sine and cosine of a rotation, in operations that a pack does lane by lane as a single number does them: by the series of
// both at half the angle, whose terms beyond these are below round-off for |theta| < pi/2 [Abramowitz & Stegun 4.3.65-66].
#pragma once

namespace freestand::dynamics {

template <class Real>
struct Rotation {
  Real sine, cosine;
  Real versine;  // 1 - cos(theta), to all its digits
};

template <class Real>
[[gnu::always_inline]] inline Rotation<Real> rotation_by(const Real& theta) {
  const Real x = theta * Real(0.5), x2 = x * x;
  Real s = Real(-1.0 / 1307674368000), c = Real(1.0 / 20922789888000);
  constexpr double sines[] = {1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1.0};
  constexpr double cosines[] = {-1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320,
                                -1.0 / 720,         1.0 / 24,        -0.5,           1.0};
#pragma GCC unroll 8
  for (const double term : sines) s = s * x2 + Real(term);
#pragma GCC unroll 8
  for (const double term : cosines) c = c * x2 + Real(term);
  const Real half_sine = s * x, versine = Real(2.0) * half_sine * half_sine;
  return {Real(2.0) * half_sine * c, Real(1.0) - versine, versine};
}

}  // namespace freestand::dynamics
