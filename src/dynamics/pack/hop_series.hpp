// A small hop of a block that rocks, seen from the corner on which it stands, without sines:
//     theta'' = -beta (1 - theta^2/2) + kappa theta,  beta = (g b + a h)/J,  kappa = (g h - a b)/J,
// both straight in time, with g' for g where the floor shakes vertically. Its Taylor series to order 6; while beta > 0 the
// rotation is concave, and lands once. A spring and a drag add -(stiffness theta^2/2 + drag theta theta') B h/J, of the way by which the middle of
// the base moves, B theta^2/2.
#pragma once

#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct NoPullOfHop {
  static constexpr bool pulls = false;
};
struct PullOfHop {
  static constexpr bool pulls = true;
  Pack stiffness, drag;  // times B h/J
};

struct HopSeries {
  Pack c0, c1, c2, c3, c4, c5, c6;

  // beta1, kappa1: rates.
  template <class Pull>
  HopSeries(const Pack& theta, const Pack& omega, const Pack& beta, const Pack& beta1, const Pack& kappa,
            const Pack& kappa1, const Pull& pull)
      : c0(theta), c1(omega) {
    // What spring and drag take, of coefficients k and k + 1 of theta^2/2.
    const auto less = [&](const Pack& all, const Pack& square, int k, const Pack& next) {
      if constexpr (Pull::pulls) return all - (pull.stiffness * square + pull.drag * (Pack(k + 1.0) * next));
      return all;
    };
    const Pack half(0.5), chord = Pack(1.0) - half * c0 * c0, square0 = half * c0 * c0, square1 = c0 * c1;
    c2 = half * less(kappa * c0 - beta * chord, square0, 0, square1);
    const Pack square2 = c0 * c2 + half * c1 * c1;
    c3 = Pack(1.0 / 6) * less(kappa * c1 + beta * c0 * c1 + kappa1 * c0 - beta1 * chord, square1, 1, square2);
    const Pack square3 = c0 * c3 + c1 * c2;
    c4 = Pack(1.0 / 12) * less(kappa * c2 + beta * square2 + kappa1 * c1 + beta1 * c0 * c1, square2, 2, square3);
    const Pack square4 = c0 * c4 + c1 * c3 + half * c2 * c2;
    c5 = Pack(1.0 / 20) * less(kappa * c3 + beta * square3 + kappa1 * c2 + beta1 * square2, square3, 3, square4);
    const Pack square5 = c0 * c5 + c1 * c4 + c2 * c3;
    c6 = Pack(1.0 / 30) * less(kappa * c4 + beta * square4 + kappa1 * c3 + beta1 * square3, square4, 4, square5);
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
