#include "motion/cumulative.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/units.hpp"
#include "motion/channel.hpp"
#include "motion/quadrature.hpp"

namespace freestand::motion {
namespace {

double squares(const Polynomial& a, double length) {
  return gauss(length, [&](double tau) { return a(tau) * a(tau); });
}

// Integral of a^2 up to each knot.
std::vector<double> squares_up_to_knots(const FloorMotion& motion) {
  std::vector<double> sums{0};
  for (std::size_t i = 0; i < motion.segments(); ++i)
    sums.push_back(sums.back() + squares(segment(motion, motion.horizontal_mps2, i), length(motion, i)));
  return sums;
}

// When the integral of a^2 reaches `wanted`: it rises throughout, so that halving the segment finds it to round-off.
double instant_of(const FloorMotion& motion, const std::vector<double>& sums, double wanted) {
  std::size_t i = 0;
  while (i + 1 < motion.segments() && sums[i + 1] < wanted) ++i;
  const Polynomial a = segment(motion, motion.horizontal_mps2, i);
  double lower = 0, upper = length(motion, i);
  for (double middle = upper / 2; middle > lower && middle < upper; middle = lower + (upper - lower) / 2)
    (sums[i] + squares(a, middle) < wanted ? lower : upper) = middle;
  return motion.knot_s[i] + upper;
}

// First and last instant of a segment with |a| >= threshold: its ends, or where |a| passes the threshold.
struct Bracket {
  double first, last;
};
std::optional<Bracket> bracket(const Polynomial& a, double length, double threshold) {
  std::vector<double> at;
  for (const double end : {0.0, length})
    if (std::abs(a(end)) >= threshold) at.push_back(end);
  for (const double level : {threshold, -threshold}) {
    Polynomial over = a;
    over.c[0] -= level;
    const Roots roots = sign_changes(over, length);
    for (int k = 0; k < roots.count; ++k) at.push_back(roots.at[static_cast<std::size_t>(k)]);
  }
  if (at.empty()) return {};
  Bracket found{at.front(), at.front()};
  for (const double t : at) found = {std::min(found.first, t), std::max(found.last, t)};
  return found;
}

}  // namespace

double arias_intensity_mps(const FloorMotion& motion) {
  return pi / (2 * standard_gravity_mps2) * squares_up_to_knots(motion).back();
}

double cumulative_absolute_velocity_mps(const FloorMotion& motion) {
  double sum = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) {
    const Polynomial a = segment(motion, motion.horizontal_mps2, i), v = integral(a, 0);
    const Roots turns = sign_changes(a, length(motion, i));
    double before = 0;
    for (int k = 0; k < turns.count; ++k) {
      const double here = v(turns.at[static_cast<std::size_t>(k)]);
      sum += std::abs(here - before);
      before = here;
    }
    sum += std::abs(v(length(motion, i)) - before);
  }
  return sum;
}

double significant_duration_s(const FloorMotion& motion, double from, double to) {
  const std::vector<double> sums = squares_up_to_knots(motion);
  if (!(sums.back() > 0)) return 0;
  return instant_of(motion, sums, to * sums.back()) - instant_of(motion, sums, from * sums.back());
}

double bracketed_duration_s(const FloorMotion& motion, double threshold_mps2) {
  std::optional<double> first;
  double last = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i)
    if (const auto part = bracket(segment(motion, motion.horizontal_mps2, i), length(motion, i), threshold_mps2)) {
      if (!first) first = motion.knot_s[i] + part->first;
      last = motion.knot_s[i] + part->last;
    }
  return first ? last - *first : 0;
}

}  // namespace freestand::motion
