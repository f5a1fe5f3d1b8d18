// Where the edges of the side face are that a wall stops, and how high over the floor.
//
//        .----------o upper  |     displacements, of a block on a corner at displacement xi, from where it stood upright:
//       /          /         |       lower  X = xi + (c_s - c) (cos(theta) - 1)     height  -(c_s - c) sin(theta)
//      /    x     /          |       upper  X = lower + H sin(theta)                height  lower + H cos(theta)
//     /          /           |     c: offset of the corner, c_s: of the one on the wall's side s, H: height of the block
//    o----------o lower      |     the wall is reached where s X is the gap
//
// The wall's push J, away from it, acts at the edge: X_w = -s J on the block, and X_w times the edge's height over the
// centre of mass about that.
#pragma once

#include "dynamics/rig.hpp"

namespace freestand::dynamics {

// Height of an edge over a point of the block whose displacement is known: across * sin(theta) + up * cos(theta) [m]. That
// point is the corner on the floor, and in flight the centre of mass.
struct EdgeLever {
  double across, up;

  template <int N>
  double height(const Series<double, N>& sine, const Series<double, N>& cosine, int k) const {
    return across * sine[k] + up * cosine[k];
  }
  template <int N>
  double height_rate(const Series<double, N>& sine, const Series<double, N>& cosine, const Series<double, N>& omega,
                     int k) const {
    return across * product(cosine, omega, k) - up * product(sine, omega, k);
  }
};
inline EdgeLever lever_over_corner(const Rig& rig, int pivot, int side, Edge edge) {
  return {rig.offset(pivot) - rig.offset(side), edge == Edge::upper ? rig.top : 0.0};
}
inline EdgeLever lever_over_centre(const Rig& rig, int side, Edge edge) {
  return {-rig.offset(side), (edge == Edge::upper ? rig.top : 0.0) - rig.h};
}

// Distance from a wall's side, and the lever of an edge there.
template <class Real>
struct ToWall {
  Real gap, across, up;  // [m]
};
inline ToWall<double> to_wall(const Rig& rig, int side, const EdgeLever& lever) {
  return {rig.laws->walls.on(side).gap_m, lever.across, lever.up};
}

// Distance left between an edge and the wall on its side; x: displacement of the point that the lever is about; versine: 1 -
// cos(theta) at the start, to all its digits.
template <int N, class Real>
Series<Real, N> clearance(const ToWall<Real>& wall, double side, const Series<Real, N>& x, const Series<Real, N>& sine,
                          const Series<Real, N>& cosine, const Real& versine) {
  Series<Real, N> gap;
  for (int k = 0; k <= N; ++k) {
    const Real less = k == 0 ? -versine : cosine[k];
    gap[k] = Real(-side) * (x[k] - wall.across * less + wall.up * sine[k]);
  }
  gap[0] = gap[0] + wall.gap;
  return gap;
}

// Where an edge is at this instant, and how fast it comes.
struct EdgeNow {
  double gap;     // [m]
  double height;  // over the floor, in flight over the centre of mass [m]
  double speed;   // towards the wall [m/s]
};
inline EdgeNow edge_now(const Rig& rig, const State& state, int side, Edge edge) {
  const bool flies = state.mode == Mode::flight;
  const int pivot = state.pivot == 0 ? side : state.pivot;
  const EdgeLever lever = flies ? lever_over_centre(rig, side, edge) : lever_over_corner(rig, pivot, side, edge);
  const Rotation<double> rotation = rotation_by(state.theta);
  const double height = lever.across * rotation.sine + lever.up * rotation.cosine;
  const double x = (flies ? state.x : state.xi) + lever.across * rotation.versine + lever.up * rotation.sine;
  const double v = (flies ? state.vx : state.w) + height * state.omega;
  return {rig.laws->walls.on(side).gap_m - side * x, height, side * v};
}

// An edge that is nearer than steps can tell touches: a hundredth of 1e-9 of the height is more than the reference's steps
// leave, and rebounds that reach less are not followed.
inline double touching(const Rig& rig) { return std::fmax(rig.rest_height, 1e-11 * rig.top); }

inline bool within_reach_of_wall(const Rig& rig, const State& state, double reach) {
  if (!rig.laws) return false;
  for (const int side : {1, -1})
    for (const Edge edge : {Edge::lower, Edge::upper})
      if (rig.laws->walls.on(side).stands && edge_now(rig, state, side, edge).gap <= reach) return true;
  return false;
}
inline bool touches_wall(const Rig& rig, const State& state) {
  return within_reach_of_wall(rig, state, touching(rig));
}

// What is nearer is reached in a brief time at a speed that is not told.
inline double beside_wall(const Rig& rig) { return rig.told_speed * rig.brief_s; }

// An upright block touches the wall on that side.
inline bool touches_upright(const Rig& rig, const State& state, int side) {
  const Wall& wall = rig.laws->walls.on(side);
  return wall.stands && wall.gap_m - side * state.xi <= touching(rig);
}

}  // namespace freestand::dynamics
