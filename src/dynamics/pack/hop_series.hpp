// A small hop of a block that rocks, seen from the corner on which it stands, without sines:
//     theta'' = -beta (1 - theta^2/2) + kappa theta,  beta = (g b + a h)/J,  kappa = (g h - a b)/J,
// both straight in time, with g' for g where the floor shakes vertically. Its Taylor series to order 6; while beta > 0 the
// rotation is concave, and lands once.
#pragma once

#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct HopSeries {
  Pack c0, c1, c2, c3, c4, c5, c6;

  // beta1, kappa1: rates.
  HopSeries(const Pack& theta, const Pack& omega, const Pack& beta, const Pack& beta1, const Pack& kappa,
            const Pack& kappa1)
      : c0(theta), c1(omega) {
    const Pack half(0.5), chord = Pack(1.0) - half * c0 * c0;
    c2 = half * (kappa * c0 - beta * chord);
    c3 = Pack(1.0 / 6) * (kappa * c1 + beta * c0 * c1 + kappa1 * c0 - beta1 * chord);
    const Pack square2 = c0 * c2 + half * c1 * c1, square3 = c0 * c3 + c1 * c2;  // of theta^2/2
    c4 = Pack(1.0 / 12) * (kappa * c2 + beta * square2 + kappa1 * c1 + beta1 * c0 * c1);
    c5 = Pack(1.0 / 20) * (kappa * c3 + beta * square3 + kappa1 * c2 + beta1 * square2);
    const Pack square4 = c0 * c4 + c1 * c3 + half * c2 * c2;
    c6 = Pack(1.0 / 30) * (kappa * c4 + beta * square4 + kappa1 * c3 + beta1 * square3);
  }

  Pack height(const Pack& t) const {
    const Pack t2 = t * t;
    return (c0 + t * c1) + t2 * ((c2 + t * c3) + t2 * ((c4 + t * c5) + t2 * c6));
  }
  Pack speed(const Pack& t) const {
    const Pack t2 = t * t;
    return (c1 + t * (Pack(2.0) * c2)) +
           t2 * ((Pack(3.0) * c3 + t * (Pack(4.0) * c4)) + t2 * (Pack(5.0) * c5 + t * (Pack(6.0) * c6)));
  }

  // First zero after the start, of the parabola, or of the cubic where the start is at zero.
  Pack landing_about() const {
    const Pack zero(0.0), two(2.0), four(4.0);
    const PackMask flat = c0 == zero;
    const Pack square = choose(flat, c2 * c2 - four * c3 * c1, c1 * c1 - four * c2 * c0);
    const Pack root = xsimd::sqrt(xsimd::max(square, zero));
    return choose(flat, two * c1, c1 + root) / choose(flat, root - c2, zero - two * c2);
  }
  // Half the second derivative, to order 4 of the rotation.
  Pack curve(const Pack& t) const { return c2 + t * (Pack(3.0) * c3 + t * (Pack(6.0) * c4)); }
  // Exactly, by Halley's method, in the lanes of `open`; on return those in which it was not found.
  Pack landing(PackMask& open) const {
    Pack t = landing_about();
    for (int round = 0; round < 2 || (round < 12 && bits(open)); ++round) {
      const Pack f = height(t), slope = speed(t), step = f * slope / (slope * slope - f * curve(t));
      t = choose(open, t - step, t);
      open =
          open & ~(xsimd::abs(step) <= Pack(1e-5) * xsimd::abs(t));  // and the step after this one is within round-off
    }
    return t;
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
