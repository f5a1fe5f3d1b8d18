// Blocks of slide-rock that rock at present, or slide-rock, side by side: what the packs march.
//
// Every lane is mirrored so that it stands on its right corner. Time is counted in intervals h: angular velocities are
// times h, accelerations times h^2.
#pragma once

#include <array>

#include "base/pack.hpp"
#include "dynamics/pack/slide_rock_gravity.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int still_intervals = 16384;
alignas(64) const double still_ground[still_intervals] = {};  // the floor after the record

template <class Field>
struct SlideRockRows {
  using Gravity = Field;
  alignas(64) double theta[march_slots], omega[march_slots], rx[march_slots], ry[march_slots];
  alignas(64) double a[march_slots];                              // unit record, at the knot
  alignas(64) double left[march_slots];                           // part of the interval that lies ahead
  alignas(64) double grip[march_slots], square[march_slots];      // mu_s f_y - |f_x|, squared acceleration, there
  alignas(64) double gravity[march_slots], push[march_slots];     // g h^2/J, scale h^2/J
  alignas(64) double weight[march_slots], weight_g[march_slots];  // scale h^2, g h^2
  alignas(64) double mu[march_slots];                             // mu_s
  alignas(64) double look[march_slots];                           // no smaller rotation is a new peak, nor its slip
  alignas(64) double seen[march_slots];                           // largest squared acceleration so far
  alignas(64) double turned[march_slots], room[march_slots];      // largest rotation; slip less s xi
  alignas(64) double half_base[march_slots];
  alignas(64) double bend0[march_slots], bend1[march_slots],
      bend2[march_slots];                       // bound of what forces do within an interval
  alignas(64) const double* next[march_slots];  // a at the end of the interval
  const double* stop[march_slots];              // the last such value
  typename Gravity::Rows shakes;

  // A lane in which nothing ever happens.
  void clear(int i) {
    omega[i] = rx[i] = ry[i] = a[i] = square[i] = 0;
    gravity[i] = push[i] = weight[i] = bend0[i] = bend1[i] = bend2[i] = 0;
    theta[i] = 0.5;
    turned[i] = room[i] = 0;
    grip[i] = weight_g[i] = mu[i] = left[i] = half_base[i] = 1;
    look[i] = seen[i] = 1e300;
    next[i] = stop[i] = still_ground;
  }

  // Out of use: it causes no work.
  void retire(int i) {
    theta[i] = 0.5;
    omega[i] = 0;
    left[i] = 1;
    look[i] = seen[i] = 1e300;
  }
  auto all() {
    return std::array{theta,    omega, rx,   ry,   a,     left,  grip,  square, gravity, push,     weight,
                      weight_g, mu,    look, seen, bend0, bend1, bend2, turned, room,    half_base};
  }
};

// Two lists of rows, one after the other.
template <std::size_t A, std::size_t B>
auto joined(const std::array<double*, A>& a, const std::array<double*, B>& b) {
  if constexpr (B == 0) {
    return a;
  } else {
    std::array<double*, A + B> all{};
    for (std::size_t i = 0; i < A; ++i) all[i] = a[i];
    for (std::size_t i = 0; i < B; ++i) all[A + i] = b[i];
    return all;
  }
}

template <class Field, class Friction>
struct SlipRows {
  using Gravity = Field;
  alignas(64) double theta[march_slots], omega[march_slots], rx[march_slots], ry[march_slots];
  alignas(64) double xi[march_slots], w[march_slots];             // of the corner
  alignas(64) double a[march_slots];                              // unit record, at the knot
  alignas(64) double left[march_slots];                           // part of the interval that lies ahead
  alignas(64) double weight[march_slots], weight_g[march_slots];  // scale h^2, g h^2
  alignas(64) double k2[march_slots], size[march_slots];          // gyration radius squared, height of the centre
  alignas(64) double friction[march_slots], sigma[march_slots];   // sigma mu_k; direction of the slip
  alignas(64) double half_base[march_slots], lever_x[march_slots], lever_y[march_slots];  // of the midpoint's slip
  alignas(64) double look[march_slots];                     // no smaller rotation is a new peak
  alignas(64) double peak[march_slots], seen[march_slots];  // slip, squared acceleration: largest so far
  alignas(64) const double* next[march_slots];              // a at the end of the interval
  const double* stop[march_slots];                          // the last such value
  typename Friction::Rows law;
  typename Gravity::Rows shakes;

