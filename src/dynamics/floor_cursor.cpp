#include "dynamics/floor_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freestand::dynamics {

FloorCursor::FloorCursor(const Shaking& shaking, double g, double push)
    : motion_(shaking.motion),
      knots_(shaking.motion->knot_s.data()),
      horizontal_(shaking.motion->horizontal_mps2.data()),
      vertical_(shaking.motion->vertical_mps2.empty() || shaking.vertical_scale == 0
                    ? nullptr
                    : shaking.motion->vertical_mps2.data()),
      segments_(shaking.motion->segments()),
      stride_(static_cast<std::size_t>(shaking.motion->degree) + 1),
      degree_(shaking.motion->degree),
      scale_(shaking.scale),
      vertical_scale_(shaking.vertical_scale),
      stretch_(shaking.stretch),
      g_(g),
      push_(push),
      unit_(units(scale_)),
      vertical_unit_(units(vertical_scale_)) {}

FloorCursor::Units FloorCursor::units(double scale) const {
  Units unit{};
  for (int k = 0; k <= std::min(degree_, max_floor_degree); ++k, scale /= stretch_)
    unit[static_cast<std::size_t>(k)] = scale;
  return unit;
}

FloorCursor FloorCursor::across(const Shaking& shaking) {
  FloorCursor cursor(shaking, 0);
  cursor.horizontal_ = shaking.motion->cross_mps2.data();
  cursor.vertical_ = nullptr;
  return cursor;
}

double FloorCursor::left() const {
  if (motion_over()) return std::numeric_limits<double>::infinity();
  return std::max(0.0, knots_[segment_ + 1] * stretch_ - start_ - offset_);
}

void FloorCursor::next_segment() {
  ++segment_;
  start_ = knots_[segment_] * stretch_;
  offset_ = 0;
}

FloorCursor::Place FloorCursor::place() const {
  return {knots_ + segment_ + 1,
          horizontal_ + segment_ * stride_,
          vertical_ ? vertical_ + segment_ * stride_ : nullptr,
          start_,
          offset_,
          segments_ - segment_};
}

void FloorCursor::go_to(std::size_t segments_left, double start, double offset) {
  segment_ = segments_ - segments_left;
  start_ = start;
  offset_ = offset;
}

// sum_k coefficients[k] (x + offset / stretch)^k in powers of tau = stretch * x.
void FloorCursor::shift(const double* coefficients, const Units& unit, double* out, int order) const {
  if (degree_ == 1 && order >= 1) {  // of records
    out[0] += unit[0] * (coefficients[0] + offset_ / stretch_ * coefficients[1]);
    out[1] += unit[1] * coefficients[1];
    return;
  }
  const int top = std::min(degree_, order);
  double c[max_floor_degree + 1];
  std::copy(coefficients, coefficients + degree_ + 1, c);
  const double by = offset_ / stretch_;
  if (by != 0)
    for (int i = 0; i < degree_; ++i)
      for (int k = degree_ - 1; k >= i; --k) c[k] += by * c[k + 1];
  for (int k = 0; k <= top; ++k) out[k] += unit[static_cast<std::size_t>(k)] * c[k];
}

}  // namespace freestand::dynamics
