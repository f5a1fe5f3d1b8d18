// What a step under laws gives: the series of the state, of the forces, and of what must hold while the mode lasts.
#pragma once

#include "dynamics/contact.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/rotation.hpp"
#include "dynamics/wall.hpp"

namespace freestand::dynamics {

// All members are numbers of one kind, in an order that lets the optional ones be left out at the end.
template <int N, class Real = double>
struct LawArc : Arc<Real, N> {
  Series<Real, N> ax;                       // absolute horizontal acceleration of the centre of mass [m/s2]
  Series<Real, N> moment;                   // T [m2/s2]
  Series<Real, N> limit_right, limit_left;  // largest |f_x| without slip, f_x to the right and to the left [m/s2]
  Series<Real, N> foot;                     // slip speed of the contact [m/s]
  Series<Real, N> path;                     // [m]
  Series<Real, N> deflection;               // of the legs [m]
  Series<Real, N> pressed;                  // f_y, or what of it decides whether the corner is let go [m/s2]
  Real versine;                             // 1 - cos(theta) at the start
  Real friction;                            // F at the start of a slip, else 1
  Series<Real, N> lift;                     // Y, where laws have one [m/s2]
  // With walls only.
  Series<Real, N> right_gap, left_gap;  // between the wall there and the edge next to it [m]
  Series<Real, N> wall_push;            // of the wall that the block leans on [m/s2]
  // As many as the laws have.
  Series<Real, N> states[max_states];  // of the effects' own
  Series<Real, N> kink[max_kinks];     // arguments, positive on the present side
};

// How many numbers there are in a LawArc up to its lift, its walls, its states and its kinks; a LawArc of a pack holds as many packs.
template <int N>
struct LawArcNumbers {
  static constexpr int series = N + 1, lift = 19 * series + 2, walls = lift + series, states = walls + 3 * series,
                       kinks = states + max_states * series, all = kinks + max_kinks * series;
  static_assert(sizeof(LawArc<N>) == all * sizeof(double));
};

// What pushes the block up, but gravity: the floor, and laws.
template <int N>
Series<double, N> upward(const Rig& rig, const LawArc<N>& arc) {
  return rig.laws->lift < 0 ? arc.fy : combination(1.0, arc.fy, 1.0, arc.lift);
}
template <int N>
const Series<double, N>& upward(const Rig&, const Arc<double, N>& arc) {
  return arc.fy;
}

// Whether an equation that has the laws in it has a solution: friction that looks at its own normal force may have none, and
// what would push the slip on is none.
template <int N>
bool has_forces(const LawArc<N>& arc) {
  double sum = 0;
  for (int k = 0; k < N; ++k) sum += arc.fx[k] + arc.fy[k] + arc.alpha[k] + arc.foot[k];
  return std::isfinite(sum) && arc.friction >= 0;
}
template <int N>
bool has_forces(const Arc<double, N>&) {
  return true;
}
template <int N>
bool has_forces(const Flight<double, N>&) {
  return true;
}

}  // namespace freestand::dynamics
