// What both integrators share: the trajectory of one sample from event to event. They differ only in how they move between
// events.
#pragma once

#include "dynamics/floor_cursor.hpp"
#include "dynamics/history_recorder.hpp"
#include "dynamics/mode_logic.hpp"
#include "dynamics/peaks.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/step_watch.hpp"
#include "dynamics/witness.hpp"

namespace freestand::dynamics {

struct HopRow;

// The model can start so.
bool can_start(const Specimen&);
// Sizes, friction, scales, effects and settings that can be integrated at all.
bool admissible(const Specimen&, const Shaking&, const FloorInput&, const Settings&);
inline bool admissible(const Setup& setup, const Settings& settings) {
  return admissible(setup.specimen, setup.shaking, setup.floor, settings);
}

// The state at tau of a step.
template <int N>
void go_to(const Rig&, State& state, const Arc<double, N>& arc, double tau) {
  state.theta = arc.theta.at(tau);
  state.omega = arc.omega.at(tau);
  state.xi = arc.xi.at(tau);
  state.w = arc.w.at(tau);
}

template <int N>
void go_to(const Rig& rig, State& state, const LawArc<N>& arc, double tau) {
  go_to(rig, state, static_cast<const Arc<double, N>&>(arc), tau);
  state.path = arc.path.at(tau);
  state.deflection = arc.deflection.at(tau);
  state.foot = state.sigma == 0 ? 0.0 : arc.foot.at(tau);
  for (int i = 0; i < rig.laws->states; ++i) state.states[static_cast<std::size_t>(i)] = arc.states[i].at(tau);
}

template <int N>
void go_to(const Rig&, State& state, const Flight<double, N>& flight, double tau) {
  state.theta = flight.theta.at(tau);
  state.omega = flight.omega.at(tau);
  state.x = flight.x.at(tau);
  state.y = flight.y.at(tau);
  state.vx = flight.vx.at(tau);
  state.vy = flight.vy.at(tau);
}

template <int N>
void go_to(const Rig& rig, State& state, const LawFlight<N>& flight, double tau) {
  go_to(rig, state, static_cast<const Flight<double, N>&>(flight), tau);
  state.deflection = flight.deflection.at(tau);
  for (int i = 0; i < rig.laws->states; ++i) state.states[static_cast<std::size_t>(i)] = flight.states[i].at(tau);
}

// The contact slips no more; on legs the base moves on.
inline void stand_still(const Rig& rig, State& state) {
  if (!rig.laws || rig.laws->legs.frequency_radps == 0) state.w = 0;
  state.foot = 0;
}

inline constexpr double beyond_all_bounds = 1e6;  // [m], [rad] and per second: a law feeds the motion

class Integration {
 public:
  Integration(const Setup& setup, const Settings& settings, History* history, bool as_under_laws = false);

  bool finished() const { return finished_; }
  // At rest nothing is integrated: goes along the motion to the instant at which rest ends, or to its end.
  void wait();
  // At rest with nothing that moves on.
  bool waits() const { return state.mode == Mode::rest && !(rig.laws && rig.laws->evolve_at_rest()); }
  // To the next knot, or after the motion to the end of the time given [s].
  double left() const {
    return cursor.motion_over() ? std::fmax(shaking.duration_s() + settings.free_vibration_s - cursor.time(), 0.0)
                                : cursor.left();
  }
  void next_segment() {
    cursor.next_segment();
    watch_.steps = 0;
  }
  // Others have gone along the motion for it, in so many steps within the segment.
  void went_to(std::size_t segments_left, double start, double offset, int steps) {
    cursor.go_to(segments_left, start, offset);
    watch_.steps = steps;
    state.doubt = 1;
  }
  // In them it has struck the floor so many times and rocked on, stuck, told of them of rotations that count as impacts, and so many kinks
  // have turned.
  void went_through(int blows, int told, int kinks);
  // It has struck the floor once more and is stuck, or one more kink has turned: how it goes on is to be told.
  void goes_on_after(bool impact) {
    const State from = state;
    choose(from, impact);
  }
  int steps() const { return watch_.steps; }
  int events_left() const { return settings.event_limit - resolved_; }
  // Time went on by tau: what was special about the last instant is over.
  void left_instant(double tau);
  // Applies an event: sets what the event makes exact, strikes or lands where corners meet the floor, chooses the next
  // mode.
  void resolve(Witness witness);
  void chose(const State& from, bool impact);  // counts and records a change of mode
  void stop(Outcome outcome);
  // Ends the sample when it can move no more, or has used up its time.
  void stop_when_done();
  Response result();

  const Rig rig;
  const Shaking shaking;
  const Settings settings;
  FloorCursor cursor;
  State state;
  Peaks peaks;
  HistoryRecorder recorder;

 private:
  void start_from(const Start&);
  bool beyond_a_wall() const;
  double slip() const;
  bool pass_over_quiet_floor(const Rig::AtRest& rest);  // false: here it moves the block
  bool stays_put(const FloorCursor::Bound& floor, const Rig::AtRest& rest) const;
  void record_rest(const FloorCursor& segment);
  template <int N>
  bool look_ahead(const Rig::AtRest& rest);
  void choose(const State& from, bool impact);
  void count_impact();
  bool choose_beside_wall();  // where no mode stands
  bool rests_at_wall(int side);
  bool land_on(int corner);
  bool sinks(int corner) const;
  void stop_without_mode();
  bool meet_wall(int side, Edge edge);
  bool meet_walls_too();
  bool comes_through_wall() const;
  bool reaches_wall(int side, Edge edge, double within, double faster_than) const;
  bool is_next_to(Edge edge, int side) const;
  void lie_against(int side);
  void keep_contents_velocity(double speed_before);
  void stop_slip();
  bool strike_floor();
  bool feel_two_hops(State hop, HopRow& row);
  void feel_end_of_row(const State& from, const HopRow& row);
  void feel_standing();
  bool feel_hop(State& hop, HopRow& row);
  void leave_row(double slip, double lasted);
  Rig::AtRest laws_at_rest() const;
  bool forces_have_values() const;
  bool strikes_too(double at_once) const;
  bool leans_for_good() const;
  bool ends_with_the_motion() const;
  bool settles() const;  // at rest, for so long that nothing on it can move it any more

  bool finished_ = false;
  bool moved_ = false;
  double rest_since_ = 0;     // [s]
  double hops_end_ = 0;       // the last row of hops with which the block came to stand on both corners [s]
  double took_off_from_ = 0;  // the centre of mass, in the last flight [m]
  double unslid_ = 0;         // it flew so far in all, and began so far from 0 [m]
  double p_;
  StepWatch watch_;
  int resolved_ = 0;  // events, those that changed nothing included
  Outcome outcome_ = Outcome::moved;
};

}  // namespace freestand::dynamics
