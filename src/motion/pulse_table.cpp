// Closed form -> piecewise polynomial: interpolation at the Chebyshev points of each segment, written in powers of the
// time since the segment's start.
#include <array>
#include <cmath>

#include "motion/pulse.hpp"

namespace freestand::motion {
namespace {

constexpr int max_degree = 7;
using Powers = std::array<long double, max_degree + 1>;
constexpr long double long_pi = 3.14159265358979323846264338327950288L;

// Powers of s in [0, 1] of the shifted Chebyshev polynomials T_k(2 s - 1), k = 0 ... degree.
std::array<Powers, max_degree + 1> shifted_chebyshev(int degree) {
  std::array<Powers, max_degree + 1> rows{};
  rows[0][0] = 1;
  if (degree >= 1) rows[1] = {-1, 2};
  for (std::size_t k = 2; k <= static_cast<std::size_t>(degree); ++k)
    for (std::size_t j = 0; j <= k; ++j)
      rows[k][j] = -2 * rows[k - 1][j] + (j > 0 ? 4 * rows[k - 1][j - 1] : 0) - rows[k - 2][j];
  return rows;
}

// Powers of s of the polynomial through f at the points of [start, start + length].
Powers interpolate(const Pulse& pulse, double start, double length) {
  const int points = pulse.table_degree + 1;
  const auto rows = shifted_chebyshev(pulse.table_degree);
  Powers powers{};
  for (int k = 0; k < points; ++k) {
    long double coefficient = 0;
    for (int j = 0; j < points; ++j) {
      const long double angle = long_pi * (2 * j + 1) / (2 * points);
      const double s = static_cast<double>((1 + std::cos(angle)) / 2);
      coefficient += pulse.at(start + s * length).acceleration * std::cos(k * angle);
    }
    coefficient *= (k == 0 ? 1.0L : 2.0L) / points;
    if (std::abs(coefficient) < 1e-18L) continue;
    for (std::size_t j = 0; j <= static_cast<std::size_t>(k); ++j)
      powers[j] += coefficient * rows[static_cast<std::size_t>(k)][j];
  }
  return powers;
}

}  // namespace

FloorMotion pulse_motion(const Pulse& pulse) {
  FloorMotion motion;
  motion.name = pulse.name;
  motion.degree = pulse.table_degree;
  motion.knot_s.push_back(0);
  for (std::size_t piece = 0; piece + 1 < pulse.breaks.size(); ++piece) {
    const double begin = pulse.breaks[piece], end = pulse.breaks[piece + 1];
    const int count = static_cast<int>(std::ceil((end - begin) * pulse.segments_per_period));
    for (int i = 0; i < count; ++i) {
      const double start = motion.knot_s.back();
      const double knot = i + 1 == count ? end : begin + (end - begin) * (i + 1) / count;
      const Powers powers = interpolate(pulse, start, knot - start);
      long double unit = 1;
      for (int k = 0; k <= motion.degree; ++k, unit *= knot - start)
        motion.horizontal_mps2.push_back(static_cast<double>(powers[static_cast<std::size_t>(k)] / unit));
      motion.knot_s.push_back(knot);
    }
  }
  index_runs(motion);
  return motion;
}

}  // namespace freestand::motion
