// The state as the numbers that the reference integrates.
#pragma once

#include <algorithm>

#include "dynamics/law_arc.hpp"
#include "dynamics/law_flight.hpp"
#include "dynamics/rig.hpp"

namespace freestand::dynamics {

// contact: theta, omega, xi, w, -, -;  flight: theta, omega, x, vx, y, vy;  then path, deflection, the effects' states
inline constexpr int plain_size = 6, law_size = 2 + max_states, state_size = plain_size + law_size;

// What is no number of these is as in `like`.
inline State state_of(const double* v, const State& like) {
  State s = like;
  s.theta = v[0];
  s.omega = v[1];
  const bool flying = s.mode == Mode::flight;
  (flying ? s.x : s.xi) = v[2];
  (flying ? s.vx : s.w) = v[3];
  if (flying) s.y = v[4], s.vy = v[5];
  s.path = v[plain_size];
  s.deflection = v[plain_size + 1];
  std::copy(v + plain_size + 2, v + state_size, s.states.begin());
  return s;
}

inline void numbers_of(const State& s, double* v) {
  const bool flying = s.mode == Mode::flight;
  const double values[] = {s.theta,           s.omega, flying ? s.x : s.xi, flying ? s.vx : s.w, flying ? s.y : 0,
                           flying ? s.vy : 0, s.path,  s.deflection};
  std::copy(std::begin(values), std::end(values), v);
  std::copy(s.states.begin(), s.states.end(), v + plain_size + 2);
}

// Rates of path, deflection and the effects' states; the plain block has none.
template <class Plain>
void law_rates(const Plain&, int, double* d) {
  std::fill(d, d + law_size, 0.0);
}
inline void law_rates(const LawArc<2>& arc, int states, double* d) {
  d[0] = arc.path[1];
  d[1] = arc.deflection[1];
  for (int i = 0; i < max_states; ++i) d[2 + i] = i < states ? arc.states[i][1] : 0.0;
}
inline void law_rates(const LawFlight<2>& flight, int states, double* d) {
  d[0] = 0, d[1] = flight.deflection[1];
  for (int i = 0; i < max_states; ++i) d[2 + i] = i < states ? flight.states[i][1] : 0.0;
}

}  // namespace freestand::dynamics
