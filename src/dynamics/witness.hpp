// The inequalities that hold while a mode lasts. Each is a witness series, >= 0 in the mode; its first root is an
// event.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/contact.hpp"
#include "dynamics/floor_force.hpp"
#include "dynamics/law_flight.hpp"
#include "dynamics/law_step.hpp"
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
  above_left,            // gaps in flight
  clear_of_right_lower,  // the edges of the side faces have not reached the walls
  clear_of_right_upper,
  clear_of_left_lower,
  clear_of_left_upper,
  leaning,  // the wall at which an edge stays pushes it
  kink      // first of the kinks of the laws: a law has not come to where it bends or jumps
};

inline Witness kink_witness(int kink) { return static_cast<Witness>(static_cast<int>(Witness::kink) + kink); }
inline bool is_kink(Witness witness) { return witness >= Witness::kink; }

// The wall and the edge of a witness of clearance.
struct AtWall {
  int side;
  Edge edge;
};
inline bool is_clearance(Witness witness) {
  return witness >= Witness::clear_of_right_lower && witness <= Witness::clear_of_left_upper;
}
inline Witness clearance_witness(int side, bool upper) {
  return static_cast<Witness>(static_cast<int>(Witness::clear_of_right_lower) + (side > 0 ? 0 : 2) + upper);
}
inline AtWall at_wall(Witness witness) {
  const int place = static_cast<int>(witness) - static_cast<int>(Witness::clear_of_right_lower);
  return {place < 2 ? 1 : -1, place % 2 ? Edge::upper : Edge::lower};
}

// Both sides, the one to which the block turns first: so the mirror image of a sample goes the same way, to the bit.
inline std::array<int, 2> sides(const State& state) {
  const int first = state.theta > 0 || (state.theta == 0 && state.omega > 0) ? 1 : -1;
  return {first, -first};
}

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

// Friction on the base. Of an upright block that is pressed against a wall friction takes what it can, and the wall, through
// the centre of mass, the rest.
template <int N, class Real>
Series<Real, N> friction_at_wall(bool right, bool left, const LawArc<N, Real>& arc) {
  if constexpr (std::is_same_v<Real, double>) {
    if (right && arc.fx[0] < -arc.limit_left[0]) return scaled(-1.0, arc.limit_left);
    if (left && arc.fx[0] > arc.limit_right[0]) return arc.limit_right;
  }
  return arc.fx;
}

// What is at a wall comes no nearer; what leaves it at this instant has no speed either.
template <int N, class Visit>
void visit_clearance(const Rig& rig, const State& state, int side, bool upper, const Series<double, N>& gap,
                     Visit&& visit) {
  const bool leaves = state.released && state.is_by(side, upper ? Edge::upper : Edge::lower);
  Series<double, N> left = gap;
  if (leaves || (gap[0] < 0 && gap[0] >= -touching(rig))) left[0] = 0;
  if (leaves || (left[0] == 0 && std::abs(left[1]) < rig.force_zero)) left[1] = 0;  // round-off of a speed
  visit(clearance_witness(side, upper), left, ZeroTolerance{2, rig.force_zero * state.doubt});
}

// Where the block stands, and what it takes to tip it.
template <class Real>
struct Stance {
  bool turns, slips, can_slip, can_rock;
  Real pivot, sigma;
  Real right_arm, left_arm;  // of the corners, over the height of the centre of mass [1]
  Real over_height;          // 1/h [1/m]
};

