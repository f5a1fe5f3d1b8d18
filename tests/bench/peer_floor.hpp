// The floor under one sample of a peer, in pieces between knots. `offset`: time from the knot before.
#pragma once

#include <cmath>
#include <freestand/floor_motion.hpp>
#include <limits>

#include "base/units.hpp"

namespace freestand::bench {

constexpr double after_motion_s = 60;

// A record: knots at i * dt, linear between them, values scaled as they are read; steps are equal parts of a piece.
class RecordFloor {
 public:
  RecordFloor(const Shaking& shaking, double push, double gravity, double vertical_scale, int steps_per_knot)
      : values_(shaking.motion->horizontal_mps2.data()),
        vertical_(vertical_scale != 0 ? shaking.motion->vertical_mps2.data() : nullptr),
        scale_(shaking.scale),
        vertical_scale_(vertical_scale),
        push_(push),
        gravity_(gravity),
        dt_(shaking.motion->knot_s[1]),
        longest_(dt_ / steps_per_knot),
        count_(static_cast<int>(shaking.motion->segments())),
        last_(count_ + static_cast<int>(after_motion_s / dt_)) {
    read();
  }
  double offset = 0;

  bool over() const { return knot_ >= count_; }  // the motion
  bool ended() const { return knot_ >= last_; }  // the sample
  double left() const { return dt_ - offset; }
  double time() const { return knot_ * dt_ + offset; }
  double step() const { return left() < 1.001 * longest_ ? left() : longest_; }
  // True: at a knot, where the rates may jump.
  bool go(double h, double end) {
    if (h < left()) return offset = end, false;
    next_knot();
    return knot_ == count_;
  }
  void next_knot() {
    ++knot_;
    offset = 0;
    read();
  }
  double a(double t) const { return a0_ + da_ * t; }
  double g(double t) const { return g0_ + dg_ * t; }

  // Where the first of margins that change linearly with a and g gets below zero. False: none ever does, the floor ends. True
  // with `which` = -1: it was below zero at the start already.
  template <class Margins>
  bool wait(Margins&& margins, double& peak, int& which) {
    for (; !over(); next_knot()) {
      const auto begin = margins(a(offset), g(offset)), end = margins(a(dt_), g(dt_));
      peak = std::fmax(peak, std::fmax(std::abs(a(offset)), std::abs(a(dt_))));
      double first = std::numeric_limits<double>::infinity();
      for (int i = 0; i < static_cast<int>(begin.size()); ++i) {
        if (begin[i] < -1e-12) return which = -1, true;
        if (end[i] >= 0) continue;
        const double part = std::fmax(begin[i], 0.0) / (std::fmax(begin[i], 0.0) - end[i]);
        if (part < first) first = part, which = i;
      }
      if (first <= 1) return offset += first * left(), true;
    }
    const auto still = margins(a(0), g(0));
    for (const double margin : still)
      if (margin < -1e-12) return which = -1, true;
    return false;
  }

 private:
  void read() {
    const bool moves = knot_ < count_;
    a0_ = push_ + (moves ? scale_ * values_[2 * knot_] : 0.0);
    da_ = moves ? scale_ * values_[2 * knot_ + 1] : 0.0;
    g0_ = gravity_ + (moves && vertical_ ? vertical_scale_ * vertical_[2 * knot_] : 0.0);
    dg_ = moves && vertical_ ? vertical_scale_ * vertical_[2 * knot_ + 1] : 0.0;
  }
  const double *values_, *vertical_;  // a, slope; a, slope; ...
  double scale_, vertical_scale_, push_, gravity_, dt_, longest_;
  int count_, last_, knot_ = 0;
  double a0_ = 0, da_ = 0, g0_ = 0, dg_ = 0;
};

}  // namespace freestand::bench
