// Blocks of slide-rock that rock at present, or slide-rock, side by side: what the packs march.
//
// Every lane is mirrored so that it stands on its right corner. Time is counted in intervals h: angular velocities are
// times h, accelerations times h^2.
#pragma once

#include "dynamics/pack/lane_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Field>
struct SlideRockRows {
  using Gravity = Field;
  alignas(64) double theta[march_slots], omega[march_slots], rx[march_slots], ry[march_slots];
  alignas(64) double a[march_slots];                               // unit record, at the knot, and the slope
  alignas(64) double slope[march_slots];                           // gravity along the floor, in units of the record
  alignas(64) double fraction[march_slots];                        // part of the interval that lies ahead
  alignas(64) double grip[march_slots], square[march_slots];       // mu_s f_y - |f_x|, squared acceleration, there
  alignas(64) double gravity[march_slots], push[march_slots];      // g h^2/J, scale h^2/J
  alignas(64) double weight[march_slots], weight_g[march_slots];   // scale h^2, g h^2
  alignas(64) double mu_left[march_slots], mu_right[march_slots];  // mu_s against a slip to the left, and to the right
  alignas(64) double look[march_slots];                            // no smaller rotation is a new peak, nor its slip
  alignas(64) double seen[march_slots];                            // largest squared acceleration so far
  alignas(64) double turned[march_slots], room[march_slots];       // largest rotation; slip less s xi
  alignas(64) double half_base[march_slots];
  alignas(64) double curvature0[march_slots], curvature1[march_slots],
      curvature2[march_slots];                  // bound of what forces do within an interval
  alignas(64) const double* next[march_slots];  // a at the end of the interval
  const double* stop[march_slots];              // the last such value
  typename Gravity::Rows shakes;

  // Out of use: it causes no work.
  void retire(int i) {
    theta[i] = 0.5;
    omega[i] = 0;
    fraction[i] = 1;
    look[i] = seen[i] = 1e300;
  }
  [[gnu::always_inline]] auto all() {
    return std::array{theta,  omega,      rx,         ry,         a,        slope,   fraction, grip,
                      square, gravity,    push,       weight,     weight_g, mu_left, mu_right, look,
                      seen,   curvature0, curvature1, curvature2, turned,   room,    half_base};
  }
};

template <class Field, class Friction>
struct SlipRows {
  using Gravity = Field;
  alignas(64) double theta[march_slots], omega[march_slots], rx[march_slots], ry[march_slots];
  alignas(64) double xi[march_slots], w[march_slots];             // of the corner
  alignas(64) double a[march_slots], slope[march_slots];          // as in SlideRockRows
  alignas(64) double fraction[march_slots];                       // part of the interval that lies ahead
  alignas(64) double weight[march_slots], weight_g[march_slots];  // scale h^2, g h^2
  alignas(64) double k2[march_slots], size[march_slots];          // gyration radius squared, height of the centre
  alignas(64) double friction[march_slots], sigma[march_slots];   // sigma mu_k; direction of the slip
  alignas(64) double half_base[march_slots], lever_x[march_slots], lever_y[march_slots];  // of the midpoint's slip
  alignas(64) double look[march_slots];                                                   // the largest rotation so far
  alignas(64) double peak[march_slots], seen[march_slots];  // slip, squared acceleration: largest so far
  alignas(64) const double* next[march_slots];              // a at the end of the interval
  const double* stop[march_slots];                          // the last such value
  typename Friction::Rows law;
  typename Gravity::Rows shakes;

  void retire(int i) { seen[i] = 1e300; }
  [[gnu::always_inline]] auto all() {
    return std::array{theta, omega, rx,       ry,    xi,        w,       a,       slope, fraction, weight, weight_g,
                      k2,    size,  friction, sigma, half_base, lever_x, lever_y, look,  peak,     seen};
  }
};

// Flat on the floor, not mirrored.
template <class Field, class Friction>
struct FlatRows {
  using Gravity = Field;
  alignas(64) double xi[march_slots], w[march_slots];
  alignas(64) double a[march_slots];                              // unit record, at the knot
  alignas(64) double fraction[march_slots];                       // part of the interval that lies ahead
  alignas(64) double weight[march_slots], weight_g[march_slots];  // scale h^2, g h^2
  alignas(64) double size[march_slots];                           // height of the centre
  alignas(64) double friction[march_slots];                       // sigma mu_k
  alignas(64) double sigma[march_slots];                          // direction of the slip
  alignas(64) double tips[march_slots];                           // F above which the block tips
  alignas(64) double peak[march_slots], seen[march_slots];        // slip, squared acceleration: largest so far
  alignas(64) const double* next[march_slots];                    // a at the end of the interval
  const double* stop[march_slots];                                // the last such value
  typename Friction::Rows law;
  typename Gravity::Rows shakes;

  void retire(int i) { seen[i] = 1e300; }
  [[gnu::always_inline]] auto all() {
    return std::array{xi, w, a, fraction, weight, weight_g, size, friction, sigma, tips, peak, seen};
  }
};

// A pack of ends of slips.
struct SlipEnds {
  unsigned found, impacts;               // bits of the lanes; the others' slip stops
  alignas(64) double parts[pack_lanes];  // of what is left of the interval
};

// A slip that begins where the push reaches the grip starts with no acceleration, but for the error of that place: 1e-9 of an
// interval, of floors that change by g in one. In an interval of 0.01 s it would move 5e-13 m.
constexpr double slip_zero = 1e-9;  // [g]

// Least last term of a series that counts. The series of laws may converge slowly; what they neglect is a speed, which
// stays for good, so it is less the shorter the step.
constexpr double neglected = 3e-11, neglected_by_laws = 3e-13;  // least term of a series that counts

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
