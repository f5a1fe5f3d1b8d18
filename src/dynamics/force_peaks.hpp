// Running extremes of the forces on a block, per unit mass: of the floor on its base, and of one chain on it; and on what moves
// inside it; and how its legs flex. Blows are left out: in them forces are not known, only their impulses. Where nothing asks for them
// they are no numbers.
#pragma once

#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <numbers>

#include "dynamics/floor_force.hpp"
#include "dynamics/law_flight.hpp"
#include "dynamics/rainflow.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {

class ForcePeaks {
 public:
  ForcePeaks(const Settings& settings, Response& response) : followed_(settings.contact_forces) {
    sway_.see(0);  // upright
    if (followed_)
      response.peak_contact_horizontal_mps2 = response.peak_contact_vertical_mps2 = response.peak_chain_force_mps2 =
          response.peak_contents_acceleration_mps2 = response.peak_leg_deflection_m = 0;
  }
  bool followed() const { return followed_; }

  // u: displacement of the middle of the base over the step.
  template <class ContactArc, int N>
  void on_floor(const Rig& rig, const State& state, const ContactArc& arc, const Series<double, N>& u, double tau,
                Response& r) {
    if (!followed_) return;
    r.peak_contact_horizontal_mps2 = peak_floor_force(rig, state, arc, tau, r.peak_contact_horizontal_mps2);
    r.peak_contact_vertical_mps2 = max_of(arc.fy, tau, r.peak_contact_vertical_mps2);
    by_laws(rig, state, u, risen(rig, state, arc), arc, tau, r);
    by_legs(rig, arc, tau, r);
  }
  // The floor does nothing to it.
  template <int N>
  void in_flight(const Rig& rig, const State& state, const LawFlight<N>& flight, const Series<double, N>& u, double tau,
                 Response& r) {
    if (!followed_) return;
    by_laws(rig, state, u, risen(rig, flight), flight, tau, r);
    by_legs(rig, flight, tau, r);
  }
  // A block at rest sways on over its stuck foot, for which nobody waits, by y'' + 2 z W y' + W^2 (y - y_e) = 0: from its first
  // turning point on each is exp(-pi z/sqrt(1 - z^2)) of the one before, on the other side.
  template <class SomeArc>
  void ring_down(const Rig& rig, const SomeArc& arc, const Response& r) {
    if constexpr (requires { arc.deflection; }) {
      if (!followed_ || !flexes(rig)) return;
      const double W = rig.laws->legs.frequency_radps, z = rig.laws->legs.damping,
                   root = std::sqrt(std::max(1 - z * z, 0.0));
      const double v = arc.deflection[1], from_end = -(2 * arc.deflection[2] + 2 * z * W * v) / (W * W),
                   end = arc.deflection[0] - from_end;
      if (root > 0) {
        double phase = std::atan2(v * root, W * from_end + z * v);
        if (!(phase > 0)) phase += std::numbers::pi;
        double sway = std::exp(-z / root * phase) *
                      (from_end * std::cos(phase) + (v / W + z * from_end) / root * std::sin(phase));
        // Of amplitudes below a thousandth of the largest the cubes are nothing.
        for (const double kept = std::exp(-z / root * std::numbers::pi), least = 1e-3 * r.peak_leg_deflection_m;
             std::abs(sway) > least; sway *= -kept)
          sway_.see(end + sway);
      }
      sway_.see(end);
    }
  }
  void tell_fatigue(Response& r) const {
    if (followed_) r.leg_fatigue_m = sway_.amplitude();
  }

 private:
  // Height of the middle of the base: B |sin(theta)| of a block on a corner.
  template <int N>
  static Series<double, N> risen(const Rig& rig, const State& state, const Arc<double, N>& arc) {
    if (state.pivot == 0) return Series<double, N>::zero();
    const double c = rig.offset(state.pivot), lever = state.pivot * rig.half_base() / (rig.h * rig.h + c * c);
    return combination(lever * rig.h, arc.rx, lever * c, arc.ry);
  }
  template <int N>
  static Series<double, N> risen(const Rig&, const Flight<double, N>& flight) {
    return combination(0.5, flight.gap_right, 0.5, flight.gap_left);
  }

  // A chain and contents look at where the block is and how it moves, and at their own states, alone.
  template <int N, class SomeArc>
  void by_laws(const Rig& rig, const State& state, const Series<double, N>& u, const Series<double, N>& rise,
               const SomeArc& arc, double tau, Response& r) const {
    if (!rig.laws || (rig.laws->tension < 0 && rig.laws->contents < 0)) return;
    const Laws& laws = *rig.laws;
    Series<double, N> values[max_nodes];
    for (int i = 0; i < input_count; ++i) values[i] = Series<double, N>::zero();
    values[static_cast<int>(Input::u)] = u;
    values[static_cast<int>(Input::v)] = derivative(u);
    values[static_cast<int>(Input::rise)] = rise;
    values[static_cast<int>(Input::climb)] = derivative(rise);
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

  static bool flexes(const Rig& rig) { return rig.laws && rig.laws->legs.frequency_radps > 0; }

  template <class SomeArc>
  void by_legs(const Rig& rig, const SomeArc& arc, double tau, Response& r) {
    if constexpr (requires { arc.deflection; }) {
      if (!flexes(rig)) return;
      const auto& y = arc.deflection;
      r.peak_leg_deflection_m = max_abs(y, tau, r.peak_leg_deflection_m);
      for_each_turn(y, tau, [&](double turned) { sway_.see(turned); });
      sway_.see(y.at(tau));
    }
  }

  bool followed_;
  Rainflow sway_;
};

}  // namespace freestand::dynamics
