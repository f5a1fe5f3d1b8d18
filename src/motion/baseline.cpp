#include "motion/baseline.hpp"

#include <array>

#include "motion/channel.hpp"
#include "motion/quadrature.hpp"

namespace freestand::motion {
namespace {

// Means over the whole motion of velocity times s and s^2, s from 0 to 1.
std::array<double, 2> velocity_moments(const FloorMotion& motion, const MotionValues& coefficients) {
  std::array<double, 2> moments{};
  double speed = 0;
  const double duration = motion.duration_s();
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double start = motion.knot_s[i], h = length(motion, i);
    const Polynomial v = integral(segment(motion, coefficients, i), speed);
    moments[0] += gauss(h, [&](double tau) { return v(tau) * (start + tau) / duration; });
    moments[1] += gauss(h, [&](double tau) { return v(tau) * (start + tau) / duration * (start + tau) / duration; });
    speed = v(h);
  }
  for (double& moment : moments) moment /= duration;
  return moments;
}

// Velocity line * s + parabola * s^2 [m/s]. Its normal equations have the means of s^2, s^3, s^4: 1/3, 1/4, 1/5.
struct Fit {
  double line = 0, parabola = 0;
};
Fit fit(const std::array<double, 2>& moments, Baseline baseline) {
  if (baseline == Baseline::linear) return {3 * moments[0], 0};
  constexpr double determinant = 1.0 / 3 / 5 - 1.0 / 4 / 4;
  return {(moments[0] / 5 - moments[1] / 4) / determinant, (moments[1] / 3 - moments[0] / 4) / determinant};
}

}  // namespace

FloorMotion remove_baseline(FloorMotion motion, Baseline baseline) {
  if (motion.segments() == 0) return motion;
  const double duration = motion.duration_s();
  const auto terms = static_cast<std::size_t>(motion.degree) + 1;
  for (MotionValues* channel : channels(motion)) {
    const Fit velocity = fit(velocity_moments(motion, *channel), baseline);
    const double constant = velocity.line / duration, slope = 2 * velocity.parabola / (duration * duration);
    for (std::size_t i = 0; i < motion.segments(); ++i) {
      (*channel)[i * terms] -= constant + slope * motion.knot_s[i];
      (*channel)[i * terms + 1] -= slope;
    }
  }
  index_runs(motion);
  return motion;
}

}  // namespace freestand::motion
