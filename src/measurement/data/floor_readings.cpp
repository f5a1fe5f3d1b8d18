#include "measurement/data/floor_readings.hpp"

#include <gsl/gsl_spline.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "measurement/data/every.hpp"
#include "measurement/data/ground.hpp"

namespace freestand::measurement {
namespace {

constexpr double longest_straight_s = 0.005, rounding = 1e-6;  // a step may be 0.005 s to six digits

int pieces_of(double step_s) {
  return std::max(1, static_cast<int>(std::ceil(step_s / longest_straight_s - rounding)));
}

std::vector<double> in_pieces(const std::vector<double>& readings, int pieces) {
  if (pieces == 1 || readings.empty()) return readings;
  std::vector<double> places;
  for (std::size_t i = 0; i < readings.size(); ++i) places.push_back(static_cast<double>(i));
  const std::size_t count = (readings.size() - 1) * static_cast<std::size_t>(pieces) + 1;
  std::vector<double> all = curve_through(places, readings, true, 1.0 / pieces, count);
  for (std::size_t i = 0; i < readings.size(); ++i) all[i * static_cast<std::size_t>(pieces)] = readings[i];
  return all;
}

}  // namespace

bool is_smooth(double step_s) { return pieces_of(step_s) > 1; }

int FloorReadings::pieces() const { return horizontal_mps2.size() < 3 ? 1 : pieces_of(step_s); }

FloorReadings readings_of(const Test& test) {
  const FloorMotion& motion = test.motion;
  if (motion.segments() == 0) return {};
  const int pieces = test.pieces_a_reading;
  return {motion.name, pieces * (motion.knot_s[1] - motion.knot_s[0]),
          every(pieces, motion_samples(motion, motion.horizontal_mps2)),
          every(pieces, motion_samples(motion, motion.vertical_mps2))};
}

FloorMotion motion_through(const FloorReadings& read) {
  const int pieces = read.pieces();
  return piecewise_linear(read.name, read.step_s / pieces, in_pieces(read.horizontal_mps2, pieces),
                          in_pieces(read.vertical_mps2, pieces));
}

void read_floor(Test& test, const FloorReadings& read) {
  test.motion = motion_through(read);
  test.pieces_a_reading = read.pieces();
}

std::vector<double> curve_through(const std::vector<double>& places, const std::vector<double>& values, bool smooth,
                                  double step, std::size_t count) {
  const std::unique_ptr<gsl_spline, decltype(&gsl_spline_free)> curve(
      gsl_spline_alloc(smooth ? gsl_interp_cspline : gsl_interp_linear, places.size()), &gsl_spline_free);
  gsl_spline_init(curve.get(), places.data(), values.data(), places.size());
  std::vector<double> found;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = std::min(step * static_cast<double>(i), places.back());
    found.push_back(gsl_spline_eval(curve.get(), place, nullptr));
  }
  return found;
}

}  // namespace freestand::measurement
