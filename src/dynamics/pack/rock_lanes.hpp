// The trajectories of the samples in the slots of a pool that rocks: from rest to rest, sample after sample.
#pragma once

#include <cmath>
#include <optional>

#include "base/pack.hpp"
#include "base/units.hpp"
#include "dynamics/batch.hpp"
#include "dynamics/pack/corner_constants.hpp"
#include "dynamics/pack/outside.hpp"
#include "dynamics/pack/rock_march.hpp"
#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

constexpr int rock_slots = 112;  // a marching group of 64, and those that wait and hop
static_assert(rock_slots <= march_slots);

// Where the lanes are. Angular velocities are per interval, forces times h^2.
struct RockStates {
  double theta[rock_slots], omega[rock_slots], rx[rock_slots], ry[rock_slots];
  double gravity[rock_slots], push[rock_slots];  // g h^2/J, scale h^2/J
  double weight[rock_slots];                     // scale h^2
  double a[rock_slots];                          // unit record, where the lane is
  double fraction[rock_slots];                   // part of the interval that lies ahead
  double side[rock_slots];                       // +1 right corner, -1 left
  double peak[rock_slots], force2[rock_slots];   // of |theta|; of the squared acceleration
  const double* next[rock_slots];                // a at the end of the interval
};

// What a block needs that rocks in small hops.
struct BothCorners {
  CornerConstants left, right;
  HopBounds bounds;
  explicit BothCorners(const BatchCase& c) : left(c, -1), right(c, 1), bounds(c, left, right) {}
  const CornerConstants& on(double side) const { return side > 0 ? right : left; }
};

class RockLanes {
 public:
  RockLanes(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined)
      : cases_(cases), count_(count), responses_(responses), declined_(declined) {
    for (int slot = 0; slot < rock_slots; ++slot) refill(slot);
  }

 protected:
  // What a lane needs only when something happens.
  struct Lane {
    const BatchCase* sample = nullptr;
    std::size_t number = 0;
    struct Side {
      double arm, gravity, push;  // as in the rows
      double kept;                // of the rate, at the impact that ends the stay on this side
      double hop;                 // rotation of a hop by omega^2
      double rests;               // squared rate below which a block rests that has just come down here
    } left{}, right{};
    double kept = 0, hop_here = 0;  // of the side on which it stands
    int events = 0, impacts = 0;
    double small2 = 0;   // squared rotation up to which hops are small
    double dying = 0;    // no row of hops dies out within `look` intervals that starts faster than this, per interval
    int restless = -1;   // up to this knot the floor pushes too hard for hops to die out
    bool after = false;  // the record is over
    std::optional<BothCorners> corners = {};
  };

  // Knot at which the lane's interval starts; after the record, counted from its end.
  int knot(int i) const {
    const Lane& lane = lanes_[i];
    return static_cast<int>(r_.next[i] - (lane.after ? still_ground : lane.sample->table->acceleration.data())) - 1;
  }

  // The next sample that moves takes the slot.
  void refill(int i) {
    while (taken_ < count_) {
      const std::size_t number = taken_++;
      const BatchCase& c = cases_[number];
      Lane& lane = lanes_[i];
      lane = Lane{
          .sample = &c, .number = number, .left = side_of(c, -c.left, c.right), .right = side_of(c, c.right, -c.left)};
      const double small = HopBounds::small_rotation * smaller(c.left, c.right) / c.h;
      lane.small2 = small * small;
      lane.dying = dying_rate(c, larger(1 - lane.left.kept, 1 - lane.right.kept));
      r_.peak[i] = r_.force2[i] = 0;
      r_.weight[i] = c.scale * c.table->step_s * c.table->step_s;
      if (c.scale == 0) {
        declined_[number] = 1;
        continue;
      }
      ++live_;
      if (leave_rest(i, 0, 0.0)) return;
    }
  }

  double limit(const BatchCase& c, double a) const {  // |a| of the unit record that tips the block
    return (c.scale * a > 0 ? c.left : c.right) * c.g / (c.h * magnitude(c.scale));
  }