  void clear(int i) {
    for (double* row : {theta, omega, rx, xi, w, a, weight, weight_g, friction, half_base, lever_x, lever_y, seen})
      row[i] = 0;
    ry[i] = left[i] = k2[i] = size[i] = sigma[i] = look[i] = peak[i] = 1;
    next[i] = stop[i] = still_ground;
  }

  void retire(int i) { seen[i] = 1e300; }
  auto all() {
    return joined(std::array{theta, omega, rx,       ry,    xi,        w,       a,       left, weight, weight_g,
                             k2,    size,  friction, sigma, half_base, lever_x, lever_y, look, peak,   seen},
                  law.all());
  }
};

// Flat on the floor, not mirrored.
template <class Friction>
struct FlatRows {
  using Gravity = Steady;
  alignas(64) double xi[march_slots], w[march_slots];
  alignas(64) double a[march_slots];                              // unit record, at the knot
  alignas(64) double left[march_slots];                           // part of the interval that lies ahead
  alignas(64) double weight[march_slots], weight_g[march_slots];  // scale h^2, g h^2
  alignas(64) double size[march_slots];                           // height of the centre
  alignas(64) double friction[march_slots];                       // sigma mu_k
  alignas(64) double sigma[march_slots];                          // direction of the slip
  alignas(64) double tips[march_slots];                           // F above which the block tips
  alignas(64) double peak[march_slots], seen[march_slots];        // slip, squared acceleration: largest so far
  alignas(64) const double* next[march_slots];                    // a at the end of the interval
  const double* stop[march_slots];                                // the last such value
  typename Friction::Rows law;

  void clear(int i) {
    for (double* row : all()) row[i] = 1;
    next[i] = stop[i] = still_ground;
  }
  void retire(int i) { seen[i] = 1e300; }
  auto all() {
    return joined(std::array{xi, w, a, left, weight, weight_g, size, friction, sigma, tips, peak, seen}, law.all());
  }
};

// Small hops; [0] on the left corner, [1] on the right one. Rotations are positive away from the floor.
template <class Field>
struct HopRows {
  using Gravity = Field;
  alignas(64) double theta[march_slots], omega[march_slots], side[march_slots];
  alignas(64) double a[march_slots];                          // unit record, where the lane is
  alignas(64) double left[march_slots];                       // part of the interval that lies ahead
  alignas(64) double limit2[march_slots], push[march_slots];  // four times a squared rotation; |a| of the unit record
  alignas(64) double weight[2][march_slots], tip[2][march_slots], kappa[2][march_slots], bend[2][march_slots];
  alignas(64) double kept[2][march_slots], told[2][march_slots], rests[2][march_slots];  // squared rates but the first
  alignas(64) double hops[march_slots], impacts[march_slots], ended[march_slots];        // impacts: those that count
  alignas(64) const double* next[march_slots];                                           // a at the end of the interval
  const double* stop[march_slots];                                                       // the last such value
  typename Gravity::HopRows shakes;

  void retire(int i) { push[i] = -1; }
  auto all() {
    return std::array{theta,    omega,     side,      a,        left,     limit2,  push,    hops,
                      impacts,  ended,     weight[0], tip[0],   kappa[0], bend[0], kept[0], told[0],
                      rests[0], weight[1], tip[1],    kappa[1], bend[1],  kept[1], told[1], rests[1]};
  }
  void clear(int i) {
    for (double* row : all()) row[i] = 1;
    next[i] = stop[i] = still_ground;
  }
};

// Lane `from` of the other rows becomes lane `to` of these.
template <std::size_t Count>
void copy_each(const std::array<double*, Count>& mine, int to, const std::array<double*, Count>& theirs, int from) {
  for (std::size_t k = 0; k < Count; ++k) mine[k][to] = theirs[k][from];
}
template <class Rows>
void copy_lane(Rows& rows, int to, Rows& other, int from) {
  copy_each(rows.all(), to, other.all(), from);
  if constexpr (Rows::Gravity::shaken) copy_each(rows.shakes.all(), to, other.shakes.all(), from);
  rows.next[to] = other.next[from];
  rows.stop[to] = other.stop[from];
}

constexpr double hops_at_once = 16;  // until it is asked whether a row of hops dies out
// Least last term of a series that counts. The series of laws may converge slowly; what they neglect is a speed, which
// stays for good, so it is less the shorter the step.
constexpr double neglected = 3e-11, neglected_by_laws = 3e-13;  // least term of a series that counts

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
