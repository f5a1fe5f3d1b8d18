// What is known of a record before any sample is computed: its values in a row, their integrals, and bounds over runs.
// Made once per record with a constant step (FloorMotion::table), for the integrator of whole blocks of samples.
//
// With a the unit record (no scale), knots j = 0 ... n, step h, a = 0 after the last knot:
//   velocity V_j = int_0^{t_j} a dt, displacement D_j = int_0^{t_j} V dt, exact for the piecewise linear a;
//   margin M_j = max(|a_j - a_{j-1}|, |a_{j+1} - a_j|) h / 8: a velocity quadratic between two knots stays above the
//   smaller of its values there less the margin;
//   dip d_j: under a friction of any strength, a block that slips one way cannot stop between knots j - 1 and j and slip
//   on if its speed at j is above d_j. Forwards: with a change s = a_j - a_{j-1} the speed turns from falling to rising
//   only where s < 0, and rises in the end by less than -a_j and than -s (per second), so that
//   d_j = min(-a_j, -s)^2 h/(-2 s), 0 where one of the two is not positive. Backwards: the same of -a.
// All rows go on after the last knot as a = 0 lets them, for at least `table_tail` entries.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <freestand/floor_motion.hpp>
#include <memory>
#include <vector>

namespace freestand {

using Row = MotionValues;
using ShortRow = std::vector<std::uint16_t, LineAllocator<std::uint16_t>>;

inline constexpr int table_run = 8;    // knots a run
inline constexpr int level_run = 16;   // knots a run of levels
inline constexpr int table_tail = 96;  // entries after the last knot
inline constexpr int table_columns = 4;
inline constexpr std::uint16_t largest_short = 65535;  // of heights and levels: of what is after the record
inline constexpr double height_zero = 32000;

struct MotionTable {
  double step_s = 0, rate_hz = 0;  // h and 1/h
  int knots = 0;                   // n + 1
  Row acceleration;                // a_j [m/s2]
  Row velocity;                    // V_j [m/s]
  Row displacement;                // D_j [m]
  Row margin;                      // M_j [m/s]
  Row run_peak;                    // max |a_j| over j = 8 r ... 8 r + 7 [m/s2]
  Row later_peak;                  // max |a_j| over all j >= 8 r [m/s2]
  Row columns;                     // a_j, V_j, D_j and (a_{j+1} - a_j)/h, knot by knot
  // Where the motion has a continuous vertical channel v, else empty.
  Row vertical;             // v_j [m/s2]
  Row both;                 // a_j, v_j, knot by knot
  Row later_vertical_peak;  // max |v_j| over all j >= 8 r [m/s2]
  // For searches, in short integers, rounded so that none passes over a knot.
  ShortRow heights;  // above height(V_j + d_j); from `backwards` on height(-V_j + d_j)
  int backwards = 0;
  double heights_to_one = 0;  // [s/m]
  ShortRow levels;            // level(|a_j|)
  ShortRow run_levels;        // the largest of them over j = 16 r ... 16 r + 15
  double levels_to_one = 0;   // [s2/m]

  double height(double V) const { return V * heights_to_one + height_zero; }
  // Never falls where `size` rises.
  std::uint16_t level(double size) const {
    const double level = size * levels_to_one;
    return level < largest_short ? static_cast<std::uint16_t>(level) : largest_short;
  }
};

// Null where the motion is not piecewise linear with a constant step, or beyond all floors (1e150 m/s2, whose squares overflow).
std::shared_ptr<const MotionTable> tabulate(const FloorMotion& motion);

}  // namespace freestand
