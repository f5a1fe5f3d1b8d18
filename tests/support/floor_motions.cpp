#include "support/floor_motions.hpp"

#include <cmath>

#include "base/units.hpp"

namespace freestand::test {

FloorMotion rectangular_pulse(double acceleration_mps2, double duration_s) {
  return staircase({duration_s}, {acceleration_mps2});
}

FloorMotion staircase(const std::vector<double>& durations_s, const std::vector<double>& horizontal_mps2,
                      const std::vector<double>& vertical_mps2) {
  FloorMotion motion;
  motion.name = "staircase";
  motion.degree = 1;
  motion.knot_s = {0};
  for (std::size_t i = 0; i < durations_s.size(); ++i) {
    motion.knot_s.push_back(motion.knot_s.back() + durations_s[i]);
    motion.horizontal_mps2.insert(motion.horizontal_mps2.end(), {horizontal_mps2[i], 0});
    if (!vertical_mps2.empty()) motion.vertical_mps2.insert(motion.vertical_mps2.end(), {vertical_mps2[i], 0});
  }
  return motion;
}

FloorMotion one_sine() {
  constexpr int segments = 128, degree = 7;
  FloorMotion motion;
  motion.name = "one sine";
  motion.degree = degree;
  const double omega = 2 * pi;
  for (int i = 0; i <= segments; ++i) motion.knot_s.push_back(static_cast<double>(i) / segments);
  for (int i = 0; i < segments; ++i) {
    // d^k/dt^k sin(omega t) = omega^k sin(omega t + k pi/2)
    const double phase = omega * motion.knot_s[static_cast<std::size_t>(i)];
    const double s = std::sin(phase), c = std::cos(phase);
    const double derivative[4] = {s, c, -s, -c};
    double factor = 1;
    for (int k = 0; k <= degree; ++k) {
      motion.horizontal_mps2.push_back(factor * derivative[k % 4]);
      factor *= omega / (k + 1);
    }
  }
  return motion;
}

FloorMotion with_halved_segments(const FloorMotion& motion) {
  FloorMotion result;
  result.name = motion.name;
  result.degree = motion.degree;
  const auto width = static_cast<std::size_t>(motion.degree) + 1;
  const auto shifted = [&](const MotionValues& c, std::size_t segment, double tau) {
    MotionValues out(c.begin() + static_cast<std::ptrdiff_t>(segment * width),
                     c.begin() + static_cast<std::ptrdiff_t>((segment + 1) * width));
    for (std::size_t i = 0; i < width; ++i)  // Horner's shift: p(x + tau)
      for (std::size_t k = width - 1; k-- > i;) out[k] += tau * out[k + 1];
    return out;
  };
  const auto append = [](MotionValues& to, const MotionValues& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const double start = motion.knot_s[i], half = 0.5 * (motion.knot_s[i + 1] - start);
    for (const double tau : {0.0, half}) {
      result.knot_s.push_back(start + tau);
      append(result.horizontal_mps2, shifted(motion.horizontal_mps2, i, tau));
      if (!motion.vertical_mps2.empty()) append(result.vertical_mps2, shifted(motion.vertical_mps2, i, tau));
    }
  }
  result.knot_s.push_back(motion.knot_s.back());
  return result;
}

}  // namespace freestand::test
