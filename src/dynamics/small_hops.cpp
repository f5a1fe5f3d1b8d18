// What a block feels in the endless row of ever smaller hops with which it comes to stand on both corners.
//
// Which of its hops are gone through is a matter of the tolerance; the row belongs to the motion, and its accelerations to the
// largest one. In the limit of small hops all that start on one corner are alike, so that two of them tell, one on either corner.
#include <limits>

#include "dynamics/impact.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/row_of_hops.hpp"
#include "dynamics/wall.hpp"

namespace freestand::dynamics {

bool Integration::strike_floor() {
  state.still_since = cursor.time();
  const State from = state;
  if (!strike(rig, state, cursor)) return false;
  if (state.omega != 0 || within_reach_of_wall(rig, state, beside_wall(rig))) return true;
  HopRow row{from.omega, from.w};
  const auto two_hops = [&](HopRow& at) { return feel_two_hops(from, at); };
  if (slip_speed(rig, from) == 0 || slip_speed(rig, state) != 0) {
    if (two_hops(row)) feel_end_of_row(from, row);
    return true;
  }
  const double after = slip_after_stops(row, two_hops);
  if (cursor.motion_over()) hops_end_ = cursor.time() + row.lasts;
  if (after != 0) leave_row(after, row.lasts);
  return true;
}

// The block slides as it does when the row is over, and has done so since before it: nothing else tells of the time that it took.
void Integration::leave_row(double slip, double lasted) {
  State slid = state;
  slid.mode = Mode::slide;
  slid.sigma = slip > 0 ? 1 : -1;
  slid.w = slid.foot = slip;
  with_contact_arc<1>(rig, slid, cursor.time(), cursor.local<1>(),
                      [&](const auto& arc) { slid.w -= lasted * arc.w[1]; });
  if (slid.sigma * slid.w > 0) state.w = state.foot = slid.w;
}

// The floor moves on while the row lasts. row: after its first two hops.
void Integration::feel_end_of_row(const State& from, const HopRow& row) {
  const FloorCursor here = cursor;
  const auto two_hops_later = [&](double time, bool felt) {
    HopRow later{from.omega, from.w, felt};
    cursor = here;
    cursor.advance(time);
    const bool hops = feel_two_hops(from, later);
    cursor = here;
    return hops ? lasts_in_all(from.omega, later) : std::numeric_limits<double>::infinity();
  };
  const double now = lasts_in_all(from.omega, row);
  if (cursor.motion_over() || !(now > 0)) {
    hops_end_ = cursor.time() + now;
    return;
  }
  const double left = cursor.left();
  const double lasts = lasts_on_changing_floor(now, left, [&](double time) { return two_hops_later(time, false); });
  if (lasts < left) two_hops_later(lasts, true);
}

// The corner of `hop` that is raised strikes. False: no two hops follow.
bool Integration::feel_two_hops(State hop, HopRow& row) {
  hop.omega = row.rate;
  hop.w = row.slip;
  for (int i = 0; i < 2; ++i)
    if (!strike_and_hop(rig, hop, cursor.time()) || !feel_hop(hop, row)) return false;
  row.rate = hop.omega;
  row.slip = hop.w;
  return true;
}

// False: it does not come down. Accelerations stay as they are until a slip ends or turns: on a floor that does not change.
bool Integration::feel_hop(State& hop, HopRow& row) {
  constexpr int pieces = 3;  // a slip ends, and turns
  Floor<double, 2> steady{Series<double, 2>::zero(), Series<double, 2>::zero()};
  const Floor<double, 2> here = cursor.local<2>();
  steady.a[0] = here.a[0];
  steady.g[0] = here.g[0];
  for (int i = 0; i < pieces; ++i) {
    row.stops = row.stops || slip_speed(rig, hop) == 0;
    if (!choose_mode(rig, cursor, hop) || hop.pivot == 0) return false;
    bool slips_on = true;
    const bool goes_on = with_contact_arc<2>(rig, hop, cursor.time(), steady, [&](const auto& arc) {
      if (row.felt) peaks.observe(rig, hop, arc, 0);
      const double fall = fall_time(hop.pivot, arc.theta), stops = -slip_speed(arc)[0] / slip_speed(arc)[1];
      slips_on = hop.sigma == 0 || !(stops > 0 && stops < fall);
      const double time = slips_on ? fall : stops;
      if (!(time < cursor.left())) return false;  // the floor decides what becomes of it
      go_to(rig, hop, arc, time);
      row.lasts += time;
      return true;
    });
    if (slips_on || !goes_on) return goes_on;
    stand_still(rig, hop);
  }
  return false;
}

}  // namespace freestand::dynamics
