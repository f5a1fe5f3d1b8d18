#include "motion/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "motion/channel.hpp"

namespace freestand::motion {

MotionPeaks peaks(const FloorMotion& motion, Channel channel) {
  MotionPeaks peaks;
  const MotionValues& c = coefficients(motion, channel);
  if (c.empty()) return peaks;
  double speed = 0, place = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double h = length(motion, i);
    const Polynomial a = segment(motion, c, i), v = integral(a, speed), u = integral(v, place);
    peaks.pga_mps2 = std::max(peaks.pga_mps2, peak(a, h));
    peaks.pgv_mps = std::max(peaks.pgv_mps, peak(v, h));
    peaks.pgd_m = std::max(peaks.pgd_m, peak(u, h));
    speed = v(h);
    place = u(h);
  }
  return peaks;
}

MotionPeaks scaled(const MotionPeaks& peaks, double scale, double stretch) {
  const double factor = std::abs(scale);
  return {peaks.pga_mps2 * factor, peaks.pgv_mps * factor * stretch, peaks.pgd_m * factor * stretch * stretch};
}

FloorHistory floor_history(const FloorMotion& motion, double step_s, Channel channel) {
  if (!(step_s > 0)) throw Error("no history with a step of " + std::to_string(step_s) + " s: use a positive step");
  const MotionValues& c = coefficients(motion, channel);
  FloorHistory history{step_s, {}, {}, {}};
  if (c.empty()) return history;
  double speed = 0, place = 0;
  std::size_t point = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double h = length(motion, i), slack = i + 1 == motion.segments() ? 1e-9 * step_s : 0;
    const Polynomial a = segment(motion, c, i), v = integral(a, speed), u = integral(v, place);
    for (;; ++point) {
      const double tau = static_cast<double>(point) * step_s - motion.knot_s[i];
      if (tau > h + slack || (slack == 0 && tau == h)) break;
      history.acceleration_mps2.push_back(a(tau));
      history.velocity_mps.push_back(v(tau));
      history.displacement_m.push_back(u(tau));
    }
    speed = v(h);
    place = u(h);
  }
  return history;
}

}  // namespace freestand::motion
