// The Taylor series of rocking in packs, and what is read from it.
//
// In the time x = (t - t_i)/h of an interval, for theta, Omega = h omega and r = (r_x, r_y) = from the pivot to the centre
// of mass, so that no sine is taken (see dynamics/contact.hpp):
//     r_x' = Omega r_y,  r_y' = -Omega r_x,  Omega' = (h^2/J)(g r_x - a r_y),  a = a_i + (a_{i+1} - a_i) x
#pragma once

#include "base/pack.hpp"
#include "dynamics/pack/gravity.hpp"
#include "dynamics/pack/pull.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct RockEnd {
  Pack omega, rx, ry, a, theta = Pack(0.0);
};

template <int N>
struct RockSeries : Polynomials<Pack> {
  static constexpr int order = N + 1;                     // of omega
  Pack theta[N + 2], omega[N + 2], rx[N + 1], ry[N + 1];  // the rotation to one order more

  // gravity = g' h^2/J (dynamics/pack/gravity.hpp); a0, a1: floor acceleration and its rate, times h^2/J.
  // per: of the units of the pull to those.
  template <class Gravity, class Pull>
  [[gnu::always_inline]] void expand(const Gravity& gravity, const Pack& a0, const Pack& a1, Pull& pull,
                                     const Pack& per) {
    Pack a[N + 1];  // of the floor and the pull together
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) {
      const Pack over(1.0 / (k + 1));
      Pack alpha = times(rx, k, gravity), x = ry[0] * omega[k], y = rx[0] * omega[k];
      if constexpr (!Pull::pulls) {
        alpha = alpha - ry[k] * a0;
        if (k > 0) alpha = alpha - ry[k - 1] * a1;
      }
#pragma GCC unroll 16
      for (int i = 1; i <= k; ++i) {
        x = x + ry[i] * omega[k - i];
        y = y + rx[i] * omega[k - i];
      }
      if constexpr (Pull::pulls) {
        a[k] = per * pull.advance(k, x, y);
        if (k < 2) a[k] = a[k] + (k == 0 ? a0 : a1);
        alpha = alpha - convolution(ry, a, k);
      }
      theta[k + 1] = omega[k] * over;
      omega[k + 1] = alpha * over;
      rx[k + 1] = x * over;
      ry[k + 1] = y * Pack(-1.0 / (k + 1));
    }
    const Pack over(1.0 / (N + 1));
    theta[N + 1] = omega[N] * over;
    if constexpr (Pull::pulls) {
      a[N] = per * pull.advance(N, convolution(ry, omega, N), convolution(rx, omega, N));
      omega[N + 1] = (times(rx, N, gravity) - convolution(ry, a, N)) * over;
    } else {
      omega[N + 1] = (times(rx, N, gravity) - ry[N] * a0 - ry[N - 1] * a1) * over;
    }
  }
  template <class Gravity>
  void expand(const Gravity& gravity, const Pack& a0, const Pack& a1) {
    NoPull none;
    expand(gravity, a0, a1, none, a0);
  }

  RockEnd end(const Pack& a_next) const { return {sum(omega), sum(rx), sum(ry), a_next, sum(theta)}; }
  const Pack& omega_term(int k) const { return omega[k]; }
  Pack theta_at(const Pack& x) const { return at(theta, x); }
  Pack omega_at(const Pack& x) const { return at(omega, x); }
  const Pack& last() const { return omega[N + 1]; }  // its last term
  void arm_at(const Pack& x, Pack& x_arm, Pack& y_arm) const {
    x_arm = at(rx, x);
    y_arm = at(ry, x);
  }
};

// Root in [lo, hi] of the polynomial c of order M, positive at lo (times sign) and not so at hi: Halley's method from x,
// kept in the bracket, in the lanes of `open`.
struct Bracket {
  const Pack* c;
  Pack sign, lo, hi, x;
  PackMask open;

