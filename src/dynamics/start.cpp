// How a block begins that is on its way when the floor begins to move.
#include <algorithm>
#include <cmath>

#include "dynamics/integration.hpp"
#include "dynamics/law_values.hpp"

namespace freestand::dynamics {

bool can_start(const Specimen& specimen) {
  const Start& start = specimen.start;
  for (const double number : {start.rotation_rad, start.rotation_rate_radps, start.slip_m, start.slip_velocity_mps})
    if (!std::isfinite(number)) return false;
  if (start.upright_at_rest()) return true;
  const bool turns = start.rotation_rad != 0 || start.rotation_rate_radps != 0, slips = start.slip_velocity_mps != 0;
  const bool on_legs = std::any_of(specimen.effects.begin(), specimen.effects.end(),
                                   [](const EffectUse& use) { return static_cast<bool>(use.effect->legs); });
  return std::abs(start.rotation_rad) < 0.5 * pi && !on_legs && specimen.model != Model::bouc_wen &&
         !(turns && specimen.model == Model::slide) && !(slips && specimen.model == Model::rock);
}

void Integration::start_from(const Start& start) {
  state.theta = start.rotation_rad;
  state.omega = start.rotation_rate_radps;
  state.w = start.slip_velocity_mps;
  const double leads = state.theta != 0 ? state.theta : state.omega;
  state.pivot = (leads > 0) - (leads < 0);
  state.xi = start.slip_m;
  state.mode = state.pivot == 0 ? Mode::slide : Mode::slide_rock;
  if (beyond_a_wall()) return stop(Outcome::not_finite);
  if (rig.laws) state.sides = law_values(rig, state, 0, state.w < 0 ? -1 : 1).sides;
  moved_ = state.pivot != 0 || state.w != 0;
  unslid_ = std::abs(start.slip_m);
  peaks.response().peak_slip_m = std::abs(slip());
  peaks.response().peak_rotation_rad = std::abs(start.rotation_rad);
  if (settings.slip_by_side) {
    peaks.response().peak_slip_right_m = std::fmax(slip(), 0.0);
    peaks.response().peak_slip_left_m = std::fmax(-slip(), 0.0);
  }
  if (touches_wall(rig, state) && !meet_walls_too()) return stop_without_mode();
  if (!choose_mode(rig, cursor, state) && !choose_beside_wall()) stop_without_mode();
}

bool Integration::beyond_a_wall() const {
  if (!rig.laws) return false;
  for (const int side : {1, -1})
    for (const Edge edge : {Edge::lower, Edge::upper})
      if (rig.laws->walls.on(side).stands && edge_now(rig, state, side, edge).gap < -touching(rig)) return true;
  return false;
}

}  // namespace freestand::dynamics
