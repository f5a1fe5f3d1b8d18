// Flight with effects: the added force and moment act on, friction does not.
//
//   x'' = -a + X/M,   y'' = -g',   k^2 theta'' = T;   u = x + d (cos(theta) - 1) - h sin(theta), d = (b_r - b_l)/2
#pragma once

#include "dynamics/contact.hpp"
#include "dynamics/rig.hpp"

namespace freestand::dynamics {

template <int N>
struct LawFlight : Flight<double, N> {
  Series<double, N> ax;  // absolute horizontal acceleration of the centre of mass [m/s2]
  Series<double, N> states[max_states];
  int state_count;
  Series<double, N> kink[max_kinks];
};

// Height of a corner over the floor, in the very terms of its state in contact: at take-off it and its rate are zero.
template <int N>
Series<double, N> turning_gap(const LawFlight<N>& f, double c, double h) {
  Series<double, N> rx, ry, gap;
  const double sine = std::sin(f.theta[0]), cosine = std::cos(f.theta[0]);
  rx[0] = h * sine - c * cosine;
  ry[0] = c * sine + h * cosine;
  gap[0] = f.y[0] - ry[0];
  for (int k = 0; k < N; ++k) {
    const double over = 1.0 / (k + 1);
    rx[k + 1] = product(ry, f.omega, k) * over;
    ry[k + 1] = -product(rx, f.omega, k) * over;
    gap[k + 1] = f.y[k + 1] - ry[k + 1];
  }
  return gap;
}

template <int N>
LawFlight<N> fly_with_laws(const Rig& rig, const State& state, double time, const Floor<double, N>& floor) {
  const Laws& laws = *rig.laws;
  const double d = 0.5 * (rig.right - rig.left), h = rig.h;
  LawFlight<N> f;
  Series<double, N> values[max_nodes], sine, cosine;
  const auto value = [&](Input input, int offset = 0) -> Series<double, N>& {
    return values[static_cast<int>(input) + offset];
  };
  for (const Input constant : {Input::normal, Input::side, Input::sigma, Input::speed, Input::path, Input::t})
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
  sine[0] = std::sin(state.theta);
  cosine[0] = std::cos(state.theta);

  for (int k = 0; k < N; ++k) {
    const double over = 1.0 / (k + 1), one = k == 0 ? 1.0 : 0.0;
    value(Input::theta)[k] = f.theta[k];
    value(Input::omega)[k] = f.omega[k];
    value(Input::u)[k] = f.x[k] + d * (cosine[k] - one) - h * sine[k];
    value(Input::v)[k] = f.vx[k] - h * product(cosine, f.omega, k) - d * product(sine, f.omega, k);
    laws.tape.advance(input_count, laws.forces_end, k, state.sides, values);
    const double pull = laws.force < 0 ? 0.0 : values[laws.force][k] / laws.carried_mass;
    f.ax[k] = value(Input::acceleration)[k] = pull;
    laws.tape.advance(laws.friction_end, laws.tape.size(), k, state.sides, values);
    for (int i = 0; i < laws.states; ++i)
      value(Input::state, i)[k + 1] = values[laws.rate[static_cast<std::size_t>(i)]][k] * over;
    f.x[k + 1] = f.vx[k] * over;
    f.vx[k + 1] = (pull - floor.a[k]) * over;
    f.y[k + 1] = f.vy[k] * over;
    f.vy[k + 1] = -floor.g[k] * over;
    f.theta[k + 1] = f.omega[k] * over;
    f.omega[k + 1] = laws.moment < 0 ? 0.0 : values[laws.moment][k] / rig.k2 * over;
    sine[k + 1] = product(cosine, f.omega, k) * over;
    cosine[k + 1] = -product(sine, f.omega, k) * over;
  }
  f.ax[N] = 0;
  f.gap_right = turning_gap(f, rig.right, h);
  f.gap_left = turning_gap(f, -rig.left, h);
  f.state_count = laws.states;
  for (int i = 0; i < laws.states; ++i) f.states[i] = value(Input::state, i);
  for (int j = 0; j < laws.tape.kink_count(); ++j) {
    const double side = state.sides >> j & 1U ? -1.0 : 1.0;
    f.kink[j] = scaled(side, values[laws.tape.kink_argument(j)]);
    f.kink[j][N] = 0;
    if (state.turned_kink == j) f.kink[j][0] = 0;
    if (laws.tape.latched(j, state.sides) || laws.tape.kink_node(j) >= laws.forces_end)
      f.kink[j] = Series<double, N>::zero();  // no friction in flight
  }
  return f;
}

}  // namespace freestand::dynamics
