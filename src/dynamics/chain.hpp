// A chain from the block's top to the wall behind it: a one-sided spring with slack, and a connection that can fail.
// [KM05 ch. 9]
//
//   wall |~~~~~~~~~o_____        stretch = s (u + z sin(theta) - s b (cos(theta) - 1)) - |slack|,  s = side held back
//        |         |     |       P = k max(stretch, 0) until P exceeds the strength; then the connection has failed and
//        |         |     |           nothing holds any more
//        |         |_____|       force -s P at the chain's point: it pulls at the block, and turns it
//
// z: height of the chain's point over the base, at the block's face towards the wall. A block that moves or tips towards the
// wall meets it.
#pragma once

#include <optional>

#include "dynamics/effect.hpp"

namespace freestand::dynamics {

struct Chain {
  double slack_m = 0;                     // >= 0
  double stiffness_npm = 0;               // N/m
  double strength_n = 0;                  // of the connection; infinity: never fails
  double height_m = 0;                    // z
  int side = 1;                           // +1: holds the block back when it moves to the right
  std::optional<double> wall_gap_m = {};  // to the wall behind, which gives nothing back; none: no wall is met
};

// The chain as a law of the equations of motion, at the face of the block as it is given: effects that crush corners or
// move the centre of mass leave it there. The use refers to a declaration that lasts as long as the program.
EffectUse use(const Chain&, const Block&);

}  // namespace freestand::dynamics
