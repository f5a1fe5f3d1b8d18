// A polynomial in time along a slip, as a series in s with dt/ds = v (plane_slip.hpp): each derivative D_j has dD_j/ds = D_(j+1) v.
#pragma once

#include "dynamics/plane_slip.hpp"

namespace freestand::dynamics {

template <int Degree>
class AlongSlip {
 public:
  AlongSlip(const PlaneSeries& in_time, double factor) {
    double factorial = factor;
    for (int j = 0; j <= Degree; ++j) {
      derivative_[j][0] = in_time[j] * factorial;
      factorial *= j + 1;
    }
  }
  // Coefficient k + 1, from v's coefficients up to k.
  [[gnu::always_inline]] void advance(const PlaneSeries& v, int k) {
    const double one_over = 1.0 / (k + 1);
    for (int j = 0; j + 1 < Degree; ++j) derivative_[j][k + 1] = product(derivative_[j + 1], v, k) * one_over;
    if constexpr (Degree > 0) derivative_[Degree - 1][k + 1] = derivative_[Degree][0] * v[k] * one_over;
  }
  const PlaneSeries& series() const { return derivative_[0]; }

 private:
  PlaneSeries derivative_[Degree + 1];
};

}  // namespace freestand::dynamics
