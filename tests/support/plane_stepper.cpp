#include "support/plane_stepper.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::test {
namespace {

struct Plane {
  double x, y;
};

// What is left of a slip after an impulse of friction along and across the axis, `along` and `across` at most: w_i (1 + p_i^2/D) = w_i before,
// D^2 = sum p_i^2 w_i^2.
Plane left_by_ellipse(const Plane& w, double along, double across) {
  if (!(along > 0) || (w.x == 0 && w.y == 0)) return w;
  if (!(std::hypot(w.x / along, w.y / across) > 1)) return {0, 0};
  const auto at = [&](double D) { return Plane{w.x * D / (D + along * along), w.y * D / (D + across * across)}; };
  double low = 0, high = std::hypot(along * w.x, across * w.y);
  for (int half = 0; half < 80; ++half) {
    const double D = 0.5 * (low + high);
    const Plane left = at(D);
    (std::hypot(along * left.x, across * left.y) > D ? low : high) = D;
  }
  return at(high);
}

Plane left_by_friction(const PlaneBlock& block, const Plane& w, double normal, bool stuck) {
  const double c = std::cos(block.axis_rad), s = std::sin(block.axis_rad);
  const Plane turned{c * w.x + s * w.y, c * w.y - s * w.x};
  const double static_push = block.mu_s * normal, push = block.mu_k * normal;
  if (stuck && std::hypot(turned.x, turned.y / block.ratio) <= static_push) return {0, 0};
  const Plane left = left_by_ellipse(turned, push, block.ratio * push);
  return {c * left.x - s * left.y, s * left.x + c * left.y};
}

}  // namespace

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
    // The impulse of the floor upwards: what stops a block that would sink in. A landing takes it in one step: parted by where the
    // steps happen to lie, its friction would be another one wherever it turns the slip.
    climb -= (block.g + push.up) * h;
    const double normal = height + climb * h < 0 ? -climb : 0.0;
    climb += normal;
    height = normal > 0 ? 0 : height + climb * h;
    const double free_x = wx, free_y = wy;
    if (block.ratio != 1) {
      const Plane left = left_by_friction(block, {wx, wy}, normal, stuck);
      wx = left.x, wy = left.y;
    } else {
      const double size = std::hypot(wx, wy);
      const double held = stuck && size <= block.mu_s * normal ? size : std::min(size, block.mu_k * normal);
      const double kept = held < size ? 1 - held / size : 0;
      wx *= kept, wy *= kept;
    }
    const double px = free_x - wx, py = free_y - wy;
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
