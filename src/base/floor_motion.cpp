#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <freestand/floor_motion.hpp>
#include <limits>

#include "base/motion_table.hpp"

namespace freestand {
namespace {

// The segment that holds t; where all are equally long one of the first that are looked at.
std::size_t segment_at(const FloorMotion& motion, double t) {
  const auto& knots = motion.knot_s;
  const std::size_t segments = knots.size() - 1;
  const auto even = static_cast<std::size_t>(t / motion.duration_s() * static_cast<double>(segments));
  for (std::size_t i = even > 0 ? even - 1 : 0; i < std::min(even + 2, segments); ++i)
    if (knots[i] <= t && t < knots[i + 1]) return i;
  return static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), t) - knots.begin()) - 1;
}

double evaluate(const FloorMotion& motion, const MotionValues& coefficients, double t) {
  if (coefficients.empty() || t < 0 || t >= motion.duration_s()) return 0;
  const std::size_t segment = segment_at(motion, t);
  const double tau = t - motion.knot_s[segment];
  const double* c = &coefficients[segment * static_cast<std::size_t>(motion.degree + 1)];
  double value = c[motion.degree];
  for (int k = motion.degree - 1; k >= 0; --k) value = value * tau + c[k];
  return value;
}

// max over each run of sum_k |c_k| h^k.
MotionValues run_bounds(const FloorMotion& motion, const MotionValues& coefficients) {
  const auto stride = static_cast<std::size_t>(motion.degree) + 1;
  MotionValues bounds;
  for (std::size_t i = 0; i * stride < coefficients.size(); ++i) {
    const double h = motion.knot_s[i + 1] - motion.knot_s[i];
    double bound = 0;
    for (std::size_t k = stride; k-- > 0;) bound = bound * h + std::abs(coefficients[i * stride + k]);
    if (i % FloorMotion::run_length == 0)
      bounds.push_back(bound);
    else
      bounds.back() = std::max(bounds.back(), bound);
  }
  return bounds;
}

MotionValues linear_coefficients(double dt_s, const std::vector<double>& samples) {
  MotionValues c;
  c.reserve(2 * (samples.size() - 1));
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    c.push_back(samples[i]);
    c.push_back((samples[i + 1] - samples[i]) / dt_s);
  }
  return c;
}

// cross / horizontal where they are proportional throughout, to round-off of the largest cross acceleration; else nan.
// Coefficients of degree k count over their segment's length^k.
double ratio_of_channels(const FloorMotion& motion) {
  constexpr double independent = std::numeric_limits<double>::quiet_NaN();
  const MotionValues &along = motion.horizontal_mps2, &across = motion.cross_mps2;
  if (across.empty() || across.size() != along.size()) return independent;
  const auto stride = static_cast<std::size_t>(motion.degree) + 1;
  std::size_t largest = 0;
  double peak = 0;
  for (std::size_t i = 0; i < along.size(); i += stride) {
    if (std::abs(along[i]) > std::abs(along[largest])) largest = i;
    peak = std::max(peak, std::abs(across[i]));
  }
  if (along[largest] == 0) return independent;
  const double ratio = across[largest] / along[largest];
  const double round_off = 8 * std::numeric_limits<double>::epsilon() * peak;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double h = motion.knot_s[i / stride + 1] - motion.knot_s[i / stride];
    const double length = std::pow(h, static_cast<double>(i % stride));
    if (!(std::abs(across[i] - ratio * along[i]) * length <= round_off)) return independent;
  }
  return ratio;
}

bool all_finite(const std::vector<double>& samples) {
  return std::all_of(samples.begin(), samples.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

double horizontal_acceleration(const Shaking& shaking, double t) {
  return shaking.scale * evaluate(*shaking.motion, shaking.motion->horizontal_mps2, t / shaking.stretch);
}

double vertical_acceleration(const Shaking& shaking, double t) {
  return shaking.vertical_scale * evaluate(*shaking.motion, shaking.motion->vertical_mps2, t / shaking.stretch);
}

double cross_acceleration(const Shaking& shaking, double t) {
  return shaking.scale * evaluate(*shaking.motion, shaking.motion->cross_mps2, t / shaking.stretch);
}

void index_runs(FloorMotion& motion) {
  motion.horizontal_run_mps2 = run_bounds(motion, motion.horizontal_mps2);
  motion.vertical_run_mps2 = run_bounds(motion, motion.vertical_mps2);
  motion.cross_run_mps2 = run_bounds(motion, motion.cross_mps2);
  motion.cross_over_horizontal = ratio_of_channels(motion);
  motion.table = tabulate(motion);
}

FloorMotion piecewise_linear(std::string name, double dt_s, const std::vector<double>& horizontal_mps2,
                             const std::vector<double>& vertical_mps2) {
  const auto reject = [&](const char* why) {
    throw Error("motion " + name + " cannot be used (" + why + "): check the record", Exit::data);
  };
  if (!(dt_s > 0) || !std::isfinite(dt_s)) reject("the time step is not a positive number");
  if (horizontal_mps2.size() < 2) reject("fewer than two samples");
  if (!vertical_mps2.empty() && vertical_mps2.size() != horizontal_mps2.size())
    reject("the vertical channel has another length than the horizontal one");
  if (!all_finite(horizontal_mps2) || !all_finite(vertical_mps2)) reject("a value is not a finite number");

  FloorMotion motion;
  motion.name = std::move(name);
  motion.degree = 1;
  motion.knot_s.reserve(horizontal_mps2.size());
  for (std::size_t i = 0; i < horizontal_mps2.size(); ++i) motion.knot_s.push_back(static_cast<double>(i) * dt_s);
  motion.horizontal_mps2 = linear_coefficients(dt_s, horizontal_mps2);
  if (!vertical_mps2.empty()) motion.vertical_mps2 = linear_coefficients(dt_s, vertical_mps2);
  index_runs(motion);
  return motion;
}

void add_cross(FloorMotion& motion, double dt_s, const std::vector<double>& cross_mps2) {
  if (cross_mps2.size() != motion.knot_s.size() || motion.degree != 1 || !all_finite(cross_mps2))
    throw Error("motion " + motion.name +
                    " cannot be used (its second horizontal channel has another length, or a value that is not a "
                    "finite number): check the record",
                Exit::data);
  motion.cross_mps2 = linear_coefficients(dt_s, cross_mps2);
  index_runs(motion);
}

}  // namespace freestand
