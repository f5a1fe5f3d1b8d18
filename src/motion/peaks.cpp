#include "motion/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "motion/channel.hpp"

namespace freestand::motion {
namespace {

// Integral of f over [0, length], exact for polynomials up to degree 13 (Gauss-Legendre, 7 points).
template <class F>
double gauss(double length, const F& f) {
  constexpr double node[] = {0.0, 0.405845151377397166907, 0.741531185599394439864, 0.949107912342758524526};
  constexpr double weight[] = {0.417959183673469387755, 0.381830050505118944950, 0.279705391489276667901,
                               0.129484966168869693271};
  const double half = length / 2;
  double sum = weight[0] * f(half);
  for (int i = 1; i < 4; ++i) sum += weight[i] * (f(half * (1 - node[i])) + f(half * (1 + node[i])));
  return half * sum;
}

// Slope of the line through 0 that fits the velocity best: integral of v t over integral of t^2.
double velocity_trend(const FloorMotion& motion, const std::vector<double>& coefficients) {
  double moment = 0, speed = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double start = motion.knot_s[i];
    const Polynomial v = integral(segment(motion, coefficients, i), speed);
    moment += gauss(length(motion, i), [&](double tau) { return v(tau) * (start + tau); });
    speed = v(length(motion, i));
  }
  const double duration = motion.duration_s();
  return moment / (duration * duration * duration / 3);
}

void subtract(std::vector<double>& coefficients, int degree, double acceleration) {
  for (std::size_t i = 0; i < coefficients.size(); i += static_cast<std::size_t>(degree) + 1)
    coefficients[i] -= acceleration;
}

}  // namespace

MotionPeaks peaks(const FloorMotion& motion, Channel channel) {
  MotionPeaks peaks;
  const std::vector<double>& c = coefficients(motion, channel);
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
  const std::vector<double>& c = coefficients(motion, channel);
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

FloorMotion remove_velocity_trend(FloorMotion motion) {
  if (motion.segments() == 0) return motion;
  for (std::vector<double>* c : {&motion.horizontal_mps2, &motion.vertical_mps2})
    if (!c->empty()) subtract(*c, motion.degree, velocity_trend(motion, *c));
  index_runs(motion);
  return motion;
}

}  // namespace freestand::motion