  // From rest at knot m (or `done` of the interval later): to the start of rocking, or to the sample's end. True: the
  // lane lives.
  bool leave_rest(int i, int m, double done) {
    Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    const MotionTable& t = *c.table;
    const double* a = t.acceleration.data();
    const double least = (c.left < c.right ? c.left : c.right) * c.g / (c.h * magnitude(c.scale));
    if (m == 0 && done == 0 && magnitude(a[0]) > limit(c, a[0])) {
      start(i, 0, 0.0, a[0] * c.scale > 0 ? -1 : 1);
      return true;
    }
    for (int j = m + 1;; ++j) {
      j = first_above(t, j, least);
      if (j >= t.knots) break;
      const double tips = limit(c, a[j]);
      if (!(magnitude(a[j]) > tips)) continue;
      if (c.left != c.right) feel_rest(i, m, j, done);
      const double limit_here = a[j] > 0 ? tips : -tips, part = (limit_here - a[j - 1]) / (a[j] - a[j - 1]);
      // 1e-11 s late at most, in which the push passes the limit by 1e-9 of what the floor changes in an interval.
      const bool at_knot = part > 1 - 1e-9 && j + 1 < t.knots;
      start(i, at_knot ? j : j - 1, at_knot ? 0.0 : (j - 1 == m && part < done ? done : part),
            a[j] * c.scale > 0 ? -1 : 1);
      return true;
    }
    feel_rest(i, m, t.knots, done);
    finish(i, lane.events > 0 ? Outcome::moved : Outcome::at_rest, t.step_s * (t.knots - 1), 0.0);
    return false;
  }

  // At rest the block feels what the floor does: from `done` of the interval after knot m to knot `end`.
  void feel_rest(int i, int m, int end, double done) {
    const MotionTable& t = *lanes_[i].sample->table;
    const double* a = t.acceleration.data();
    const double unit = r_.weight[i] * r_.weight[i];
    const auto unseen = [&](double peak) { return peak * peak * unit > r_.force2[i]; };
    if (!unseen(t.later_peak[static_cast<std::size_t>(m / table_run)]) || !unseen(bound_between(t, m, end))) return;
    double most = magnitude(done > 0 ? a[m] + (a[m + 1] - a[m]) * done : a[m]);
    if (end == t.knots)
      most = larger(most, peak_from(t, m + 1));
    else
      for (int j = m + 1; j < end; ++j) most = larger(most, magnitude(a[j]));
    r_.force2[i] = larger(r_.force2[i], most * most * unit);
  }

  void start(int i, int m, double done, int side) {
    Lane& lane = lanes_[i];
    const MotionTable& t = *lane.sample->table;
    r_.next[i] = t.acceleration.data() + m + 1;
    const double a = t.acceleration[static_cast<std::size_t>(m)];
    r_.a[i] = a + (*r_.next[i] - a) * done;
    r_.fraction[i] = 1 - done;
    const double f = r_.a[i] * r_.weight[i];
    if (f * f > r_.force2[i]) r_.force2[i] = f * f;
    ++lane.events;
    r_.theta[i] = r_.omega[i] = 0;
    stand_on(i, side);
    go_on(i);
  }

  void stand_on(int i, int side) {
    Lane& lane = lanes_[i];
    const Lane::Side& here = side > 0 ? lane.right : lane.left;
    r_.side[i] = side;
    r_.rx[i] = -here.arm;
    r_.ry[i] = lane.sample->h;
    r_.gravity[i] = here.gravity;
    r_.push[i] = here.push;
    lane.kept = here.kept;
    lane.hop_here = here.hop;
  }

  static Lane::Side side_of(const BatchCase& c, double arm, double other) {
    const double h2 = c.table->step_s * c.table->step_s;
    const double inertia = c.k2 + c.h * c.h + arm * arm, other_inertia = c.k2 + c.h * c.h + other * other;
    const double kept = (c.k2 + c.h * c.h + arm * other) / other_inertia;
    const double hop = inertia / (2 * c.g * magnitude(arm) * h2);
    return {arm, c.g * h2 / inertia,   c.scale * h2 / inertia, c.factor * (kept > 0 ? kept : 0.0),
            hop, c.rest_rotation / hop};
  }

  void finish(int i, Outcome outcome, double time, double theta) {
    const Lane& lane = lanes_[i];
    const BatchCase& c = *lane.sample;
    Response& out = responses_[lane.number];
    const double base = 0.5 * (c.left + c.right), half = sin_outside(0.5 * r_.peak[i]),
                 half_end = sin_outside(0.5 * theta);
    out = Response{};
    out.outcome = outcome;
    out.peak_rotation_rad = r_.peak[i];
    out.residual_rotation_rad = theta;
    out.peak_slip_m = base * 2 * half * half;
    out.residual_slip_m = (theta < 0 ? -base : base) * 2 * half_end * half_end;
    out.peak_acceleration_mps2 = std::sqrt(r_.force2[i]) / (c.table->step_s * c.table->step_s);
    out.impacts = lane.impacts;
    out.events = lane.events;
    out.end_time_s = time;
    declined_[lane.number] = 0;
    --live_;
  }

