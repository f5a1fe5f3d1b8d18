// The inequalities that hold while a mode lasts. Each is a witness series, >= 0 in the mode; its first root is an
// event.
#pragma once

#include "dynamics/contact.hpp"
#include "dynamics/law_arc.hpp"
#include "dynamics/law_flight.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {

enum class Witness : int {
  impact,      // s theta: the raised corner is above the floor
  upright,     // pi/2 - s theta: the block has not fallen over
  pressed,     // f_y: the corner pushes on the floor
  grip_right,  // mu_s f_y - f_x: the contact does not slip (to the left, pushed right)
  grip_left,   // mu_s f_y + f_x
  slipping,    // sigma w: the slip has not stopped
  flat_right,  // N_right: both corners push on the floor
  flat_left,   // N_left
  regular,     // k^2 + r_x q: not Painleve's paradox
  above_right,
  above_left,  // gaps in flight
  clear,       // the contact has not reached the wall
  kink         // first of the kinks of the laws: a law has not come to where it bends or jumps
};

inline Witness kink_witness(int kink) { return static_cast<Witness>(static_cast<int>(Witness::kink) + kink); }
inline bool is_kink(Witness witness) { return witness >= Witness::kink; }

// In the pure rocking model the pivot is a hinge, as in Housner's: it neither slips nor lifts.
//
// Calls visit(Witness, const Series&, ZeroTolerance) for every witness of the state's mode.
template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const Arc<double, N>& arc, Visit&& visit) {
  const double zero = rig.force_zero * state.doubt, turn_zero = rig.turn_zero * state.doubt;
  const ZeroTolerance force{0, zero}, velocity{1, zero}, rotation{2, turn_zero};
  const double s = state.pivot;
  if (state.pivot != 0) {
    visit(Witness::impact, scaled(s, arc.theta), rotation);
    Series<double, N> upright = scaled(-s, arc.theta);
    upright[0] += pi / 2;
    visit(Witness::upright, upright, rotation);
    if (state.sigma != 0) visit(Witness::regular, arc.d, ZeroTolerance{0, 0.0});
    if (rig.can_slip) visit(Witness::pressed, arc.fy, force);
  }
  if (state.sigma != 0) {
    visit(Witness::slipping, scaled(double(state.sigma), arc.w), velocity);
  } else if (rig.can_slip) {
    visit(Witness::grip_right, combination(rig.mu_s, arc.fy, -1.0, arc.fx), force);
    visit(Witness::grip_left, combination(rig.mu_s, arc.fy, 1.0, arc.fx), force);
  }
  if (state.pivot == 0) {
    if (rig.can_rock) {  // moments about the corners: N_right (b_l + b_r) = b_l f_y - h f_x
      visit(Witness::flat_right, combination(rig.left / rig.h, arc.fy, -1.0, arc.fx), force);
      visit(Witness::flat_left, combination(rig.right / rig.h, arc.fy, 1.0, arc.fx), force);
    } else {
      visit(Witness::pressed, arc.fy, force);
    }
  }
}

// Friction on the base. Of a block that is pressed against a wall friction takes what it can, and the wall, through the
// centre of mass, the rest.
template <int N>
Series<double, N> friction_at_wall(const State& state, const LawArc<N>& arc) {
  if (state.wall > 0 && arc.fx[0] < -arc.limit_left[0]) return scaled(-1.0, arc.limit_left);
  if (state.wall < 0 && arc.fx[0] > arc.limit_right[0]) return arc.limit_right;
  return arc.fx;
}

// The same with laws: friction's limits differ by direction, a wall takes what presses against it, and kinks are watched.
template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const LawArc<N>& arc, Visit&& visit) {
  const double zero = rig.force_zero * state.doubt, turn_zero = rig.turn_zero * state.doubt;
  const ZeroTolerance force{0, zero}, velocity{1, zero}, displacement{2, zero}, rotation{2, turn_zero};
  const double s = state.pivot;
  if (state.pivot != 0) {
    visit(Witness::impact, scaled(s, arc.theta), rotation);
    Series<double, N> upright = scaled(-s, arc.theta);
    upright[0] += pi / 2;
    visit(Witness::upright, upright, rotation);
    if (state.sigma != 0) visit(Witness::regular, arc.d, ZeroTolerance{0, 0.0});
    if (rig.can_slip) visit(Witness::pressed, arc.fy, force);
  }
  if (state.sigma != 0) {
    visit(Witness::slipping, scaled(double(state.sigma), arc.foot), velocity);
    const double gap = rig.laws->wall.gap_m;
    if (gap * state.sigma > 0) {
      Series<double, N> clearance = scaled(-double(state.sigma), arc.xi);
      clearance[0] = state.wall == state.sigma ? 0.0 : clearance[0] + std::abs(gap);
      visit(Witness::clear, clearance, displacement);
    }
  } else if (rig.can_slip) {
    if (state.wall >= 0) visit(Witness::grip_right, combination(1.0, arc.limit_right, -1.0, arc.fx), force);
    if (state.wall <= 0) visit(Witness::grip_left, combination(1.0, arc.limit_left, 1.0, arc.fx), force);
  }
  if (state.pivot == 0) {
    if (rig.can_rock) {  // N_right (b_l + b_r) = b_l f_y - h f_x + T
      Series<double, N> lean = combination(-1.0, friction_at_wall(state, arc), 1 / rig.h, arc.moment);
      visit(Witness::flat_right, combination(rig.left / rig.h, arc.fy, 1.0, lean), force);
      visit(Witness::flat_left, combination(rig.right / rig.h, arc.fy, -1.0, lean), force);
    } else {
      visit(Witness::pressed, arc.fy, force);
    }
  }
  for (int j = 0; j < rig.laws->tape.kink_count(); ++j)
    if (j != state.held_kink) visit(kink_witness(j), arc.kink[j], ZeroTolerance{0, 0.0});
}

