// Floor motion as the integrators see it: a piecewise polynomial in time.
//
// Recorded motions are piecewise linear between their samples (degree 1). Closed-form pulses are stored once, with unit
// peak acceleration and unit period, as polynomials of higher degree that agree with the closed form to about 1e-14; a
// sample scales and stretches them. So one kernel serves both, steps never cross a knot, and all pulses of one type
// share one table.
#pragma once

#include <cstddef>
#include <freestand/motion_values.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace freestand {

struct MotionTable;

// Shape: n segments, n + 1 knots, degree + 1 coefficients a segment.
// On segment i, with tau = t - knot_s[i]:  a(t) = sum_k horizontal_mps2[i * (degree + 1) + k] * tau^k   [m/s2].
// After the last knot the floor is still (a = 0). Before knot_s[0] = 0 nothing happens.
struct FloorMotion {
  std::string name;
  MotionValues knot_s;  // increasing, starts at 0
  int degree = 1;
  MotionValues horizontal_mps2;  // n * (degree + 1)
  MotionValues vertical_mps2;    // the same, up positive; empty where there is no vertical channel
  MotionValues cross_mps2;       // the same, across the horizontal channel; empty where it moves along a line

  // Bounds of |a| over runs of `run_length` segments, from index_runs(): an integrator passes over the runs that cannot
  // move the block. Empty: not indexed, every segment is looked at.
  static constexpr std::size_t run_length = 32;
  MotionValues horizontal_run_mps2, vertical_run_mps2, cross_run_mps2;
  // The cross channel is this times the horizontal one throughout, to round-off, and the floor shakes along one line; nan: it
  // is not. From index_runs().
  double cross_over_horizontal = std::numeric_limits<double>::quiet_NaN();
  // Integrals and more of the horizontal channel, from index_runs(); null where the motion is not piecewise linear with
  // a constant step.
  std::shared_ptr<const MotionTable> table;

  std::size_t segments() const { return knot_s.empty() ? 0 : knot_s.size() - 1; }
  double duration_s() const { return knot_s.empty() ? 0.0 : knot_s.back(); }
};

// A floor motion as one sample feels it: acceleration(t) = scale * motion(t / stretch).
// `stretch` is the pulse period for the unit pulses and 1 for records.
struct Shaking {
  const FloorMotion* motion = nullptr;  // not owned
  double scale = 1.0;                   // on the horizontal channels; its sign mirrors the motion
  double stretch = 1.0;                 // > 0
  double vertical_scale = 0.0;          // on the vertical channel; 0: vertical shaking is ignored

  double duration_s() const { return motion->duration_s() * stretch; }
};

// Acceleration [m/s2] at time t [s], for pictures, output and tests (the kernels read the coefficients).
double horizontal_acceleration(const Shaking& shaking, double t);
double vertical_acceleration(const Shaking& shaking, double t);

double cross_acceleration(const Shaking& shaking, double t);

// Fills the bounds of the runs from the coefficients.
void index_runs(FloorMotion& motion);

// Equally spaced samples -> piecewise linear motion, indexed. vertical may be empty. Throws Error on fewer than two
// samples, unequal lengths, a step that is not positive, or a value that is not finite.
FloorMotion piecewise_linear(std::string name, double dt_s, const std::vector<double>& horizontal_mps2,
                             const std::vector<double>& vertical_mps2 = {});

// Gives such a motion a second horizontal channel, at the same instants. Throws Error as above.
void add_cross(FloorMotion& motion, double dt_s, const std::vector<double>& cross_mps2);

}  // namespace freestand