  void decline(int i) {
    declined_[lanes_[i].number] = 1;
    --live_;
    refill(i);
  }

  // Intervals until the end of the record, or of the still floor after it.
  int free_of(int i) const {
    const Lane& lane = lanes_[i];
    return (lane.after ? still_intervals : lane.sample->table->knots) - 1 - knot(i);
  }

  // The floor stops; the block rocks on.
  void end_record(int i) {
    Lane& lane = lanes_[i];
    const double patience = still_intervals - 2;
    if (lane.after || lane.sample->free_vibration_s > patience * lane.sample->table->step_s) {
      return decline(i);
    }
    feel(i);  // with the last of the record
    lane.after = true;
    r_.a[i] = 0;
    r_.fraction[i] = 1;
    r_.next[i] = still_ground + 1;
    go_on(i);
  }

  // What a block feels where it is.
  void feel(int i) {
    const double omega2 = r_.omega[i] * r_.omega[i], alpha = r_.rx[i] * r_.gravity[i] - r_.ry[i] * r_.push[i] * r_.a[i];
    const double fx = r_.ry[i] * alpha - r_.rx[i] * omega2 + r_.weight[i] * r_.a[i];
    const double fy = r_.rx[i] * alpha + r_.ry[i] * omega2;
    r_.force2[i] = larger(r_.force2[i], fx * fx + fy * fy);
  }

  // A lane as the marching group takes it and gives it back.
  struct Marcher {
    RockLanes& pool;
    int slot;
    void enter(RockRows& rows, int k) const { pool.enter(rows, k, slot); }
    void leave(const RockRows& rows, int k) const { pool.leave(rows, k, slot); }
  };
  void go_on(int i) {
    Marcher marcher{*this, i};
    rocks_.add(marcher, i);
  }

  void enter(RockRows& rows, int k, int i) const {
    const double side = r_.side[i];
    rows.theta[k] = side * r_.theta[i];
    rows.omega[k] = side * r_.omega[i];
    rows.rx[k] = side * r_.rx[i];
    rows.ry[k] = r_.ry[i];
    rows.gravity[k] = r_.gravity[i];
    rows.push[k] = side * r_.push[i];
    rows.weight[k] = side * r_.weight[i];
    rows.a[k] = r_.a[i];
    rows.fraction[k] = r_.fraction[i];
    rows.peak[k] = r_.peak[i];
    rows.force2[k] = r_.force2[i];
    rows.next[k] = r_.next[i];
    rows.stop[k] = r_.next[i] + free_of(i) - 1;
  }
  void leave(const RockRows& rows, int k, int i) {
    const double side = r_.side[i];
    r_.theta[i] = side * rows.theta[k];
    r_.omega[i] = side * rows.omega[k];
    r_.rx[i] = side * rows.rx[k];
    r_.ry[i] = rows.ry[k];
    r_.a[i] = rows.a[k];
    r_.fraction[i] = rows.fraction[k];
    r_.peak[i] = rows.peak[k];
    r_.force2[i] = rows.force2[k];
    r_.next[i] = rows.next[k];
  }

  void to_next_knot(int i) {
    r_.a[i] = *r_.next[i]++;
    r_.fraction[i] = 1;
  }

  static constexpr int look = 16;  // intervals

  // What dies_out asks of a still floor, 2 omega <= (look - 1) h slowing (1 - kept), where it takes half of what an impact loses for
  // 1 - kept; 1e-9 is more than both sides round off.
  static double dying_rate(const BatchCase& c, double most_lost) {
    const double arm = c.left < c.right ? c.left : c.right, longer = c.left < c.right ? c.right : c.left;
    const double h = c.table->step_s, slowing = arm * c.g / (c.k2 + c.h * c.h + longer * longer);
    return 0.25 * (look - 1) * h * h * slowing * most_lost * (1 + 1e-9);
  }

  const BatchCase* cases_;
  std::size_t count_;
  Response* responses_;
  std::uint8_t* declined_;
  std::size_t taken_ = 0;
  RockStates r_;
  Lane lanes_[rock_slots];
  int queue_[rock_slots];
  RockMarch rocks_;
  int waiting_ = 0, live_ = 0;
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
