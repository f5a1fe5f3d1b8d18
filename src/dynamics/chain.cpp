#include "dynamics/chain.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::dynamics {
namespace {

// forces per mass; wall_gap: below 0 where no wall stands; along: cos(beta)
enum : std::size_t { stiffness, strength, slack, side, height, half_width, wall_gap, number, along, damping };

// Displacement of the chains' point towards the side that is held back, in the direction of a chain, less the slack.
Value stretch(const At& at, const Parameters& p) {
  const double s = p[along] * p[side];
  return s * (at.u + p[height] * sin(at.theta)) - p[along] * p[half_width] * (cos(at.theta) - 1.0) - p[slack];
}

Value stretch_rate(const At& at, const Parameters& p) {
  const double s = p[along] * p[side];
  return s * (at.v + p[height] * cos(at.theta) * at.omega) + p[along] * p[half_width] * sin(at.theta) * at.omega;
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

// Arm: height of the chain's point over the centre of mass, which effects may have moved off the middle of the base.
Value moment(const At& at, const Parameters& p) {
  const double middle = 0.5 * (at.block.right_m - at.block.left_m);  // from the centre of mass
  const double across = middle - p[side] * p[half_width], above = p[height] - at.block.height_m;
  return (above * cos(at.theta) - across * sin(at.theta)) * force(at, p);
}

void wall(Walls& walls, const Parameters& p) {
  if (p[wall_gap] >= 0) walls.stand(p[side] > 0 ? -1 : 1, p[wall_gap], 0);
}

const Effect& law() {
  static const Effect effect{.name = "chain",
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
  return effect;
}

}  // namespace

EffectUse use(const Chain& chain, const Block& block) {
  return {&law(),
          {chain.stiffness_npm / block.mass_kg, std::min(chain.strength_n / block.mass_kg, 1e300), chain.slack_m,
           static_cast<double>(chain.side), chain.height_m, block.half_base_m(), chain.wall_gap_m.value_or(-1),
           chain.number, std::cos(chain.plan_angle_rad), chain.damping_nspm / block.mass_kg}};
}

}  // namespace freestand::dynamics
