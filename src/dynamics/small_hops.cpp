// What a block feels in the endless row of ever smaller hops with which it comes to stand on both corners.
//
// Which of its hops are gone through is a matter of the tolerance; the row belongs to the motion, and its accelerations to the
// largest one. In the limit of small hops all that start on one corner are alike, so that two of them tell, one on either corner.
#include "dynamics/impact.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/wall.hpp"

namespace freestand::dynamics {

bool Integration::strike_floor() {
  const State from = state;
  if (!strike(rig, state, cursor.time(), cursor.local<1>())) return false;
  if (state.omega != 0 || within_reach_of_wall(rig, state, beside_wall(rig))) return true;
  feel_row_of_hops(from);
  if (slip_speed(rig, from) == 0 || slip_speed(rig, state) != 0) return true;
  State stuck = from;  // its slip ends within the row
  stand_still(rig, stuck);
  feel_row_of_hops(stuck);
  return true;
}

// The corner of `hop` that is raised strikes.
void Integration::feel_row_of_hops(State hop) {
  constexpr int hops = 2;
  for (int i = 0; i < hops; ++i)
    if (!strike_and_hop(rig, hop, cursor.time()) || !feel_hop(hop)) return;
}

// False: it does not come down. Accelerations stay as they are until a slip ends or turns.
bool Integration::feel_hop(State& hop) {
  constexpr int pieces = 3;  // a slip ends, and turns
  for (int i = 0; i < pieces; ++i) {
    if (!choose_mode(rig, cursor, hop) || hop.pivot == 0) return false;
    bool slips_on = true;
    const bool comes_down = with_contact_arc<2>(rig, hop, cursor.time(), cursor.local<2>(), [&](const auto& arc) {
      peaks.observe(rig, hop, arc, 0);
      const double fall = fall_time(hop.pivot, arc.theta), stops = -slip_speed(arc)[0] / slip_speed(arc)[1];
      slips_on = hop.sigma == 0 || !(stops > 0 && stops < fall);
      if (std::isfinite(fall)) go_to(rig, hop, arc, slips_on ? fall : stops);
      return std::isfinite(fall);
    });
    if (slips_on) return comes_down;
    stand_still(rig, hop);
  }
  return false;
}

}  // namespace freestand::dynamics