template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const Flight<double, N>& flight, Visit&& visit) {
  const ZeroTolerance gap{2, rig.force_zero * state.doubt};
  visit(Witness::above_right, flight.gap_right, gap);
  visit(Witness::above_left, flight.gap_left, gap);
  Series<double, N> upright = scaled(flight.theta[0] < 0 ? 1.0 : -1.0, flight.theta);
  upright[0] += pi / 2;
  visit(Witness::upright, upright, ZeroTolerance{2, rig.turn_zero * state.doubt});
}

template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const LawFlight<N>& flight, Visit&& visit) {
  for_each_witness(rig, state, static_cast<const Flight<double, N>&>(flight), visit);
  for (int j = 0; j < rig.laws->tape.kink_count(); ++j)
    if (j != state.held_kink) visit(kink_witness(j), flight.kink[j], ZeroTolerance{0, 0.0});
}

// Series of the state's mode, one corner or two down.
template <int N>
Arc<double, N> contact_arc(const Rig& rig, const State& state, const Floor<double, N>& floor) {
  Arc<double, N> arc;
  const int pivot = state.pivot == 0 ? 1 : state.pivot;
  start_arc(arc, rig.corner(pivot), state.theta, state.omega, state.xi, state.w);
  const double sigma_mu = state.sigma * rig.mu_k;
  if (state.pivot == 0)
    flat(arc, floor, sigma_mu, state.sigma == 0);
  else if (state.sigma == 0)
    rock(arc, floor, rig.corner(pivot));
  else
    slide_rock(arc, floor, rig.corner(pivot), sigma_mu);
  return arc;
}

// Calls use(arc) with the series of the state's mode, with laws or without.
template <int N, class Use>
auto with_contact_arc(const Rig& rig, const State& state, double time, const Floor<double, N>& floor, Use&& use) {
  if (!rig.laws) return use(contact_arc<N>(rig, state, floor));
  LawStep<N> step(rig, state, time, floor);
  return use(step.run());
}

// Slip speed of the contact.
template <int N>
const Series<double, N>& slip_speed(const Arc<double, N>& arc) {
  return arc.w;
}
template <int N>
const Series<double, N>& slip_speed(const LawArc<N>& arc) {
  return arc.foot;
}
inline double slip_speed(const Rig& rig, const State& state) {
  return rig.laws && rig.laws->legs.frequency_radps > 0 ? state.foot : state.w;
}

template <int N>
Flight<double, N> flight_arc(const Rig& rig, const State& state, const Floor<double, N>& floor) {
  Flight<double, N> flight;
  flight.x[0] = state.x;
  flight.y[0] = state.y;
  flight.theta[0] = state.theta;
  flight.vx[0] = state.vx;
  flight.vy[0] = state.vy;
  flight.omega[0] = state.omega;
  fly(flight, floor, rig.right, rig.left, rig.h);
  return flight;
}

template <int N, class Use>
auto with_flight_arc(const Rig& rig, const State& state, double time, const Floor<double, N>& floor, Use&& use) {
  if (rig.laws) return use(fly_with_laws<N>(rig, state, time, floor));
  return use(flight_arc<N>(rig, state, floor));
}

// The first event of the mode within h.
struct Found {
  bool any = false;
  Witness witness = Witness::impact;
  double tau = 0;
};

class FirstEvent {
 public:
  explicit FirstEvent(double h) { found_.tau = h; }
  template <int N>
  void operator()(Witness witness, const Series<double, N>& series, ZeroTolerance zero) {
    double tau = 0;
    if (first_root(series, found_.tau, zero, tau) && (!found_.any || tau < found_.tau)) found_ = {true, witness, tau};
  }
  Found found() const { return found_; }

 private:
  Found found_;
};

// True when every witness of the mode is >= 0 just after the instant.
class AllHold {
 public:
  template <int N>
  void operator()(Witness witness, const Series<double, N>& series, ZeroTolerance zero) {
    if (!is_kink(witness)) hold_ = hold_ && sign_after(series, zero) >= 0;
  }
  bool hold() const { return hold_; }

 private:
  bool hold_ = true;
};

}  // namespace freestand::dynamics
