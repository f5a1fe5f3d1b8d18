// Flight with effects: the added force and moment act on (the moment where the block may turn), friction does not.
//
//   x'' = -a + X/M,   y'' = Y - g',   k^2 theta'' = T;   u = x + d (cos(theta) - 1) - h sin(theta), d = (b_r - b_l)/2
//
// An edge that stays at a wall, l over the centre of mass: x' + l omega = 0, and the push X_w of the wall adds to X, l X_w to T.
//   (1/M + l^2/k^2) X_w = a - X/M - l T/k^2 - l' omega;  an upright block's whole face: X_w = M a - X, theta'' = 0
#pragma once

#include "dynamics/contact.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/wall.hpp"

namespace freestand::dynamics {

template <int N>
struct LawFlight : Flight<double, N> {
  Series<double, N> ax, lift;    // absolute horizontal acceleration of the centre of mass, and Y [m/s2]
  Series<double, N> deflection;  // of the legs, whose foot has no mass: no force, W^2 y + 2 z W y' = 0 [m]
  Series<double, N> states[max_states];
  Series<double, N> kink[max_kinks];
  Series<double, N> right_gap[2], left_gap[2];  // between the walls and the lower and upper edges next to them [m]
  Series<double, N> wall_push;                  // of the wall at which an edge stays [m/s2]
};

// Height of a corner over the floor, in the very terms of its state in contact: at take-off it and its rate are zero.
template <int N>
Series<double, N> turning_gap(const LawFlight<N>& f, double c, double h) {
  Series<double, N> rx, ry, gap;
  const Rotation<double> rotation = rotation_by(f.theta[0]);
  rx[0] = h * rotation.sine - c * rotation.cosine;
  ry[0] = c * rotation.sine + h * rotation.cosine;
  gap[0] = f.y[0] - ry[0];
  for (int k = 0; k < N; ++k) {
    const double over = 1.0 / (k + 1);
    rx[k + 1] = product(ry, f.omega, k) * over;
    ry[k + 1] = -product(rx, f.omega, k) * over;
    gap[k + 1] = f.y[k + 1] - ry[k + 1];
  }
  return gap;
}

// Push of the wall at which an edge stays.
template <int N>
class PushInFlight {
 public:
  PushInFlight(const Rig& rig, const State& state)
      : rig_(rig), side_(state.at_wall() ? state.wall : 0), face_(state.edge == Edge::face) {
    if (side_ != 0) lever_ = lever_over_centre(rig, side_, state.edge);
  }

  // Adds its part of order k to the accelerations `pull` and `turn` of the block.
  void add(LawFlight<N>& f, const Series<double, N>& sine, const Series<double, N>& cosine,
           const Series<double, N>& floor, int k, double& pull, double& turn) {
    if (side_ == 0) return;
    const double M = rig_.carried_mass();
    over_centre_[k] = lever_.height(sine, cosine, k);
    rate_[k] = lever_.height_rate(sine, cosine, f.omega, k);
    if (face_) {
      push_[k] = M * (floor[k] - pull);
      turn = 0;
    } else {
      turn_[k] = turn;
      yield_[k] = product(over_centre_, over_centre_, k) / rig_.k2 + (k == 0 ? 1 / M : 0.0);
      double numerator = floor[k] - pull - product(over_centre_, turn_, k) - product(rate_, f.omega, k);
      for (int i = 1; i <= k; ++i) numerator -= yield_[i] * push_[k - i];
      push_[k] = numerator / yield_[0];
      turn += product(over_centre_, push_, k) / rig_.k2;
    }
    pull += push_[k] / M;
    f.wall_push[k] = -side_ * push_[k];
  }

