#include "measurement/data/ground.hpp"

namespace freestand::measurement {

double floor_acceleration_mps2(const Test& test, std::size_t sample) {
  return horizontal_acceleration(test.shaking(), static_cast<double>(sample) * test.dt_s);
}

std::vector<double> floor_displacement(const Test& test) {
  std::vector<double> d(test.slip_m.size());
  double velocity = 0;
  for (std::size_t i = 1; i < d.size(); ++i) {
    const double t = static_cast<double>(i - 1) * test.dt_s;
    const double a0 = horizontal_acceleration(test.shaking(), t);
    const double a1 = horizontal_acceleration(test.shaking(), t + test.dt_s);
    d[i] = d[i - 1] + test.dt_s * velocity + test.dt_s * test.dt_s * (2 * a0 + a1) / 6;
    velocity += test.dt_s * (a0 + a1) / 2;
  }
  return d;
}

std::vector<double> motion_samples(const FloorMotion& motion, const MotionValues& coefficients) {
  std::vector<double> values;
  if (coefficients.empty()) return values;
  const std::size_t n = motion.segments(), stride = static_cast<std::size_t>(motion.degree) + 1;
  for (std::size_t i = 0; i < n; ++i) values.push_back(coefficients[i * stride]);
  const double last = motion.knot_s[n] - motion.knot_s[n - 1];
  values.push_back(coefficients[(n - 1) * stride] + coefficients[(n - 1) * stride + 1] * last);
  return values;
}

}  // namespace freestand::measurement
