#include "base/motion_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freestand {
namespace {

bool constant_step(const FloorMotion& motion) {
  const double h = motion.knot_s[1];
  for (std::size_t i = 0; i < motion.knot_s.size(); ++i)
    if (std::abs(motion.knot_s[i] - static_cast<double>(i) * h) > 1e-12 * motion.duration_s()) return false;
  return true;
}

// Before a knot with acceleration b, changed by `by` from the one before.
double dip(double b, double by, double h) {
  if (!(by < 0 && b < 0)) return 0;
  const double most = std::max(b, by);
  return most * most * h / (-2 * by);
}

bool continuous(const FloorMotion& motion, const MotionValues& c) {
  double most = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i) most = std::max(most, std::abs(c[2 * i]));
  for (std::size_t i = 0; i + 1 < motion.segments(); ++i) {
    const double end = c[2 * i] + c[2 * i + 1] * (motion.knot_s[i + 1] - motion.knot_s[i]);
    const double rounded =
        4 * std::numeric_limits<double>::epsilon() * motion.knot_s[i + 1];  // length of a segment [s]
    if (std::abs(end - c[2 * i + 2]) > 1e-12 * most + std::abs(c[2 * i + 1]) * rounded) return false;
  }
  return true;
}

// So many to one that the largest comes to `top`; 0 where it is so small that no number is.
double to_one(double top, double largest) { return largest > 0 && std::isfinite(top / largest) ? top / largest : 0; }

// Values of a channel at the knots, the first of `row`.
void fill(Row& row, const FloorMotion& motion, const MotionValues& c, double h) {
  const std::size_t n = motion.segments();
  for (std::size_t j = 0; j < n; ++j) row[j] = c[2 * j];
  row[n] = c[2 * n - 2] + c[2 * n - 1] * h;
}

void tabulate_columns(MotionTable& t) {
  t.columns.reserve(t.acceleration.size() * table_columns);
  for (std::size_t j = 0; j < t.acceleration.size(); ++j) {
    const double a = t.acceleration[j], next = j + 1 < t.acceleration.size() ? t.acceleration[j + 1] : 0.0;
    for (const double value : {a, t.velocity[j], t.displacement[j], (next - a) * t.rate_hz}) t.columns.push_back(value);
  }
}

void tabulate_heights(MotionTable& t) {
  const std::size_t all = t.acceleration.size(), knots = static_cast<std::size_t>(t.knots);
  Row exact(2 * all, 0.0);
  double most = 0;
  for (std::size_t j = 0; j < knots; ++j) {
    const double V = t.velocity[j], b = t.acceleration[j], by = j > 0 ? b - t.acceleration[j - 1] : 0.0;
    exact[j] = V + dip(b, by, t.step_s);
    exact[all + j] = dip(-b, -by, t.step_s) - V;
    most = std::max({most, std::abs(exact[j]), std::abs(exact[all + j])});
  }
  t.heights_to_one = to_one(height_zero - 10, most);
  t.backwards = static_cast<int>(all);
  t.heights.assign(2 * all, largest_short);
  for (std::size_t j = 0; j < knots; ++j)
    for (const std::size_t k : {j, all + j})
      t.heights[k] = static_cast<std::uint16_t>(std::floor(exact[k] * t.heights_to_one + height_zero) + 1);
}

void tabulate_levels(MotionTable& t) {
  const std::size_t all = t.acceleration.size();
  const double peak = *std::max_element(t.run_peak.begin(), t.run_peak.end());
  t.levels_to_one = to_one(65000, peak);
  t.levels.assign(all, largest_short);
  t.run_levels.assign(all, 0);
  for (std::size_t j = 0; j < all; ++j) {
    if (j < static_cast<std::size_t>(t.knots)) t.levels[j] = t.level(std::abs(t.acceleration[j]));
    t.run_levels[j / level_run] = std::max(t.run_levels[j / level_run], t.levels[j]);
  }
}

void keep_largest_of_later(Row& peaks) {
  for (std::size_t r = peaks.size() - 1; r-- > 0;) peaks[r] = std::max(peaks[r], peaks[r + 1]);
}

void tabulate_vertical(MotionTable& t, const FloorMotion& motion) {
  const std::size_t all = t.acceleration.size(), runs = t.run_peak.size();
  t.vertical.assign(all, 0.0);
  fill(t.vertical, motion, motion.vertical_mps2, t.step_s);
  t.both.reserve(2 * all);
  for (std::size_t j = 0; j < all; ++j)
    for (const double value : {t.acceleration[j], t.vertical[j]}) t.both.push_back(value);
  t.later_vertical_peak.assign(runs, 0.0);
  for (std::size_t j = 0; j < all; ++j) {
    double& peak = t.later_vertical_peak[j / table_run];
    peak = std::max(peak, std::abs(t.vertical[j]));
  }
  keep_largest_of_later(t.later_vertical_peak);
}

}  // namespace

std::shared_ptr<const MotionTable> tabulate(const FloorMotion& motion) {
  if (motion.degree != 1 || motion.segments() < 1 || !constant_step(motion)) return nullptr;
  if (!continuous(motion, motion.horizontal_mps2)) return nullptr;
  constexpr double largest_mps2 = 1e150;  // squares are numbers
  for (const double a : motion.horizontal_mps2)
    if (!(std::abs(a) < largest_mps2)) return nullptr;
  auto table = std::make_shared<MotionTable>();
  MotionTable& t = *table;
  const std::size_t n = motion.segments(), all = (n + 1 + table_tail + 31) / 32 * 32;
  const double h = t.step_s = motion.knot_s[1];
  t.rate_hz = 1 / h;
  t.knots = static_cast<int>(n + 1);
  for (auto* row : {&t.acceleration, &t.velocity, &t.displacement, &t.margin}) row->assign(all, 0.0);
  fill(t.acceleration, motion, motion.horizontal_mps2, h);
  for (std::size_t j = 1; j < all; ++j) {
    const bool moving = j <= n;
    const double a = moving ? t.acceleration[j - 1] : 0.0, b = moving ? t.acceleration[j] : 0.0;
    t.velocity[j] = t.velocity[j - 1] + h * (a + b) / 2;
    t.displacement[j] = t.displacement[j - 1] + h * t.velocity[j - 1] + h * h * (2 * a + b) / 6;
    t.margin[j] = std::abs(b - a) * h / 8;
    t.margin[j - 1] = std::max(t.margin[j - 1], t.margin[j]);
  }
  t.run_peak.assign(all / table_run + table_tail, 0.0);
  for (std::size_t j = 0; j < all; ++j)
    t.run_peak[j / table_run] = std::max(t.run_peak[j / table_run], std::abs(t.acceleration[j]));
  tabulate_columns(t);
  tabulate_heights(t);
  tabulate_levels(t);
  t.later_peak = t.run_peak;
  keep_largest_of_later(t.later_peak);
  if (!motion.vertical_mps2.empty() && continuous(motion, motion.vertical_mps2)) tabulate_vertical(t, motion);
  return table;
}

}  // namespace freestand
