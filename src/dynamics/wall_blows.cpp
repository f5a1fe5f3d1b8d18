// Blows of walls, and edges that stay at one.
#include <cmath>

#include "dynamics/impact.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/wall.hpp"

namespace freestand::dynamics {
namespace {

// Of a side face that comes flat each edge throws the other one at the wall, ever more slowly, until it lies against it. A blow
// at arm l of the centre of mass gives the edge at arm l' on its other side |l l' - k^2|/(k^2 + l^2) of the speed: so many blows
// leave a millionth, and twenty of a uniform block, of which each leaves a half at most. What is left then lies against it, as
// it would after the last of them.
int blows_of_a_face(const Rig& rig) {
  const double upper = rig.top - rig.h, lower = rig.h, k2 = rig.k2;
  const double left = std::abs(upper * lower - k2) / std::sqrt((k2 + upper * upper) * (k2 + lower * lower));
  constexpr double of_uniform = 20, millionth = 1e-6, most = 1e4;
  return static_cast<int>(left > 0.5 ? std::fmin(std::ceil(std::log(millionth) / std::log(left)), most) : of_uniform);
}

}  // namespace

bool Integration::meet_wall(int side, Edge edge) {
  double speed = 0;
  if (!strike_wall(rig, state, side, edge, cursor.time(), speed)) return false;
  if (speed < rig.told_speed) return true;
  ++peaks.response().wall_hits;
  peaks.response().wall_speed_mps = std::max(peaks.response().wall_speed_mps, speed);
  return true;
}

// The edge is free to meet that wall, no further off than this, and comes faster than that.
bool Integration::reaches_wall(int side, Edge edge, double within, double faster_than) const {
  const bool stays = state.at_wall() && state.is_by(side, edge);
  if (!rig.laws->walls.on(side).stands || !is_next_to(edge, side) || stays) return false;
  const EdgeNow now = edge_now(rig, state, side, edge);
  return now.gap <= within && now.speed > faster_than;
}

// What a blow has turned towards a wall that it touches meets that wall at once.
bool Integration::meet_walls_too() {
  const int most = blows_of_a_face(rig);
  for (const int side : sides(state)) {
    bool met = true;
    for (int pass = 0; met && pass < most; ++pass) {
      met = false;
      for (const Edge edge : {Edge::upper, Edge::lower}) {
        if (!reaches_wall(side, edge, touching(rig), -rig.slow())) continue;
        if (!meet_wall(side, edge)) return false;
        met = true;
      }
    }
    if (met && state.mode == Mode::flight) lie_against(side);
  }
  return true;
}

// An edge has reached its wall at this very instant, and comes on.
bool Integration::comes_through_wall() const {
  for (const int side : sides(state))
    for (const Edge edge : {Edge::upper, Edge::lower})
      if (reaches_wall(side, edge, 0, rig.slow())) return true;
  return false;
}

// In flight either edge may meet the wall, on the floor the one next to it.
bool Integration::is_next_to(Edge edge, int side) const {
  if (state.mode == Mode::flight) return true;
  return state.pivot == 0 ? edge == Edge::lower : edge == touching_edge(state.pivot, side);
}

void Integration::lie_against(int side) {
  state.theta = state.omega = state.vx = 0;
  state.x = side * rig.laws->walls.on(side).gap_m;
  state.wall = side;
  state.edge = Edge::face;
  state.released = false;
}

// The edge beside a wall touches it and neither comes nor leaves.
bool Integration::rests_at_wall(int side) {
  if (!rig.laws || !rig.laws->walls.on(side).stands || state.wall != 0) return false;
  const auto rests = [&](Edge edge) {
    const EdgeNow now = edge_now(rig, state, side, edge);
    return now.gap <= touching(rig) && std::abs(now.speed) <= rig.slow();
  };
  Edge edge = touching_edge(state.pivot, side);
  if (state.mode == Mode::flight) {
    const bool lower = rests(Edge::lower), upper = rests(Edge::upper);
    if (lower && upper) {
      lie_against(side);
      return true;
    }
    edge = upper ? Edge::upper : Edge::lower;
  }
  if (!rests(edge)) return false;
  state.wall = side;
  state.edge = edge;
  return true;
}

}  // namespace freestand::dynamics
