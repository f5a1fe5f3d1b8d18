// Walks along a floor motion, segment by segment, and gives the polynomials of the floor about the present instant.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <freestand/floor_motion.hpp>

#include "dynamics/contact.hpp"

namespace freestand::dynamics {

// Highest degree of a floor motion's polynomials.
inline constexpr int max_floor_degree = 7;

class FloorCursor {
 public:
  // g: gravity across the floor, push: gravity along it [m/s2].
  FloorCursor(const Shaking& shaking, double g, double push = 0);
  // Along the motion's second horizontal channel, as local().a.
  static FloorCursor across(const Shaking& shaking);

  double time() const { return start_ + offset_; }
  double left() const;  // to the end of the segment [s]; infinite after the motion
  bool motion_over() const { return segment_ == segments_; }
  std::size_t segment() const { return segment_; }
  void advance(double tau) { offset_ += tau; }
  void next_segment();  // to the first instant of the next segment
  bool at_knot() const { return offset_ == 0; }
  void go_to(std::size_t segment) {
    segment_ = segment;
    start_ = knots_[segment] * stretch_;
    offset_ = 0;
  }
  // To the first instant of the next segment over which the floor's accelerations are not quiet(bound), whole runs of
  // them at once. False: it is the present one.
  template <class Quiet>
  bool pass_over(Quiet&& quiet) {
    const std::size_t from = segment_;
    while (!motion_over()) {
      if (run_starts_here() && quiet(run_bound())) {
        segment_ = std::min(segments_, segment_ + FloorMotion::run_length);
        offset_ = 0;
      } else if (quiet(segment_bound())) {
        ++segment_;
        offset_ = 0;
      } else {
        break;
      }
    }
    if (segment_ != from) start_ = knots_[segment_] * stretch_;
    return segment_ != from;
  }

  // Visits the segments from `first` on that lie behind, the last one first, but for those over which the accelerations are
  // quiet(bound).
  template <class Quiet, class Visit>
  void look_back(std::size_t first, Quiet&& quiet, Visit&& visit) const {
    FloorCursor at = *this;
    for (std::size_t end = segment_; end > first;) {
      at.go_to((end - 1) / FloorMotion::run_length * FloorMotion::run_length);
      if (at.segment_ >= first && at.run_starts_here() && quiet(at.run_bound())) {
        end = at.segment_;
        continue;
      }
      at.go_to(--end);
      if (!quiet(at.segment_bound())) visit(at);
    }
  }

  // The segment's coefficients, and those of a vertical channel or null.
  struct Place {
    const double *knot_at_end, *horizontal, *vertical;
    double start, offset;  // [s]
    std::size_t left;      // segments, the present one included
  };
  Place place() const;
  double unit(int k) const { return unit_[static_cast<std::size_t>(k)]; }
  void go_to(std::size_t segments_left, double start, double offset);

  // Bounds of the floor's accelerations [m/s2], over the present segment, or over the run that starts here: `shaken` across,
  // with gravity along the floor `a`; v upwards. end: of the segment or run [s].
  struct Bound {
    double shaken, a, v, end;
  };
  Bound segment_bound() const {
    return bound(bound_of(horizontal_), vertical_ ? bound_of(vertical_) : 0.0, segment_ + 1);
  }
  bool run_starts_here() const {
    return offset_ == 0 && segment_ % FloorMotion::run_length == 0 && !motion_->horizontal_run_mps2.empty();
  }
  Bound run_bound() const {
    const std::size_t run = segment_ / FloorMotion::run_length;
    return bound(motion_->horizontal_run_mps2[run], vertical_ ? motion_->vertical_run_mps2[run] : 0.0, run_end());
  }
  double run_end_s() const { return knots_[run_end()] * stretch_; }

  // Floor acceleration and effective gravity about time(). N must be at least the degree of the motion.
  template <int N>
  Floor<double, N> local() const {
    Floor<double, N> floor{Series<double, N>::zero(), Series<double, N>::zero()};
    if (!motion_over()) {
      shift(horizontal_ + segment_ * stride_, unit_, floor.a.c, N);
      if (vertical_) shift(vertical_ + segment_ * stride_, vertical_unit_, floor.g.c, N);
    }
    floor.a[0] += push_;
    floor.g[0] += g_;
    return floor;
  }

 private:
  using Units = std::array<double, max_floor_degree + 1>;
  Units units(double scale) const;
  void shift(const double* coefficients, const Units& unit, double* out, int order) const;

  std::size_t run_end() const {
    return std::min(segments_, (segment_ / FloorMotion::run_length + 1) * FloorMotion::run_length);
  }
  Bound bound(double horizontal, double vertical, std::size_t end) const {
    const double shaken = std::abs(scale_) * horizontal;
    return {shaken, std::abs(push_) + shaken, std::abs(vertical_scale_) * vertical, knots_[end] * stretch_};
  }
  double bound_of(const double* coefficients) const {
    const double h = knots_[segment_ + 1] - knots_[segment_];
    const double* c = coefficients + segment_ * stride_;
    double sum = 0;
    for (int k = degree_; k >= 0; --k) sum = sum * h + std::abs(c[k]);
    return sum;
  }

  const FloorMotion* motion_;
  const double* knots_;
  const double* horizontal_;
  const double* vertical_;  // null: no vertical shaking
  std::size_t segments_, stride_;
  int degree_;
  double scale_, vertical_scale_, stretch_, g_, push_;
  Units unit_, vertical_unit_;  // what makes coefficient k one of seconds: scale / stretch^k
  std::size_t segment_ = 0;
  double start_ = 0, offset_ = 0;  // start of the segment, time since then [s]
};

}  // namespace freestand::dynamics
