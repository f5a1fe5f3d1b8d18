// What is known of a record before any sample is computed: its values in a row, their integrals, and bounds over runs.
// Made once per record with a constant step (FloorMotion::table), for the integrator of whole blocks of samples.
//
// With a the unit record (no scale), knots j = 0 ... n, step h, a = 0 after the last knot:
//   velocity V_j = int_0^{t_j} a dt, displacement D_j = int_0^{t_j} V dt, exact for the piecewise linear a;
//   margin M_j = max(|a_j - a_{j-1}|, |a_{j+1} - a_j|) h / 8: a velocity quadratic between two knots stays above the
//   smaller of its values there less the margin.
// All rows go on after the last knot as a = 0 lets them, for at least `table_tail` entries.
#pragma once

#include <cstddef>
#include <freestand/floor_motion.hpp>
#include <memory>
#include <vector>

namespace freestand {

inline constexpr int table_run = 8;    // knots a run
inline constexpr int table_tail = 96;  // entries after the last knot

struct MotionTable {
  double step_s = 0, rate_hz = 0;    // h and 1/h
  int knots = 0;                     // n + 1
  std::vector<double> acceleration;  // a_j [m/s2]
  std::vector<double> velocity;      // V_j [m/s]
  std::vector<double> displacement;  // D_j [m]
  std::vector<double> margin;        // M_j [m/s]
  std::vector<double> run_peak;      // max |a_j| over j = 8 r ... 8 r + 7 [m/s2]
  std::vector<double> later_peak;    // max |a_j| over all j >= 8 r [m/s2]
};

// Null where the motion is not piecewise linear with a constant step.
std::shared_ptr<const MotionTable> tabulate(const FloorMotion& motion);

}  // namespace freestand
