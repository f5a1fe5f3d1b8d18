// Walks along a floor motion, segment by segment, and gives the polynomials of the floor about the present instant.
#pragma once

#include <freestand/floor_motion.hpp>

#include "dynamics/contact.hpp"

namespace freestand::dynamics {

// Highest degree of a floor motion's polynomials.
inline constexpr int max_floor_degree = 7;

class FloorCursor {
 public:
  // g: gravity across the floor, push: gravity along it [m/s2].
  FloorCursor(const Shaking& shaking, double g, double push = 0);

  double time() const { return start_ + offset_; }
  double left() const;  // to the end of the segment [s]; infinite after the motion
  bool motion_over() const { return segment_ == segments_; }
  std::size_t segment() const { return segment_; }
  void advance(double tau) { offset_ += tau; }
  void next_segment();  // to the first instant of the next segment
  void next_run();      // to the first instant of the next run of segments

  // The segment's coefficients, and those of a vertical channel or null.
  struct Place {
    const double *knot_at_end, *horizontal, *vertical;
    double start, offset;  // [s]
    std::size_t left;      // segments, the present one included
  };
  Place place() const;
  void go_to(std::size_t segments_left, double start, double offset);

  // Bounds of the floor's accelerations [m/s2], over the present segment, or over the run that starts here.
  struct Bound {
    double a, v;
  };
  Bound segment_bound() const;
  bool run_starts_here() const;
  Bound run_bound() const;

  // Floor acceleration and effective gravity about time(). N must be at least the degree of the motion.
  template <int N>
  Floor<double, N> local() const {
    Floor<double, N> floor{Series<double, N>::zero(), Series<double, N>::zero()};
    if (!motion_over()) {
      shift(horizontal_ + segment_ * stride_, scale_, floor.a.c, N);
      if (vertical_) shift(vertical_ + segment_ * stride_, vertical_scale_, floor.g.c, N);
    }
    floor.a[0] += push_;
    floor.g[0] += g_;
    return floor;
  }

 private:
  void shift(const double* coefficients, double scale, double* out, int order) const;

  double bound(const double* coefficients) const;

  const FloorMotion* motion_;
  const double* knots_;
  const double* horizontal_;
  const double* vertical_;  // null: no vertical shaking
  std::size_t segments_, stride_;
  int degree_;
  double scale_, vertical_scale_, stretch_, g_, push_;
  std::size_t segment_ = 0;
  double start_ = 0, offset_ = 0;  // start of the segment, time since then [s]
};

}  // namespace freestand::dynamics
