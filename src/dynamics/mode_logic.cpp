#include "dynamics/mode_logic.hpp"

#include <algorithm>
#include <array>

#include "dynamics/witness.hpp"

namespace freestand::dynamics {
namespace {

// Whether the wall at which an edge is goes on pushing it.
enum class AtWall { released, pushed };

// Arguments of the kinks in the trial's mode.
template <int N>
std::array<Series<double, N>, max_kinks> kinks_in(const Rig& rig, const FloorCursor& cursor, const State& trial) {
  std::array<Series<double, N>, max_kinks> kinks;
  const auto take = [&](const auto& laws) { std::copy_n(laws.kink, rig.laws->tape.kink_count(), kinks.begin()); };
  if (trial.mode == Mode::flight)
    take(fly_with_laws<N>(rig, trial, cursor.time(), cursor.local<N>()));
  else
    take(LawStep<N>(rig, trial, cursor.time(), cursor.local<N>()).run());
  return kinks;
}

// Forces, slip speed and their directions may jump when the mode changes, and may end on the other side of a kink: a trial is
// judged by the laws that hold where it is itself. What a kink looks at depends on the kinks before it, and on which way the trial
// goes, which may change once as they turn; where the normal force lets them turn in a circle the laws stay as they were.
void settle_kinks(const Rig& rig, const FloorCursor& cursor, State& trial) {
  const int count = rig.laws ? rig.laws->tape.kink_count() : 0;
  if (count == 0) return;
  const std::uint32_t before = trial.sides;
  for (int turn = 0; turn <= 3 * count; ++turn) {
    const auto turns = [&](const auto& kinks, int j) {
      const auto argument = past_instant(kinks[j], rig.instant_s);
      const bool falls = trial.watches(j) && sign_after(argument, {0, 0.0}) < 0;
      // A step whose argument is zero in the whole mode (a speed at rest, a rotation on both corners), and so not greater.
      const bool stays_at_zero = rig.laws->tape.is_step(j) && !(trial.sides >> j & 1U) && vanishes(argument);
      return falls || stays_at_zero;
    };
    // A few terms mostly tell; where they are round-off, or zero, later ones may tell otherwise.
    const auto few = kinks_in<3>(rig, cursor, trial);
    int j = 0;
    while (j < count && !(turns(few, j) && turns(kinks_in<judge_order>(rig, cursor, trial), j))) ++j;
    if (j == count) return;
    trial.sides ^= 1U << j;
  }
  trial.sides = before;
}

// One step of the search: does the state hold in this mode?
bool stands(const Rig& rig, const FloorCursor& cursor, State& state, Mode mode, int pivot, int sigma,
            AtWall at_wall = AtWall::released) {
  State trial = state;
  trial.mode = mode;
  trial.pivot = pivot;
  trial.sigma = sigma;
  if (pivot == 0) trial.wall = 0;
  trial.released = trial.wall != 0 && at_wall == AtWall::released;
  if (sigma == 0) trial.foot = 0;
  settle_kinks(rig, cursor, trial);
  const auto verdict = [&](const auto& arc) {
    AllHold all;
    for_each_witness(rig, trial, arc, all);
    // A slip or a rotation that is to start must start: zero to all orders is the stuck mode's, not this one's.
    if (sigma != 0) all.must_rise(scaled(double(sigma), slip_speed(arc)), {1, rig.force_zero * state.doubt});
    if (pivot != 0) all.must_rise(scaled(double(pivot), arc.theta), {2, rig.turn_zero * state.doubt});
    return !has_forces(arc) ? Verdict::fails : all.verdict();
  };
  // A few terms mostly tell.
  Verdict found = with_contact_arc<3>(rig, trial, cursor.time(), cursor.local<3>(), verdict);
  if (found == Verdict::holds_so_far || found == Verdict::has_not_begun)
    found = with_contact_arc<judge_order>(rig, trial, cursor.time(), cursor.local<judge_order>(), verdict);
  if (found == Verdict::fails || found == Verdict::has_not_begun) return false;
  state = trial;
  return true;
}

bool flies(const Rig& rig, const FloorCursor& cursor, State& state) {
  State trial = state;
  const auto consistent = [&](const auto& flight) {
    AllHold all;
    for_each_witness(rig, trial, flight, all);
    return all.verdict() != Verdict::fails;
  };
  for (const bool released : {true, false}) {
    if (!released && trial.wall == 0) return false;
    trial.released = released && trial.wall != 0;
    settle_kinks(rig, cursor, trial);
    if (with_flight_arc<judge_order>(rig, trial, cursor.time(), cursor.local<judge_order>(), consistent)) {
      state = trial;
      return true;
    }
  }
  return false;
}

bool lifts_off(const Rig& rig, const FloorCursor& cursor, State& state) {
  State trial = state;
  take_off(rig, trial);
  if (!flies(rig, cursor, trial)) return false;
  state = trial;
  return true;
}

int direction(double w) { return w > 0 ? 1 : -1; }

// The foot under legs has no mass: when forces jump, its slip may stop or turn at once.
bool keeps_slipping(const Rig& rig) { return !rig.laws || rig.laws->legs.frequency_radps == 0; }

// Static friction holds a base that stands still, beyond doubt, against a slip in that direction: where round-off keeps every stuck
// mode from standing it does not slip instead.
bool friction_holds(const Rig& rig, const FloorCursor& cursor, State trial, int sigma) {
  trial.mode = Mode::rest;
  trial.pivot = trial.sigma = trial.wall = 0;
  trial.foot = 0;
  settle_kinks(rig, cursor, trial);
  bool holds = false;
  with_contact_arc<1>(rig, trial, cursor.time(), cursor.local<1>(), [&](const auto& arc) {
    for_each_witness(rig, trial, arc, [&](Witness witness, const auto& limit, ZeroTolerance zero) {
      if (witness == (sigma > 0 ? Witness::grip_left : Witness::grip_right)) holds = limit[0] > zero.acceleration;
    });
  });
  return holds;
}

bool choose_flat(const Rig& rig, const FloorCursor& cursor, State& state) {
  const double slip = slip_speed(rig, state);
  if (slip != 0 && stands(rig, cursor, state, Mode::slide, 0, direction(slip))) return true;
  // A slip that goes on while the block tips: before a foot under legs is asked whether it would hold if it stood still.
  if (slip != 0 && rig.can_rock)
    for (const int pivot : {1, -1})
      if (stands(rig, cursor, state, Mode::slide_rock, pivot, direction(slip))) return true;
  const bool any_way = slip == 0 || !keeps_slipping(rig);
  if (any_way) {
    if (stands(rig, cursor, state, Mode::rest, 0, 0)) return true;
    if (!rig.can_slip && lifts_off(rig, cursor, state)) return true;  // before the hinges, which could pull
    if (rig.can_rock)
      for (const int pivot : {1, -1})
        if (stands(rig, cursor, state, Mode::rock, pivot, 0)) return true;
    if (!rig.can_slip) return false;
    for (const int sigma : {1, -1})
      if (!friction_holds(rig, cursor, state, sigma) && stands(rig, cursor, state, Mode::slide, 0, sigma)) return true;
  }
  if (!rig.can_rock || !any_way) return false;
  for (const int pivot : {1, -1})
    for (const int sigma : {1, -1})
      if (sigma != (slip == 0 ? 0 : direction(slip)) && stands(rig, cursor, state, Mode::slide_rock, pivot, sigma))
        return true;
  return false;
}

bool choose_on_corner(const Rig& rig, const FloorCursor& cursor, State& state) {
  const int pivot = state.theta > 0 || (state.theta == 0 && state.omega > 0) ? 1 : -1;
  const double slip = slip_speed(rig, state);
  const bool leans = state.wall != 0;
  if (slip != 0 && stands(rig, cursor, state, Mode::slide_rock, pivot, direction(slip))) return true;
  if (slip != 0 && leans && stands(rig, cursor, state, Mode::slide_rock, pivot, direction(slip), AtWall::pushed))
    return true;
  if (slip != 0 && keeps_slipping(rig)) return false;
  // A foot under legs could jam where the floor lets go of it.
  if (slip != 0 && lifts_off(rig, cursor, state)) return true;
  if (stands(rig, cursor, state, Mode::rock, pivot, 0)) return true;
  if (leans && state.omega == 0 && stands(rig, cursor, state, Mode::rock, pivot, 0, AtWall::pushed)) return true;
  if (!rig.can_slip) return false;
  for (const AtWall at_wall : {AtWall::released, AtWall::pushed})
    for (const int sigma : {1, -1})
      if ((at_wall == AtWall::released || leans) && stands(rig, cursor, state, Mode::slide_rock, pivot, sigma, at_wall))
        return true;
  return false;
}

}  // namespace

bool choose_mode(const Rig& rig, const FloorCursor& cursor, State& state) {
  const bool aloft = state.mode == Mode::flight;
  const bool both_down = !aloft && state.theta == 0 && state.omega == 0;
  if (both_down) state.pivot = 0;
  // The instant of an event is known to the tolerance of the step only, and close to Painleve's paradox its error is
  // amplified: where no mode stands, what counts as zero is widened before the paradox is declared, up to what a step may miss
  // in its accelerations: 1e4 force_zero is 1e-7 g, a hundred tolerances.
  for (state.doubt = 1; state.doubt <= 1e4; state.doubt *= 100) {
    if (aloft) {
      if (flies(rig, cursor, state)) return true;
      continue;
    }
    if (both_down ? choose_flat(rig, cursor, state) : choose_on_corner(rig, cursor, state)) return true;
    if (lifts_off(rig, cursor, state)) return true;
  }
  return false;
}

void take_off(const Rig& rig, State& state) {
  const int pivot = state.theta > 0 || (state.theta == 0 && state.omega > 0) ? 1 : -1;
  Arc<double, 1> arc;
  start_arc(arc, rig.corner(pivot), state.theta, state.omega, state.xi, state.w);
  state.x = rig.offset(pivot) + state.xi + arc.rx[0];
  state.y = arc.ry[0];
  state.vx = state.w + arc.ry[0] * state.omega;
  state.vy = -(arc.rx[0] * state.omega);
  if (rig.laws && state.pivot == 0)
    for (const int side : {1, -1})
      if (touches_upright(rig, state, side)) state.wall = side, state.edge = Edge::face;
  state.mode = Mode::flight;
  state.pivot = state.sigma = 0;
}

}  // namespace freestand::dynamics
