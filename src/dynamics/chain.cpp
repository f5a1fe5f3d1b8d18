#include "dynamics/chain.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::dynamics {
namespace {

// forces per mass; wall_gap: below 0 where no wall stands; along: cos(beta) cos(gamma), up: sin(gamma)
enum : std::size_t { stiffness, strength, slack, side, height, half_width, wall_gap, number, along, damping, up };

// Displacement of the chains' point towards the side that is held back, in the direction of a chain, less the slack.
Value stretch(const At& at, const Parameters& p) {
  const double s = p[along] * p[side];
  const Value level =
      s * (at.u + p[height] * sin(at.theta)) - p[along] * p[half_width] * (cos(at.theta) - 1.0) - p[slack];
  if (p[up] == 0) return level;
  return level - p[up] * (at.rise + p[height] * (cos(at.theta) - 1.0) + p[side] * p[half_width] * sin(at.theta));
}

Value stretch_rate(const At& at, const Parameters& p) {
  const double s = p[along] * p[side];
  const Value level =
      s * (at.v + p[height] * cos(at.theta) * at.omega) + p[along] * p[half_width] * sin(at.theta) * at.omega;
  if (p[up] == 0) return level;
  const Value turns = p[side] * p[half_width] * cos(at.theta) - p[height] * sin(at.theta);
  return level - p[up] * (at.climb + turns * at.omega);
}

// Of one chain that has not failed.
Value pull_if_whole(const At& at, const Parameters& p) {
  const Value stretched = stretch(at, p);
  if (p[damping] == 0) return p[stiffness] * positive(stretched);
  const Value pulled = positive(p[stiffness] * stretched + p[damping] * stretch_rate(at, p));
  return where(stretched, pulled, 0.0 * pulled);
}

// Of one chain, until its connection fails.
Value tension(const At& at, const Parameters& p) {
  const Value pull = pull_if_whole(at, p);
  return pull * latch(p[strength] - pull);
}

Value force(const At& at, const Parameters& p) { return -(p[side] * p[number] * p[along]) * tension(at, p); }

Value lift(const At& at, const Parameters& p) { return p[number] * p[up] * tension(at, p); }

// Arms: of the chain's point over and beside the centre of mass, which effects may have moved off the middle of the base.
Value moment(const At& at, const Parameters& p) {
  const double middle = 0.5 * (at.block.right_m - at.block.left_m);  // from the centre of mass
  const double across = middle - p[side] * p[half_width], above = p[height] - at.block.height_m;
  const Value of_force = (above * cos(at.theta) - across * sin(at.theta)) * force(at, p);
  if (p[up] == 0) return of_force;
  return of_force - (across * cos(at.theta) + above * sin(at.theta)) * lift(at, p);
}

void wall(Walls& walls, const Parameters& p) {
  if (p[wall_gap] >= 0) walls.stand(p[side] > 0 ? -1 : 1, p[wall_gap], 0);
}

const Effect& law(bool level) {
  static const Effect along_the_floor{
      .name = "chain",
      .summary = "A chain from the block's top to the wall behind it",
      .law = "P = k (stretch beyond the slack) + c (its rate), until P exceeds the strength",
      .source = "[KM05 ch. 9]",
      .suspect = "",
      .parameters = {},
      .force = force,
      .moment = moment,
      .tension = tension,
      .strength = [](const Parameters& p) { return p[strength]; },
      .wall = wall};
  static const Effect at_an_angle = [] {
    Effect effect = along_the_floor;
    effect.lift = lift;
    return effect;
  }();
  return level ? along_the_floor : at_an_angle;
}

}  // namespace

EffectUse use(const Chain& chain, const Block& block) {
  return {&law(chain.elevation_rad == 0),
          {chain.stiffness_npm / block.mass_kg, std::min(chain.strength_n / block.mass_kg, 1e300), chain.slack_m,
           static_cast<double>(chain.side), chain.height_m, block.half_base_m(), chain.wall_gap_m.value_or(-1),
           chain.number, std::cos(chain.plan_angle_rad) * std::cos(chain.elevation_rad),
           chain.damping_nspm / block.mass_kg, std::sin(chain.elevation_rad)}};
}

}  // namespace freestand::dynamics
