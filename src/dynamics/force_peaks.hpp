// Running extremes of the forces on a block, per unit mass: of the floor on its base, and of one chain on it; and on what moves
// inside it. Blows are left out: in them forces are not known, only their impulses. Where nothing asks for them they are no numbers.
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
      response.peak_contact_horizontal_mps2 = response.peak_contact_vertical_mps2 = response.peak_chain_force_mps2 =
          response.peak_contents_acceleration_mps2 = 0;
  }
  bool followed() const { return followed_; }

  // u: displacement of the middle of the base over the step.
  template <class ContactArc, int N>
  void on_floor(const Rig& rig, const State& state, const ContactArc& arc, const Series<double, N>& u, double tau,
                Response& r) const {
    if (!followed_) return;
    r.peak_contact_horizontal_mps2 = peak_floor_force(rig, state, arc, tau, r.peak_contact_horizontal_mps2);
    r.peak_contact_vertical_mps2 = max_of(arc.fy, tau, r.peak_contact_vertical_mps2);
    by_laws(rig, state, u, arc, tau, r);
  }
  // The floor does nothing to it.
  template <int N>
  void in_flight(const Rig& rig, const State& state, const LawFlight<N>& flight, const Series<double, N>& u, double tau,
                 Response& r) const {
    if (followed_) by_laws(rig, state, u, flight, tau, r);
  }

 private:
  // A chain and contents look at where the block is and how it moves, and at their own states, alone.
  template <int N, class SomeArc>
  void by_laws(const Rig& rig, const State& state, const Series<double, N>& u, const SomeArc& arc, double tau,
               Response& r) const {
    if (!rig.laws || (rig.laws->tension < 0 && rig.laws->contents < 0)) return;
    const Laws& laws = *rig.laws;
    Series<double, N> values[max_nodes];
    for (int i = 0; i < input_count; ++i) values[i] = Series<double, N>::zero();
    values[static_cast<int>(Input::u)] = u;
    values[static_cast<int>(Input::v)] = derivative(u);
    values[static_cast<int>(Input::theta)] = arc.theta;
    values[static_cast<int>(Input::omega)] = arc.omega;
    if constexpr (requires { arc.states; })
      for (int i = 0; i < laws.states; ++i) values[static_cast<int>(Input::state) + i] = arc.states[i];
    for (int k = 0; k < N; ++k) laws.tape.advance(input_count, laws.forces_end, k, state.sides, values);
    const auto told = [&](int node, double& peak) {
      if (node < 0) return;
      values[node][N] = 0;
      peak = max_abs(values[node], tau, peak);
    };
    told(laws.tension, r.peak_chain_force_mps2);
    told(laws.contents, r.peak_contents_acceleration_mps2);
  }

  bool followed_;
};

}  // namespace freestand::dynamics
