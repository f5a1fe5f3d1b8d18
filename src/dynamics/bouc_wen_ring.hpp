// The end of a sample with a Bouc-Wen contact: the floor is still, and the block rings on its contact.
//
// Nothing but the contact takes energy from the ringing, and below its yield it takes less and less: the ringing of
// exponent n dies as t^(-1/n), never quite. But since the law does not know time, each half swing follows from the one
// before by its energy alone. A swing that turns at |zeta| = m swings through zero and turns at m' on the other side:
//
//   J_1(m') = J_kappa(m),   J_f(m) = int_0^m zeta dzeta/(1 - f zeta^n) = m^2 sum_j (f q)^j/(j n + 2),   q = m^n
//   slip:  y (Xi_kappa(m) - m  +  Xi_1(m') - m'),   Xi_f(m) = int_0^m dzeta/(1 - f zeta^n) = m sum_j (f q)^j/(j n + 1)
//
// The slip that remains after all swings to come, of alternating signs, is m times a power series in q, from the
// functional equation S(m) = D(m) - S(m'), D the slip of one swing.
#pragma once

#include "dynamics/bouc_wen_contact.hpp"

namespace freestand::dynamics {

struct RingOut {
  double slip_m = 0;   // in the direction of the next swing, all swings to come
  double reach_m = 0;  // u at the end of the first swing, relative to u_p at its start, in the direction of the swing
  double second_reach_m = 0;  // the same at the end of the second, in the direction of the second
};

// The swings converge in closed form from here on.
bool can_ring_out(const BoucWenContact& contact, double q);

// The block turns at |zeta| = turn, the floor is still and level. Asks for can_ring_out().
RingOut ring_out(const BoucWenContact& contact, double turn);

// One half swing: |zeta| at its end, and u_p's change over it in its direction, over y.
struct Swing {
  double turn, slip;
};
Swing next_swing(const BoucWenContact& contact, double turn);

}  // namespace freestand::dynamics
