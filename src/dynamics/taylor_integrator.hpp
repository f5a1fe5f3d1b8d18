// The integrator of the sweep: one Taylor step between two knots of the floor motion, or up to the next event.
#pragma once

#include <algorithm>
#include <cmath>

#include "dynamics/integration.hpp"
#include "dynamics/law_rows.hpp"
#include "dynamics/law_values.hpp"

namespace freestand::dynamics {

// Divisors that make the terms of a series pure numbers.
struct Sizes {
  double over_angle;      // 1/alpha
  double over_rotation;   // 1/(p alpha), of rates of rotation [s]
  double over_length;     // 1/R [1/m]
  double over_speed;      // 1/(p R) [s/m]
  double longest_step_s;  // 1/p

  explicit Sizes(const Block& block)
      : over_angle(1 / block.alpha_rad()),
        over_rotation(1 / (block.p_radps() * block.alpha_rad())),
        over_length(1 / block.size_m()),
        over_speed(1 / (block.p_radps() * block.size_m())),
        longest_step_s(1 / block.p_radps()) {}
};

template <int N, class Real>
[[gnu::always_inline]] inline Real whole_power(const Real& x) {
  Real result = x;
#pragma GCC unroll 16
  for (int i = 1; i < N; ++i) result = result * x;
  return result;
}

// Records at their own pace have kernels of their own where there are no laws. All other motions go by the equations with laws.
inline bool follows_record(const Shaking& shaking) { return shaking.motion->degree <= 1 && shaking.stretch == 1; }

// By so many tolerances the accelerations at the end of a step may miss those of its series: a miss e of an acceleration that
// grows as tau^7 leaves e tau/8 in a speed.
inline constexpr double defect_allowed = 10;

// Steps are not halved below this, over the longest one: a law with no series at a place (a pole) is passed in such steps, or
// ends the sample.
inline constexpr double shortest_step = 1e-6;

// N: order of the steps on one corner. FlatN: order in which sliding is exact, degree of the motion + 2.
template <int N, int FlatN>
class TaylorIntegrator {
 public:
  TaylorIntegrator(const Setup& setup, const Settings& settings, History* history)
      : trajectory_(setup, settings, history, !follows_record(setup.shaking)),
        flat_exactly_(!trajectory_.rig.laws),
        straight_{trajectory_.rig.laws && trajectory_.rig.laws->straight(false),
                  trajectory_.rig.laws && trajectory_.rig.laws->straight(true)},
        size_(setup.specimen.block) {}

  Response run() {
    while (goes_on()) step();
    return trajectory_.result();
  }

  // Ends the sample when it is time to.
  bool goes_on() {
    trajectory_.stop_when_done();
    return !trajectory_.finished();
  }

  // Compiled once, in taylor_integrator.cpp. Along `arc`: a step whose series is known.
  void step();
  void step_along(const LawArc<N>& arc);

  Integration& trajectory() { return trajectory_; }
  const Sizes& sizes() const { return size_; }

 private:
  void move_on(const Floor<double, N>& floor) {
    with_contact_arc<N>(trajectory_.rig, trajectory_.state, trajectory_.cursor.time(), floor, [&](const auto& arc) {
      if (has_forces(arc))
        step_along(arc, floor, length_of_step(arc));
      else
        trajectory_.resolve(Witness::regular);
    });
  }
  void slide_exactly(const Floor<double, FlatN>& floor) {
    const auto arc = contact_arc<FlatN>(trajectory_.rig, trajectory_.state, floor);
    if (has_forces(arc))
      step_along(arc, floor, whole_step());
    else
      trajectory_.resolve(Witness::regular);
  }

  // What turns is seen over a tenth of a radian at most, for the gaps under the corners.
  void fly_on(const Floor<double, N>& floor) {
    const double turn = std::abs(trajectory_.state.omega);
    const double quarter = turn > 0 ? 0.1 / turn : 0.1;
    with_flight_arc<N>(trajectory_.rig, trajectory_.state, trajectory_.cursor.time(), floor, [&](const auto& flight) {
      step_along(flight, floor, std::min(length_of_step(flight), quarter));
    });
  }

  // Along the series of the state's mode, over h at most, to the first event or as far as the laws follow it.
  template <class Arc, int M>
  void step_along(const Arc& arc, const Floor<double, M>& floor, double h) {
    const State before = trajectory_.state;
    Found found = first_event(before, arc, h);
    while (found.tau > shortest_step * size_.longest_step_s && !follows_laws(before, arc, floor, found.tau)) {
      h = 0.5 * found.tau;
      found = first_event(before, arc, h);
    }
    const double tau = found.tau;
    if (tau > 0) trajectory_.peaks.observe(trajectory_.rig, before, arc, tau);
    trajectory_.recorder.record(before, arc, floor, trajectory_.cursor.time(), tau);
    go_to(trajectory_.rig, trajectory_.state, arc, tau);
    end_step(found, h);
  }

  template <class Arc>
  Found first_event(const State& state, const Arc& arc, double h) const {
    FirstEvent first(h, trajectory_.rig.rest_rotation);
    for_each_witness(trajectory_.rig, state, arc, first);
    return first.found();
  }