  template <int M>
  [[gnu::always_inline]] void narrow() {
    Pack value = c[M], slope(0.0), half_curvature(0.0);  // half_curvature: half the second derivative
#pragma GCC unroll 16
    for (int k = M - 1; k >= 0; --k) {
      half_curvature = half_curvature * x + slope;
      slope = slope * x + value;
      value = value * x + c[k];
    }
    const PackMask above = sign * value > Pack(0.0);
    lo = choose(above, x, lo);
    hi = choose(above, hi, x);
    // Near a turning point that is no root, Halley's step leads to that point: there the bracket is halved.
    const Pack square = slope * slope, curve = value * half_curvature, halley = x - value * slope / (square - curve);
    const PackMask leads = (halley >= lo) & (halley <= hi) & (square > xsimd::abs(curve));
    const Pack next = choose(leads, halley, Pack(0.5) * (lo + hi));
    // What is left after a step of Halley's is its third power by the square of half_curvature over slope: round-off then.
    const Pack step = xsimd::abs(next - x);
    const PackMask settled =
        leads & (step <= Pack(1e-6)) & (xsimd::abs(half_curvature) * step <= Pack(3e-5) * xsimd::abs(slope));
    x = choose(open, next, x);
    open = open & ~settled;
  }

  // Halves the bracket, in the lanes still open, until nothing is left of it.
  template <int M>
  [[gnu::noinline]] void halve() {
    for (int round = 0; round < 60; ++round) {
      const Pack middle = Pack(0.5) * (lo + hi);
      Pack value = c[M];
#pragma GCC unroll 16
      for (int k = M - 1; k >= 0; --k) value = value * middle + c[k];
      const PackMask above = sign * value > Pack(0.0);
      lo = choose(above, middle, lo);
      hi = choose(above, hi, middle);
    }
    x = choose(open, hi, x);
  }
};

// Several packs side by side: where each operation waits for the one before, the packs fill each other's gaps. Lanes in
// which so many steps have not found the root (it has others beside it, or the polynomial is flat) halve their brackets.
template <int M, int count>
void narrow_all(Bracket (&roots)[count]) {
#pragma GCC unroll 2
  for (Bracket& root : roots) root.x = xsimd::min(xsimd::max(root.x, root.lo), root.hi);
  for (int round = 0; round < 12; ++round) {
    unsigned open = 0;
    for (const Bracket& root : roots) open |= bits(root.open);
    if (!open) return;
#pragma GCC unroll 2
    for (Bracket& root : roots) root.template narrow<M>();
  }
  for (Bracket& root : roots)
    if (bits(root.open)) root.template halve<M>();
}

template <int M>
Pack bracketed_root(const Pack* c, const Pack& sign, const Pack& lo, const Pack& hi, const Pack& x, PackMask open) {
  Bracket one[] = {{c, sign, lo, hi, x, open}};
  narrow_all<M>(one);
  return one[0].x;
}

// First zero on (0, 1] of the parabola from `start`, with `slope` there, to `end` at 1; the second where it starts at 0.
inline Pack first_zero(const Pack& start, const Pack& slope, const Pack& end) {
  const Pack zero(0.0), half_curvature = end - start - slope;
  const Pack root = xsimd::sqrt(xsimd::max(slope * slope - Pack(4.0) * half_curvature * start, zero));
  const PackMask rises = slope > zero;
  return choose(rises, slope + root, Pack(2.0) * start) / choose(rises, Pack(-2.0) * half_curvature, root - slope);
}

// Where the angular velocity, of one sign at the start and the other at the end, is zero: to about 1e-9, so that the
// rotation there is exact.
template <class Step>
Pack turning_point(const Step& y, const Pack& omega_end) {
  const Pack one(1.0), zero(0.0), sense = choose(y.omega[0] > zero, one, zero - one);
  const Pack x = xsimd::min(first_zero(sense * y.omega[0], sense * y.omega[1], sense * omega_end), one);
  constexpr int order = Step::order;
  Pack value = y.omega_term(order), slope(0.0), half_curvature(0.0);
#pragma GCC unroll 16
  for (int k = order - 1; k >= 0; --k) {
    half_curvature = half_curvature * x + slope;
    slope = slope * x + value;
    value = value * x + y.omega_term(k);
  }
  const Pack next = x - value * slope / (slope * slope - value * half_curvature);
  return xsimd::min(xsimd::max(next, zero), one);
}

