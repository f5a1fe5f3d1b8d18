// Chains from the block's top to the wall behind it: one-sided springs with slack, and connections that can fail.
// [KM05 ch. 9]
//
//   wall |~~~~~~~~~o_____        x = s (u + z sin(theta)) - b (cos(theta) - 1), y = rise + z (cos(theta) - 1) + s b sin(theta): of
//        |         |     |           the chains' point, s = side held back
//        |         |     |       stretch = x cos(beta) cos(gamma) - y sin(gamma) - slack
//        |         |_____|       P = k stretch + c d(stretch)/dt, where it is stretched and pulls, in each of n chains, until P
//                                    exceeds the strength; then the connections have failed and nothing holds any more
//                                forces -s n P cos(beta) cos(gamma) along the floor and n P sin(gamma) up, at the chains' point
//
// z: height of the chains' point over the base, at the block's face towards the wall. beta: in plan, to the direction of the
// shaking; chains at an angle come in pairs that cross, whose pulls across cancel. gamma: to the horizontal, above 0 where the
// chain rises towards the wall and so takes weight off the floor. Their directions stay as they are: chains are long. A block
// that moves or tips towards the wall meets it.
#pragma once

#include <optional>

#include "dynamics/effect.hpp"

namespace freestand::dynamics {

struct Chain {
  double slack_m = 0;                     // >= 0
  double stiffness_npm = 0;               // of each, N/m
  double strength_n = 0;                  // of each connection; infinity: never fails
  double height_m = 0;                    // z
  int side = 1;                           // +1: holds the block back when it moves to the right
  double number = 1;                      // n, all stretched alike
  double plan_angle_rad = 0;              // beta
  double elevation_rad = 0;               // gamma, within pi/2
  double damping_nspm = 0;                // c, of each, N s/m
  std::optional<double> wall_gap_m = {};  // to the wall behind, which gives nothing back; none: no wall is met
};

// The chain as a law of the equations of motion, at the face of the block as it is given: effects that crush corners or
// move the centre of mass leave it there. The use refers to a declaration that lasts as long as the program.
EffectUse use(const Chain&, const Block&);

}  // namespace freestand::dynamics