// The inequalities of contact under laws, of one sample or of those of a pack: friction's limits differ by direction.
//
// Calls visit(Witness, const Series&).
template <int N, class Real, class Visit>
[[gnu::always_inline]] inline void visit_contact(const Stance<Real>& at, const Held& held, const LawArc<N, Real>& arc,
                                                 Visit&& visit) {
  const Real one(1.0), against(-1.0);
  if (at.turns) {
    visit(Witness::impact, scaled(at.pivot, arc.theta));
    Series<Real, N> upright = scaled(-at.pivot, arc.theta);
    upright[0] = upright[0] + Real(pi / 2);
    visit(Witness::upright, upright);
    if (at.slips) visit(Witness::regular, arc.d);
    if (at.can_slip) visit(Witness::pressed, arc.pressed);
  }
  if (at.slips) {
    visit(Witness::slipping, scaled(at.sigma, arc.foot));
  } else if (at.can_slip) {
    if (!held.left) visit(Witness::grip_right, combination(one, arc.limit_right, against, arc.fx));
    if (!held.right) visit(Witness::grip_left, combination(one, arc.limit_left, one, arc.fx));
  }
  if (at.turns) return;
  if (at.can_rock) {  // N_right (b_l + b_r) = b_l f_y - h f_x + T
    const Series<Real, N> lean =
        combination(against, friction_at_wall(held.right, held.left, arc), at.over_height, arc.moment);
    if (!held.left) visit(Witness::flat_right, combination(at.left_arm, arc.fy, one, lean));
    if (!held.right) visit(Witness::flat_left, combination(at.right_arm, arc.fy, against, lean));
  }
  // Two corners that push say so already.
  if (!at.can_rock || held.right || held.left) visit(Witness::pressed, arc.fy);
}

// How zero is told from round-off in them, as ZeroTolerance: level and acceleration. force, turn: as in Rig.
template <class Real>
std::pair<int, Real> zero_of(Witness witness, const Real& force, const Real& turn) {
  if (witness == Witness::impact || witness == Witness::upright) return {2, turn};
  if (witness == Witness::slipping) return {1, force};
  return {0, witness == Witness::regular ? Real(0.0) : force};
}

// The same, a wall that takes what presses against it, and kinks.
template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const LawArc<N>& arc, Visit&& visit) {
  const double zero = rig.force_zero * state.doubt, turn_zero = rig.turn_zero * state.doubt;
  const ZeroTolerance force{0, zero}, nothing{0, 0.0};
  const bool upright = state.pivot == 0;
  const Stance<double> stance{!upright,          state.sigma != 0,    rig.can_slip,
                              rig.can_rock,      double(state.pivot), double(state.sigma),
                              rig.right / rig.h, rig.left / rig.h,    1 / rig.h};
  const Held held = held_by_walls(rig, state);
  visit_contact(stance, held, arc, [&](Witness witness, const Series<double, N>& series) {
    const auto [level, acceleration] = zero_of(witness, zero, turn_zero);
    visit(witness, series, ZeroTolerance{level, acceleration});
  });
  const bool leans = !upright && state.at_wall();
  if (leans) visit(Witness::leaning, arc.wall_push, force);
  for (const int side : sides(state))
    if (rig.laws->walls.on(side).stands && !(leans && state.wall == side) && (!upright || state.sigma != 0))
      visit_clearance(rig, state, side, touching_edge(state.pivot, side) == Edge::upper,
                      side > 0 ? arc.right_gap : arc.left_gap, visit);
  for (int j = 0; j < rig.laws->tape.kink_count(); ++j)
    if (state.watches(j)) visit(kink_witness(j), past_instant(arc.kink[j], rig.instant_s), nothing);
}

template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const Flight<double, N>& flight, Visit&& visit) {
  const ZeroTolerance gap{2, rig.force_zero * state.doubt};
  for (const int corner : sides(state))
    visit(corner > 0 ? Witness::above_right : Witness::above_left, corner > 0 ? flight.gap_right : flight.gap_left,
          gap);
  Series<double, N> upright = scaled(flight.theta[0] < 0 ? 1.0 : -1.0, flight.theta);
  upright[0] += pi / 2;
  visit(Witness::upright, upright, ZeroTolerance{2, rig.turn_zero * state.doubt});
}

