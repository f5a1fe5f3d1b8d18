// Blocks of slide-rock that rock at present, side by side: what the packs march.
//
// Every lane is mirrored so that it stands on its right corner. Time is counted in intervals h: angular velocities are
// times h, accelerations times h^2.
#pragma once

#include "base/pack.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int march_slots = 64;
constexpr int still_intervals = 16384;
alignas(64) const double still_ground[still_intervals] = {};  // the floor after the record

struct SlideRockRows {
  alignas(64) double theta[march_slots], omega[march_slots], rx[march_slots], ry[march_slots];
  alignas(64) double a[march_slots];                              // unit record, at the knot
  alignas(64) double left[march_slots];                           // part of the interval that lies ahead
  alignas(64) double grip[march_slots], square[march_slots];      // mu_s f_y - |f_x|, squared acceleration, there
  alignas(64) double gravity[march_slots], push[march_slots];     // g h^2/J, scale h^2/J
  alignas(64) double weight[march_slots], weight_g[march_slots];  // scale h^2, g h^2
  alignas(64) double mu[march_slots];                             // mu_s
  alignas(64) double look[march_slots];                           // no smaller rotation is a new peak, nor its slip
  alignas(64) double seen[march_slots];                           // largest squared acceleration so far
  alignas(64) double bend0[march_slots], bend1[march_slots],
      bend2[march_slots];                       // bound of what forces do within an interval
  alignas(64) const double* next[march_slots];  // a at the end of the interval
  const double* stop[march_slots];              // the last such value

  // A lane in which nothing ever happens.
  void clear(int i) {
    omega[i] = rx[i] = ry[i] = a[i] = square[i] = 0;
    gravity[i] = push[i] = weight[i] = bend0[i] = bend1[i] = bend2[i] = 0;
    theta[i] = 0.5;
    grip[i] = weight_g[i] = mu[i] = left[i] = 1;
    look[i] = seen[i] = 1e300;
    next[i] = stop[i] = still_ground;
  }

  void copy(int from, int to) {
    for (double* row : {theta, omega, rx, ry, a, left, grip, square, gravity, push, weight, weight_g, mu, look, seen,
                        bend0, bend1, bend2})
      row[to] = row[from];
    next[to] = next[from];
    stop[to] = stop[from];
  }
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
