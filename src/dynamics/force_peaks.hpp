// Running extremes of the forces on a block, per unit mass: of the floor on its base, and of one chain on it. Blows are left
// out: in them forces are not known, only their impulses. Where nothing asks for them they are no numbers.
#pragma once

#include <freestand/response.hpp>
#include <freestand/simulate.hpp>

#include "dynamics/floor_force.hpp"
#include "dynamics/law_flight.hpp"

namespace freestand::dynamics {

class ForcePeaks {
 public:
  ForcePeaks(const Settings& settings, Response& response) : followed_(settings.contact_forces) {
    if (followed_)
      response.peak_contact_horizontal_mps2 = response.peak_contact_vertical_mps2 = response.peak_chain_force_mps2 = 0;
  }
  bool followed() const { return followed_; }

  // u: displacement of the middle of the base over the step.
  template <class ContactArc, int N>
  void on_floor(const Rig& rig, const State& state, const ContactArc& arc, const Series<double, N>& u, double tau,
                Response& r) const {
    if (!followed_) return;
    r.peak_contact_horizontal_mps2 = peak_floor_force(rig, state, arc, tau, r.peak_contact_horizontal_mps2);
    r.peak_contact_vertical_mps2 = max_of(arc.fy, tau, r.peak_contact_vertical_mps2);
    by_chain(rig, state, u, arc.theta, arc.omega, tau, r);
  }
  // The floor does nothing to it.
  template <int N>
  void in_flight(const Rig& rig, const State& state, const Flight<double, N>& flight, const Series<double, N>& u,
                 double tau, Response& r) const {
    if (followed_) by_chain(rig, state, u, flight.theta, flight.omega, tau, r);
  }

 private:
  // The chain looks at where the block is and how it moves alone.
  template <int N>
  void by_chain(const Rig& rig, const State& state, const Series<double, N>& u, const Series<double, N>& theta,
                const Series<double, N>& omega, double tau, Response& r) const {
    if (!rig.laws || rig.laws->tension < 0) return;
    const Laws& laws = *rig.laws;
    Series<double, N> values[max_nodes];
    for (int i = 0; i < input_count; ++i) values[i] = Series<double, N>::zero();
    values[static_cast<int>(Input::u)] = u;
    values[static_cast<int>(Input::v)] = derivative(u);
    values[static_cast<int>(Input::theta)] = theta;
    values[static_cast<int>(Input::omega)] = omega;
    for (int k = 0; k < N; ++k) laws.tape.advance(input_count, laws.forces_end, k, state.sides, values);
    Series<double, N> pull = values[laws.tension];
    pull[N] = 0;
    r.peak_chain_force_mps2 = max_of(pull, tau, r.peak_chain_force_mps2);
  }

  bool followed_;
};

}  // namespace freestand::dynamics