template <int N, class Visit>
void for_each_witness(const Rig& rig, const State& state, const LawFlight<N>& flight, Visit&& visit) {
  for_each_witness(rig, state, static_cast<const Flight<double, N>&>(flight), visit);
  if (state.at_wall()) visit(Witness::leaning, flight.wall_push, ZeroTolerance{0, rig.force_zero * state.doubt});
  for (const int side : sides(state))
    for (const bool upper : {false, true}) {
      const bool stays = state.at_wall() && state.is_by(side, upper ? Edge::upper : Edge::lower);
      if (rig.laws->walls.on(side).stands && !stays)
        visit_clearance(rig, state, side, upper, (side > 0 ? flight.right_gap : flight.left_gap)[upper], visit);
    }
  for (int j = 0; j < rig.laws->tape.kink_count(); ++j)
    if (state.watches(j)) visit(kink_witness(j), past_instant(flight.kink[j], rig.instant_s), ZeroTolerance{0, 0.0});
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

// Compiled once, in law_step.cpp.
extern template const LawArc<1>& LawStep<1>::run();
extern template const LawArc<1>& LawStep<1>::accelerations();
extern template const LawArc<2>& LawStep<2>::run();
extern template const LawArc<3>& LawStep<3>::run();
extern template const LawArc<7>& LawStep<7>::run();
extern template const LawArc<8>& LawStep<8>::run();
extern template const LawArc<10>& LawStep<10>::run();

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

// When the raised corner would be down again under the pull that it has now; infinite: not at all.
template <int N>
double fall_time(int pivot, const Series<double, N>& theta) {
  const double height = pivot * theta[0], rate = pivot * theta[1], half_curvature = pivot * theta[2];
  const double root = std::sqrt(std::fmax(rate * rate - 4 * half_curvature * height, 0.0));
  if (half_curvature < 0 && rate > 0) return (rate + root) / (-2 * half_curvature);
  return half_curvature < 0 || (rate < 0 && root > 0) ? 2 * height / (root - rate)
                                                      : std::numeric_limits<double>::infinity();
}

// The first event of the mode within h.
struct Found {
  bool any = false;
  Witness witness = Witness::impact;
  double tau = 0;
};

// How long before an impact a kink is the blow's: laws that look at where the block is, or how fast, often bend there, and their arguments
// and the rotation are known to the tolerance of a step alone. height: of the corner that comes down at tau [rad].
template <int N, class Real>
Real before_blow(const Series<Real, N>& height, const Real& tau, const Real& rest_rotation) {
  using std::abs;
  return rest_rotation / abs(derivative(height).at(tau));
}

class FirstEvent {
 public:
  FirstEvent(double h, double rest_rotation) : rest_rotation_(rest_rotation) { found_.tau = h; }
  template <int N>
  void operator()(Witness witness, const Series<double, N>& series, ZeroTolerance zero) {
    double tau = 0;
    const double within = is_kink(witness) ? std::fmax(found_.tau - before_blow_, 0.0) : found_.tau;
    if (!first_root(series, within, zero, tau) || (found_.any && !(tau < found_.tau))) return;
    found_ = {true, witness, tau};
    before_blow_ = witness == Witness::impact ? before_blow(series, tau, rest_rotation_) : 0;
  }
  Found found() const { return found_; }

 private:
  const double rest_rotation_;
  double before_blow_ = 0;
  Found found_;
};

// Whether every witness of a mode is >= 0 just after the instant. One whose known terms all vanish holds so far: further terms may
// tell otherwise.
enum class Verdict { fails, has_not_begun, holds_so_far, holds };

class AllHold {
 public:
  template <int N>
  void operator()(Witness witness, const Series<double, N>& series, ZeroTolerance zero) {
    if (is_kink(witness)) return;
    const int sign = sign_after(series, zero);
    fails_ = fails_ || sign < 0;
    known_ = known_ && sign != 0;
  }
  // What has to be > 0.
  template <int N>
  void must_rise(const Series<double, N>& series, ZeroTolerance zero) {
    const int sign = sign_after(series, zero);
    fails_ = fails_ || sign < 0;
    begun_ = begun_ && sign > 0;
  }
  Verdict verdict() const {
    if (fails_) return Verdict::fails;
    return !begun_ ? Verdict::has_not_begun : known_ ? Verdict::holds : Verdict::holds_so_far;
  }

 private:
  bool fails_ = false, known_ = true, begun_ = true;
};

}  // namespace freestand::dynamics