 private:
  const Rig& rig_;
  int side_;
  bool face_;
  EdgeLever lever_{};
  Series<double, N> over_centre_, rate_, turn_, yield_, push_;  // yield: velocity of the edge by a unit push
};

// How far the edges are from the walls.
template <int N>
void measure_gaps(const Rig& rig, LawFlight<N>& f, const Series<double, N>& sine, const Series<double, N>& cosine) {
  const double versine = rotation_by(f.theta[0]).versine;
  for (const int side : {1, -1})
    for (const Edge edge : {Edge::lower, Edge::upper})
      (side > 0 ? f.right_gap : f.left_gap)[edge == Edge::upper] =
          clearance(to_wall(rig, side, lever_over_centre(rig, side, edge)), side, f.x, sine, cosine, versine);
}

// Arguments of the kinks that force and moment have; friction has none in flight.
template <int N>
void kinks_in_flight(const Laws& laws, const State& state, const Series<double, N>* values, LawFlight<N>& f) {
  for (int j = 0; j < laws.tape.kink_count(); ++j)
    f.kink[j] = laws.tape.kink_node(j) >= laws.forces_end ? Series<double, N>::zero()
                                                          : kink_argument(laws.tape, state, j, values);
}

template <int N>
LawFlight<N> fly_with_laws(const Rig& rig, const State& state, double time, const Floor<double, N>& floor) {
  const Laws& laws = *rig.laws;
  const double d = 0.5 * (rig.right - rig.left), h = rig.h;
  LawFlight<N> f;
  Series<double, N> values[max_nodes], sine, cosine;
  PushInFlight<N> wall(rig, state);
  const auto value = [&](Input input, int offset = 0) -> Series<double, N>& {
    return values[static_cast<int>(input) + offset];
  };
  for (const Input constant :
       {Input::normal, Input::side, Input::sigma, Input::speed, Input::path, Input::t, Input::rest})
    value(constant) = Series<double, N>::zero();
  value(Input::t)[0] = time;
  value(Input::t)[1] = 1;
  value(Input::path)[0] = state.path;
  for (int i = 0; i < laws.states; ++i) value(Input::state, i)[0] = state.states[i];
  f.x[0] = state.x;
  f.y[0] = state.y;
  f.theta[0] = state.theta;
  f.vx[0] = state.vx;
  f.vy[0] = state.vy;
  f.omega[0] = state.omega;
  f.deflection[0] = state.deflection;
  const Legs& legs = laws.legs;
  const double unload = legs.frequency_radps > 0 ? -legs.frequency_radps / (2 * legs.damping) : 0.0;
  const Rotation<double> rotation = rotation_by(state.theta);
  sine[0] = rotation.sine;
  cosine[0] = rotation.cosine;

  for (int k = 0; k < N; ++k) {
    const double over = 1.0 / (k + 1), one = k == 0 ? 1.0 : 0.0;
    value(Input::theta)[k] = f.theta[k];
    value(Input::omega)[k] = f.omega[k];
    value(Input::u)[k] = f.x[k] + d * (cosine[k] - one) - h * sine[k];
    value(Input::v)[k] = f.vx[k] - h * product(cosine, f.omega, k) - d * product(sine, f.omega, k);
    value(Input::rise)[k] = f.y[k] - h * cosine[k] - d * sine[k];
    value(Input::climb)[k] = f.vy[k] + h * product(sine, f.omega, k) - d * product(cosine, f.omega, k);
    laws.tape.advance(input_count, laws.forces_end, k, state.sides, values);
    f.lift[k] = laws.lift < 0 ? 0.0 : values[laws.lift][k];
    double pull = laws.force < 0 ? 0.0 : values[laws.force][k] / laws.carried_mass;
    double turn = laws.moment < 0 || !rig.can_rock ? 0.0 : values[laws.moment][k] / rig.k2;
    wall.add(f, sine, cosine, floor.a, k, pull, turn);
    f.ax[k] = value(Input::acceleration)[k] = pull;
    laws.tape.advance(laws.friction_end, laws.tape.size(), k, state.sides, values);
    for (int i = 0; i < laws.states; ++i) value(Input::state, i)[k + 1] = values[laws.rate[i]][k] * over;
    f.deflection[k + 1] = unload * f.deflection[k] * over;
    f.x[k + 1] = f.vx[k] * over;
    f.vx[k + 1] = (pull - floor.a[k]) * over;
    f.y[k + 1] = f.vy[k] * over;
    f.vy[k + 1] = (f.lift[k] - floor.g[k]) * over;
    f.theta[k + 1] = f.omega[k] * over;
    f.omega[k + 1] = turn * over;
    sine[k + 1] = product(cosine, f.omega, k) * over;
    cosine[k + 1] = -product(sine, f.omega, k) * over;
  }
  f.ax[N] = f.lift[N] = f.wall_push[N] = 0;
  f.gap_right = turning_gap(f, rig.right, h);
  f.gap_left = turning_gap(f, -rig.left, h);
  if (laws.walls.any()) measure_gaps(rig, f, sine, cosine);
  for (int i = 0; i < laws.states; ++i) f.states[i] = value(Input::state, i);
  kinks_in_flight(laws, state, values, f);
  return f;
}

}  // namespace freestand::dynamics
