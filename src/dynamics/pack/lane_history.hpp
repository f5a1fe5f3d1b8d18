// Points of the histories of a pack of samples that go along their steps: HistoryRecorder's, with the same bits.
#pragma once

#include "dynamics/law_arc.hpp"
#include "dynamics/law_rows.hpp"
#include "dynamics/pack/lane_extremes.hpp"
#include "dynamics/pack/outside.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class LaneHistory {
 public:
  explicit LaneHistory(LawRows& rows) : rows_(rows), next_(number(Row::next_output)) {}

  // Those of the lanes `free` that lie within their step of length h from `start` on. u: of the base's midpoint; at: the moment before.
  template <int N>
  void record(unsigned free, const LawArc<N, Pack>& arc, const Series<Pack, N>& u, const Floor<Pack, N>& floor,
              const Standing<Pack>& at, bool lifted, const Pack& start, const Pack& h) {
    while (const unsigned due = free & bits(next_ < start + h)) {
      const PackMask which = lanes_of(due);
      const Pack t = freestand::choose(which, xsimd::max(next_ - start, Pack(0.0)), Pack(0.0)),
                 push = number(Row::push);
      keep(time, start + t);
      keep(floor_acceleration, floor.a.at(t) - push);
      keep(slip, u.at(t));
      keep(slip_velocity, arc.w.at(t));
      keep(rotation, arc.theta.at(t));
      keep(rotation_rate, arc.omega.at(t));
      keep(acceleration, arc.ax.at(t) - push);
      const Series<Pack, N> up = lifted ? combination(Pack(1.0), arc.fy, Pack(1.0), arc.lift) : arc.fy;
      keep(vertical_acceleration, up.at(t) - number(Row::gravity));
      keep(contact_x, arc.fx.at(t));
      keep(contact_y, arc.fy.at(t));
      keep(half_base, at.half_base);
      for (unsigned open = due; open; open &= open - 1) add(__builtin_ctz(open));
      next_ = freestand::choose(which, load(after_), next_);
    }
  }

  // Those lanes have just struck the floor and rock on.
  void rocked_on(unsigned struck, const Pack& struck_at, const Pack& pivot) {
    for (; struck; struck &= struck - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(struck));
      History* history = rows_.history[static_cast<int>(lane)];
      if (!history) continue;
      const double at = struck_at.get(lane), corner = pivot.get(lane);
      clear_upper_parts();
      add_blow(*history, at, static_cast<int>(corner));
    }
  }

  void save() { store(rows_.numbers[static_cast<int>(Row::next_output)], next_); }

 private:
  enum Value {
    time,
    floor_acceleration,
    slip,
    slip_velocity,
    rotation,
    rotation_rate,
    acceleration,
    vertical_acceleration,
    contact_x,
    contact_y,
    half_base,
    value_count
  };
  Pack number(Row row) const { return load(rows_.numbers[static_cast<int>(row)]); }
  void keep(Value which, const Pack& x) { store(value_[which], x); }

  void add(int lane) {
    const int i = lane;
    const auto value = [&](Value which) { return value_[which][lane]; };
    clear_upper_parts();
    HistoryPoint& point = add_point(*rows_.history[i]);
    point.time_s = value(time);
    point.floor_acceleration_mps2 = value(floor_acceleration);
    point.slip_m = value(slip);
    point.slip_velocity_mps = value(slip_velocity);
    point.rotation_rad = value(rotation);
    point.rotation_rate_radps = value(rotation_rate);
    point.mode = rows_.mode[i];
    if (rows_.turns)
      point.slip_velocity_mps += value(half_base) * sin_outside(point.rotation_rad) * point.rotation_rate_radps;
    if (rows_.history[i]->forces) {
      point.acceleration_mps2 = value(acceleration);
      point.vertical_acceleration_mps2 = value(vertical_acceleration);
      point.contact_x_mps2 = value(contact_x);
      point.contact_y_mps2 = value(contact_y);
    }
    after_[lane] = static_cast<double>(++rows_.points[i]) * rows_.numbers[static_cast<int>(Row::output_step)][i];
  }

  LawRows& rows_;
  Pack next_;
  alignas(64) double value_[value_count][pack_lanes];
  alignas(64) double after_[pack_lanes] = {};
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
