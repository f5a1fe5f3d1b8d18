// The laws at one instant, apart from any step: in a blow, at rest, and as a check of a series.
#pragma once

#include "dynamics/law_step.hpp"

namespace freestand::dynamics {

// By how much the friction that a stuck contact could have at tau of its series misses the one that the laws give there: a
// power of the normal force, say, is no polynomial of the time [m/s2].
template <int N>
double grip_missed(const Rig& rig, const State& end, double time, const Floor<double, 1>& floor, const LawArc<N>& arc,
                   double tau) {
  if (end.sigma != 0 || !rig.laws->grip_changes()) return 0;
  LawStep<1> there(rig, end, time, floor);
  const LawArc<1>& fresh = there.run();
  return std::fmax(std::abs(fresh.limit_right[0] - arc.limit_right.at(tau)),
                   std::abs(fresh.limit_left[0] - arc.limit_left.at(tau)));
}
template <int N>
double grip_missed(const Rig&, const State&, double, const Floor<double, 1>&, const Arc<double, N>&, double) {
  return 0;
}

// The laws at one instant of contact, the weight on a still floor as normal force and |w| as slip speed: in a blow, and at
// rest.
struct LawValues {
  double force = 0, lift = 0, moment = 0, factor = 1;
  std::uint32_t sides = 0;  // of the kinks
  bool finite() const {
    return std::isfinite(force) && std::isfinite(lift) && std::isfinite(moment) && std::isfinite(factor) && factor >= 0;
  }
};

inline void inputs_at(const Rig& rig, const State& state, double time, int sigma, Series<double, 0>* values) {
  for (int i = 0; i < input_count; ++i) values[i][0] = 0;
  const auto set = [&](Input input, double x) { values[static_cast<int>(input)][0] = x; };
  const double B = state.pivot * rig.half_base();
  const Rotation<double> rotation = rotation_by(state.theta);
  set(Input::u, state.xi + B * rotation.versine);
  set(Input::v, state.w + B * rotation.sine * state.omega);
  set(Input::theta, state.theta);
  set(Input::omega, state.omega);
  set(Input::t, time);
  set(Input::path, state.path);
  set(Input::normal, rig.g / standard_gravity_mps2);
  set(Input::side, state.pivot);
  set(Input::sigma, sigma);
  set(Input::speed, std::abs(state.w));
  set(Input::rest, state.rested(time));
  set(Input::rise, B * rotation.sine);
  set(Input::climb, B * rotation.cosine * state.omega);
  for (int i = 0; i < rig.laws->states; ++i) values[static_cast<int>(Input::state) + i][0] = state.states[i];
}

inline LawValues law_values(const Rig& rig, const State& state, double time, int sigma) {
  const Laws& laws = *rig.laws;
  Series<double, 0> values[max_nodes];
  inputs_at(rig, state, time, sigma, values);
  const std::uint32_t sides = laws.sides_at(values, state.sides);
  const auto value = [&](int node, double without) { return node < 0 ? without : values[node][0]; };
  return {value(laws.force, 0), value(laws.lift, 0), value(laws.moment, 0), value(laws.friction, 1), sides};
}

}  // namespace freestand::dynamics
