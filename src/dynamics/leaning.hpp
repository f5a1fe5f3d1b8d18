// A block that leans with an edge against a wall (law_step.hpp has the equations).
#pragma once

#include "dynamics/law_arc.hpp"

namespace freestand::dynamics {

template <int N>
struct Leaning {
  EdgeLever lever;                        // of the edge, over the corner
  Series<double, N> height, height_rate;  // of the edge, over the floor [m], [m/s]
  Series<double, N> over_centre;          // over the centre of mass [m]
  Series<double, N> pushed;               // by the wall, if the block did not turn and nothing rubbed [m/s2]
  Series<double, N> inertia;              // of that push against theta'' [m]

  // load: M (a - r_x omega^2) - X, to order k.
  void reach(int k, const Series<double, N>& sine, const Series<double, N>& cosine, const LawArc<N>& y, double load,
             double mass) {
    height[k] = lever.height(sine, cosine, k);
    height_rate[k] = lever.height_rate(sine, cosine, y.omega, k);
    over_centre[k] = height[k] - y.ry[k];
    pushed[k] = load - mass * product(height_rate, y.omega, k);
  }
};

}  // namespace freestand::dynamics