  // Whether the accelerations and the friction at tau are those of the series. A law may have series whose last terms vanish (even in
  // time, say) while later ones do not: the last term alone is no judge.
  template <int M>
  bool follows_laws(const State& before, const LawArc<M>& arc, const Floor<double, M>& floor, double tau) const {
    const Laws& laws = *trajectory_.rig.laws;
    const bool grip_changes = before.sigma == 0 && laws.grip_changes();
    if (straight_[before.sigma != 0] && !grip_changes) return true;
    State end = before;
    go_to(trajectory_.rig, end, arc, tau);
    const Floor<double, 1> there{{floor.a.at(tau), 0}, {floor.g.at(tau), 0}};
    LawStep<1> there_on(trajectory_.rig, end, trajectory_.cursor.time() + tau, there);
    const LawArc<1>& fresh = there_on.accelerations();
    const double grip =
        grip_changes ? grip_missed(trajectory_.rig, end, trajectory_.cursor.time() + tau, there, arc, tau) : 0.0;
    return missed_little(fresh.w[1], derivative(arc.w).at(tau), fresh.omega[1], derivative(arc.omega).at(tau), tau) &&
           grip * size_.over_speed * tau <= defect_allowed * trajectory_.settings.tolerance;
  }
  bool follows_laws(const State& before, const LawFlight<N>& flight, const Floor<double, N>& floor, double tau) const {
    State end = before;
    go_to(trajectory_.rig, end, flight, tau);
    const Floor<double, 1> there{{floor.a.at(tau), 0}, {floor.g.at(tau), 0}};
    const LawFlight<1> fresh = fly_with_laws<1>(trajectory_.rig, end, trajectory_.cursor.time() + tau, there);
    return missed_little(fresh.vx[1], derivative(flight.vx).at(tau), fresh.omega[1], derivative(flight.omega).at(tau),
                         tau);
  }
  // The plain block's series know their own error.
  template <class Arc, int M>
  bool follows_laws(const State&, const Arc&, const Floor<double, M>&, double) const {
    return true;
  }
  bool missed_little(double slip, double slip_of_series, double turn, double turn_of_series, double tau) const {
    const double allowed = defect_allowed * trajectory_.settings.tolerance;
    return std::abs(slip - slip_of_series) * size_.over_speed * tau <= allowed &&
           std::abs(turn - turn_of_series) * size_.over_rotation * tau <= allowed;
  }

  // A step that reached the knot goes to the next segment; an event is resolved where it fell.
  void end_step(const Found& found, double h) {
    const bool at_knot = !found.any && h == trajectory_.cursor.left();
    trajectory_.cursor.advance(found.tau);
    if (found.tau > 0) trajectory_.left_instant(found.tau);
    if (at_knot) trajectory_.next_segment();
    if (found.any) trajectory_.resolve(found.witness);
  }

  // Last term of the series, dimensionless, over tau^N: a step neglects about as much in the forces, and less in the state.
  template <int M>
  double last_term(const Arc<double, M>& arc) const {
    return std::max({std::abs(arc.theta[M]) * size_.over_angle, std::abs(arc.omega[M]) * size_.over_rotation,
                     std::abs(arc.xi[M]) * size_.over_length, std::abs(arc.w[M]) * size_.over_speed});
  }
  double last_term(const LawArc<N>& arc) const {
    const double lengths = std::max(std::abs(arc.path[N]), std::abs(arc.deflection[N])) * size_.over_length;
    return std::max({last_term(static_cast<const Arc<double, N>&>(arc)), lengths, last_of_states(arc.states)});
  }
  double last_term(const Flight<double, N>&) const { return 0; }  // polynomials
  double last_term(const LawFlight<N>& flight) const {
    return std::max({std::abs(flight.theta[N]) * size_.over_angle, std::abs(flight.omega[N]) * size_.over_rotation,
                     std::abs(flight.x[N]) * size_.over_length, std::abs(flight.vx[N]) * size_.over_speed,
                     std::abs(flight.vy[N]) * size_.over_speed, std::abs(flight.deflection[N]) * size_.over_length,
                     last_of_states(flight.states)});
  }
  double last_of_states(const Series<double, N>* states) const {
    double most = 0;
    for (int i = 0; i < trajectory_.rig.laws->states; ++i)
      most = std::max(most, std::abs(states[i][N]) *
                                (trajectory_.rig.laws->relative_velocity[i] ? size_.over_speed : size_.over_length));
    return most;
  }

  double whole_step() const { return std::min(trajectory_.left(), size_.longest_step_s); }

  template <class Arc>
  double length_of_step(const Arc& arc) const {
    const double h = whole_step(), last = last_term(arc), tolerance = trajectory_.settings.tolerance;
    if (!(last * whole_power<N>(h) > tolerance)) return h;
    const double longest = size_.longest_step_s;  // in its terms the answer at half the scale has the same bits
    return longest * std::pow(tolerance / (last * whole_power<N>(longest)), 1.0 / N);
  }

  Integration trajectory_;
  bool flat_exactly_;  // steps of order FlatN are exact on both corners
  bool straight_[2];   // laws of what is stuck, and of what slips
  Sizes size_;
};

template <class Motion>
using IntegratorOf = TaylorIntegrator<Motion::order, Motion::degree + 2>;

}  // namespace freestand::dynamics