// May the angular velocity change its sign and change it back?
template <class Step>
PackMask turns_twice(const Step& y, const Pack& omega_end) {
  const Pack zero(0.0);
  return (y.omega[0] * omega_end > zero) & (y.omega[0] * y.omega[1] < zero) &
         (xsimd::abs(y.omega[1]) > Pack(2.0) * xsimd::abs(y.omega[0]));
}

// Squared acceleration of the centre of mass: its largest value from the start of the series to x = part, where the
// state is `end`, if it is above `seen`. `weight`: of the floor's acceleration, in the units of the series. Not `always`:
// only in lanes where the value at the start comes close to `seen`, whatever the other lanes do. `lift`: vertical acceleration of
// the floor, in the units of the series. `along`: the part of `a` that is gravity along the
// floor, and no acceleration. `pull`: no part of `a`.
template <class Step, class Gravity, class Lift = Level, class Pull = NoPull>
[[gnu::always_inline]] inline Pack watch_force(const Step& y, const Pack& weight, const Gravity& gravity,
                                               const Pack& push, const Pack& a, const Pack& rate_a, const RockEnd& end,
                                               const Pack& part, const Pack& seen, bool always, const Lift& lift = {},
                                               const Pack& along = Pack(0.0), const Pull& pull = {}) {
  const Pack two(2.0), zero(0.0), omega2 = y.omega[0] * y.omega[0];
  const Pack fx = y.ry[0] * y.omega[1] - y.rx[0] * omega2 + weight * (a - along);
  const Pack fy = less_at(y.rx[0] * y.omega[1] + y.ry[0] * omega2, lift, zero);  // g - f_y, as below
  const Pack square = fx * fx + fy * fy;
  const PackMask near = square > Pack(0.999) * seen;
  if (!always && !bits(near)) return seen;
  const Pack cross = two * y.omega[0] * y.omega[1], alpha1 = two * y.omega_term(2);
  const Pack rx1 = y.ry[0] * y.omega[0], ry1 = zero - y.rx[0] * y.omega[0];
  const Pack gx = ry1 * y.omega[1] + y.ry[0] * alpha1 - rx1 * omega2 - y.rx[0] * cross + weight * rate_a;
  const Pack gy = less_rate(rx1 * y.omega[1] + y.rx[0] * alpha1 + ry1 * omega2 + y.ry[0] * cross, lift);
  const Pack slope = two * (fx * gx + fy * gy);
  const Pack alpha = end.rx * value_at(gravity, part) - end.ry * (push * pull.with(end.a, part)),
             omega2_end = end.omega * end.omega;
  const Pack hx = end.ry * alpha - end.rx * omega2_end + weight * (end.a - along),
             hy = less_at(end.rx * alpha + end.ry * omega2_end, lift, part);
  const Pack square_end = hx * hx + hy * hy;
  const Pack high = xsimd::max(seen, xsimd::max(square, square_end));
  const Pack half_curvature = (square_end - square - slope * part) / (part * part);
  const PackMask tops = (slope > zero) & (slope + two * half_curvature * part < zero) &
                        (square - slope * slope / (Pack(4.0) * half_curvature) > high);
  const auto watched = [&](const Pack& most) { return always ? most : choose(near, most, seen); };
  if (!bits(tops)) return watched(high);
  const Pack at = choose(tops, slope / (Pack(-2.0) * half_curvature), part);
  const Pack omega = y.omega_at(at), a_top = a + rate_a * at;
  Pack rx, ry;
  y.arm_at(at, rx, ry);
  const Pack alpha_top = rx * value_at(gravity, at) - ry * (push * pull.with(a_top, at)), omega2_top = omega * omega;
  const Pack tx = ry * alpha_top - rx * omega2_top + weight * (a_top - along),
             ty = less_at(rx * alpha_top + ry * omega2_top, lift, at);
  return watched(xsimd::max(high, choose(tops, tx * tx + ty * ty, high)));
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
