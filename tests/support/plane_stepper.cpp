#include "support/plane_stepper.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::test {

PlaneAnswer step_in_plane(const PlaneBlock& block, const std::function<PlanePush(double t)>& floor, double end_s,
                          long steps) {
  PlaneAnswer answer;
  const double h = end_s / static_cast<double>(steps);
  double ux = 0, uy = 0, wx = 0, wy = 0, height = 0, climb = 0;
  for (long i = 0; i < steps; ++i) {
    const PlanePush push = floor((static_cast<double>(i) + 0.5) * h);
    const double before_x = wx, before_y = wy;
    const bool stuck = wx == 0 && wy == 0;
    wx -= push.x * h;
    wy -= push.y * h;
    // The impulse of the floor upwards: what keeps the block from sinking in.
    climb -= (block.g + push.up) * h;
    const double normal = height + climb * h < 0 ? -height / h - climb : 0.0;
    climb += normal;
    height = std::max(height + climb * h, 0.0);
    const double size = std::hypot(wx, wy);
    const double held = stuck && size <= block.mu_s * normal ? size : std::min(size, block.mu_k * normal);
    const double kept = size > 0 ? 1 - held / size : 0;
    const double px = wx * (1 - kept), py = wy * (1 - kept);
    wx = held == size ? 0 : wx * kept;
    wy = held == size ? 0 : wy * kept;
    // Work of an impulse: by the mean of the speeds before and after.
    answer.friction_work -= 0.5 * (px * (before_x + wx) + py * (before_y + wy));
    ux += h * wx;
    uy += h * wy;
    if (normal > 0) answer.path_m += h * std::hypot(wx, wy);
    answer.peak_slip_m = std::max(answer.peak_slip_m, std::hypot(ux, uy));
  }
  answer.residual_x_m = ux;
  answer.residual_y_m = uy;
  return answer;
}

PlaneAnswer step_in_plane_twice(const PlaneBlock& block, const std::function<PlanePush(double t)>& floor, double end_s,
                                long steps, double& error) {
  const PlaneAnswer coarse = step_in_plane(block, floor, end_s, steps);
  const PlaneAnswer fine = step_in_plane(block, floor, end_s, 2 * steps);
  error = std::abs(fine.peak_slip_m - coarse.peak_slip_m);
  const auto none = [](double c, double f) { return 2 * f - c; };
  return {none(coarse.peak_slip_m, fine.peak_slip_m), none(coarse.residual_x_m, fine.residual_x_m),
          none(coarse.residual_y_m, fine.residual_y_m), none(coarse.path_m, fine.path_m),
          none(coarse.friction_work, fine.friction_work)};
}

}  // namespace freestand::test
