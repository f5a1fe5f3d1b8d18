// What follows an impact of a block that rocks in a pool: it rocks on, hops on in small hops, which go through packs of
// their own (dynamics/pack/hopping.hpp), or rests.
//
// A row of ever smaller hops that the floor cannot interrupt any more is taken at once: the block ends at rest.
#pragma once

#include <limits>

#include "dynamics/pack/hopping.hpp"
#include "dynamics/pack/rock_lanes.hpp"
#include "dynamics/pack/rock_strikes.hpp"
#include "dynamics/row_of_hops.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class RockHops : public RockLanes {
 protected:
  using RockLanes::RockLanes;

  void strike(int i, double omega) {
    r_.theta[i] = 0;
    r_.omega[i] = lanes_[i].kept * omega;
    change_corners(i, omega);
    if (r_.fraction[i] < 1e-12) {
      if (free_of(i) <= 1) return decline(i);
      to_next_knot(i);
    }
    after_impact(i);
  }

  // Impacts of lanes that wait for them. Most rock on; where an impact is not clear, the lane waits for a closer look.
  void strike_all() {
    const int count = striking() < strikes_at_once ? striking() : strikes_at_once;
    OtherCorner other;
    for (int k = 0; k < count; ++k) look_across(other, k, strikes_.lane(k));
    RockStrikes::Struck struck;
    strikes_.strike(other, count, struck);
    for (int k = count; k-- > 0;) {
      const int i = strikes_.lane(k);
      const bool clear = struck.all >> k & 1U;
      if (clear) change_corners(i, struck.rates[k]);
      if (struck.rock >> k & 1U) {
        rocks_.take(strikes_, k);
        continue;
      }
      Marcher marcher{*this, i};
      strikes_.remove(marcher, k);
      if (clear)
        after_impact(i);
      else
        queue_[waiting_++] = i;
    }
  }
  void to_strike(int k) { strikes_.take(rocks_, k); }  // of the marching group
  int striking() const { return strikes_.count(); }

  // One impact or knot for all that hop, if there are any.
  void hop() {
    const std::uint64_t apart = hops_.march();
    for (int k = hops_.count() < 64 ? hops_.count() : 64; k-- > 0;) {
      if (!(apart >> k & 1U)) continue;
      Hopper hopper{*this, hops_.lane(k)};
      hops_.remove(hopper, k);
      const Lane& lane = lanes_[hopper.slot];
      if (lane.events > most_events)
        decline(hopper.slot);
      else if (hopper.ended || hopper.many)
        after_impact(hopper.slot);
      else
        go_on(hopper.slot);
    }
  }
  int hopping() const { return hops_.count(); }

 private:
  using Rows = HopRows<Steady>;

  // A lane as the group of small hops takes it and gives it back.
  struct Hopper {
    RockHops& pool;
    int slot;
    bool ended = false, many = false;
    void enter(Rows& rows, int k) const { pool.enter(rows, k, slot); }
    void leave(const Rows& rows, int k) {
      ended = rows.ended[k] > 0;
      many = rows.hops[k] >= hops_at_once;
      pool.leave(rows, k, slot);
    }
  };

  void change_corners(int i, double omega) {
    Lane& lane = lanes_[i];
    ++lane.events;
    lane.impacts += lane.hop_here * omega * omega >= lane.sample->told_rotation;
    stand_on(i, r_.side[i] > 0 ? -1 : 1);
  }

  void after_impact(int i) {
    const bool rests = ends_hops(i);
    if (rests || dies_out(i)) return come_to_rest(i, rests);
    if (!small_hops(i)) return go_on(i);
    Hopper hopper{*this, i};
    hops_.add(hopper, i);
  }

  // The row of hops that starts here is over.
  bool ends_hops(int i) {
    const Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const double h = c.table->step_s, omega = r_.omega[i], rotation = lane.hop_here * omega * omega;
    return row_is_over(rotation, c.rest_rotation, omega / h, larger(lane.left.kept, lane.right.kept), [&] {
      if (lane.after) return std::numeric_limits<double>::infinity();
      const double time = h * r_.fraction[i];
      const auto given = [&](const CornerConstants& on) {
        const double now = on.pull(c.scale * r_.a[i], 0);
        return given_ahead(now, (on.pull(c.scale * *r_.next[i], 0) - now) / time, time);
      };
      return smaller(given(corners(i).left), given(corners(i).right));
    });
  }
  const BothCorners& corners(int i) {
    std::optional<BothCorners>& there = lanes_[i].corners;
    return there ? *there : there.emplace(*lanes_[i].sample);
  }

  void come_to_rest(int i, bool rests) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const double rate = r_.omega[i];
    if (rests && rate != 0) feel_row_of_hops(i);
    if (lane.after) {
      const double after = c.table->step_s * (knot(i) + 1 - r_.fraction[i]) + row_lasts(i, rate, 0);
      if (after > c.free_vibration_s) return decline(i);
      finish(i, Outcome::moved, c.table->step_s * (c.table->knots - 1) + after, 0.0);
      return refill(i);
    }
    const double a = r_.a[i];
    if (rests && magnitude(a) > limit(c, a)) {
      r_.omega[i] = 0;
      stand_on(i, a * c.scale > 0 ? -1 : 1);
      return go_on(i);
    }
    if (!leave_rest(i, knot(i), 1 - r_.fraction[i])) refill(i);
  }

  // As in dynamics/small_hops.cpp.
  void feel_row_of_hops(int i) {
    const Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const double rate = r_.omega[i], here = r_.a[i];
    r_.omega[i] = 0;
    feel_on_both(i);
    if (lane.after) return;
    const double left = c.table->step_s * r_.fraction[i];
    const auto floor = [&](double time) { return here + (*r_.next[i] - here) * (time / left); };
    const double lasts = lasts_on_changing_floor(row_lasts(i, rate, here), left,
                                                 [&](double time) { return row_lasts(i, rate, floor(time)); });
    if (!(lasts > 0 && lasts < left)) return;
    r_.a[i] = floor(lasts);
    feel_on_both(i);
    r_.a[i] = here;
  }
  // On a floor that keeps its acceleration a, of the unit record.
  double row_lasts(int i, double rate, double a) {
    const BatchCase& c = *lanes_[i].sample;
    const CornerConstants &on = corners(i).on(r_.side[i]), &other = corners(i).on(-r_.side[i]);
    return lasts_in_all(magnitude(rate) / c.table->step_s, on.pull(c.scale * a, 0), on.kept, other.pull(c.scale * a, 0),
                        other.kept);
  }
  // Ends on the corner where it began.
  void feel_on_both(int i) {
    const int side = r_.side[i] > 0 ? 1 : -1;
    feel(i);
    stand_on(i, -side);
    feel(i);
    stand_on(i, side);
  }

  // The hops that follow end before the floor could make one larger: then they are counted, and the block rests.
  bool dies_out(int i) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    if (magnitude(r_.omega[i]) > lane.dying) return false;
    const int m = knot(i);
    if (lane.hop_here * r_.omega[i] * r_.omega[i] >= c.told_rotation || (!lane.after && m <= lane.restless))
      return false;
    const double h = c.table->step_s, omega = magnitude(r_.omega[i]) / h;
    const double arm = c.left < c.right ? c.left : c.right, longer = c.left < c.right ? c.right : c.left;
    const double small = c.k2 + c.h * c.h + arm * arm, large = c.k2 + c.h * c.h + longer * longer;
    const double push = lane.after ? 0.0 : magnitude(c.scale) * bound_between(*c.table, m, m + 1 + look);
    const auto slowing = [&](double a) { return (arm * c.g - c.h * a) / large; };
    const auto too_hard = [&](double a) { return !(slowing(a) > 0.1 * arm * c.g / large); };
    if (too_hard(push)) {
      int run = (m + look) / table_run;
      while (!too_hard(magnitude(c.scale) * c.table->run_peak[static_cast<std::size_t>(run)])) --run;
      lane.restless = run * table_run + table_run - 1;
      return false;
    }
    const double slow = slowing(push);
    const double kept = 0.5 * (1 + lane.kept);
    if (2 * omega > (look - 1) * h * slow * (1 - kept)) return false;
    if (!lane.after && m + 1 + look >= c.table->knots) return false;  // on the still floor it counts how long they last
    const double rotation = omega * omega / (2 * slow);
    if (rotation > r_.peak[i] || rotation * c.h > (lane.after ? 1e-5 : 1e-3) * arm)
      return false;  // as in SlideRockHops::unnoticed
    const double fast = (longer * c.g + c.h * push) / small;
    const double fx = push * magnitude(1 - c.h * c.h / large) + c.h * longer * c.g / small + 2 * c.h * omega * omega;
    const double fy = longer * fast + 2 * c.h * omega * omega;
    if ((fx * fx + fy * fy) * (h * h * h * h) > r_.force2[i]) return false;
    // Within one hop the field changes by a factor of 1 + change at most, and with it the squared rate.
    const double jump = lane.after ? 0.0 : largest(c.table->margin.data() + m, look + 1) * (8 / h);
    const double change = magnitude(c.scale) * jump * c.h / small * 2 * omega / (h * slow * slow);
    if (lane.kept * lane.kept * (1 + change) > kept * kept) return false;
    lane.events += hops_to_rest(i);
    return true;
  }

  // How many hops in a steady field are left until one is too small to tell.
  int hops_to_rest(int i) const {
    const Lane& lane = lanes_[i];
    const double ratio = lane.sample->rest_rotation / (lane.hop_here * r_.omega[i] * r_.omega[i]);
    const double kept = lane.left.kept * lane.right.kept;  // of the rotation, hop by hop
    return kept > 0 && ratio < 1 ? static_cast<int>(std::ceil(log_outside(ratio) / log_outside(kept))) : 1;
  }

  // The corner on which the lane does not stand.
  void look_across(OtherCorner& other, int k, int i) const {
    const Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const bool right = r_.side[i] > 0;
    const Lane::Side& there = right ? lane.left : lane.right;
    other.kept[k] = lane.kept;
    other.arm[k] = right ? c.left : c.right;
    other.height[k] = c.h;
    other.gravity[k] = there.gravity;
    other.push[k] = right ? -there.push : there.push;
    other.rests[k] = there.rests;
    other.dying[k] = lane.dying;
    other.small2[k] = lane.small2;
  }

  // ---- small hops
  // Are the hops from here on so small that their series (dynamics/pack/hop_series.hpp) is as good as that of rocking, and
  // no new peaks? The limit 1e-3 is that of SlideRockHops.
  bool small_hops(int i) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const double h = c.table->step_s, rate = r_.omega[i] / h, square = rate * rate, a = c.scale * r_.a[i];
    const double pull = corners(i).on(r_.side[i]).pull(a, 0);
    return square * square < limit2(i) * pull * pull && lane.corners->bounds.fast * c.g * h * h < 1e-3 &&
           magnitude(a) <= largest_push(i) && free_of(i) > 0;
  }

  // Four times the squared rotation up to which hops are small.
  double limit2(int i) const {
    const double most = lanes_[i].corners->bounds.limit2, peak2 = r_.peak[i] * r_.peak[i];
    return 4 * (peak2 < most ? peak2 : most);
  }

  // Of the floor, so that small hops are no new peak of the acceleration and it tips the block nowhere.
  double largest_push(int i) const {
    const BatchCase& c = *lanes_[i].sample;
    const HopBounds& b = lanes_[i].corners->bounds;
    const double h2 = c.table->step_s * c.table->step_s, more = small_share * c.g;
    return smaller(b.unseen_push(b.fx + more, b.lift + more, r_.force2[i] / (h2 * h2)), b.tips);
  }

  void enter(Rows& rows, int k, int i) const {
    const Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const double h2 = c.table->step_s * c.table->step_s, side = r_.side[i];
    rows.theta[k] = 0;
    rows.omega[k] = side * r_.omega[i];
    rows.side[k] = side;
    rows.a[k] = r_.a[i];
    rows.slope[k] = 0;
    rows.fraction[k] = r_.fraction[i];
    rows.next[k] = r_.next[i];
    rows.stop[k] = r_.next[i] + free_of(i) - 1;
    for (const int right : {0, 1}) rows.stand(right, k, right ? lane.corners->right : lane.corners->left, c.scale, h2);
    rows.limit2[k] = limit2(i);
    rows.push[k] = largest_push(i) / magnitude(c.scale);
    rows.hops[k] = rows.impacts[k] = rows.ended[k] = 0;
  }

  void leave(const Rows& rows, int k, int i) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    stand_on(i, rows.side[k] > 0 ? 1 : -1);
    const double side = r_.side[i], size = rows.theta[k];
    r_.next[i] = rows.next[k];
    r_.fraction[i] = rows.fraction[k];
    r_.a[i] = rows.a[k];
    r_.theta[i] = side * size;
    r_.omega[i] = side * rows.omega[k];
    const double sine = r_.theta[i] * (1 - size * size * (1.0 / 6)), lost = 0.5 * size * size, arm = -r_.rx[i];
    r_.rx[i] = c.h * sine - arm * (1 - lost);
    r_.ry[i] = arm * sine + c.h * (1 - lost);
    lane.events += static_cast<int>(rows.hops[k]);
    lane.impacts += static_cast<int>(rows.impacts[k]);
  }

  static constexpr int most_events = 10000;
  static constexpr double small_share = 0.002;  // of gravity: what small rotations add to the forces

  RockStrikes strikes_;
  Hopping<Steady> hops_;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
