// What a floor's acceleration adds up to, and how long it takes for it: exact, the polynomials are integrated, not the
// samples. All of the horizontal channel; of a floor that does not shake 0.
#pragma once

#include <freestand/floor_motion.hpp>

namespace freestand::motion {

// Arias intensity, pi/(2 g) times the integral of a^2 [m/s] (Arias 1970). It grows with the square of the scale.
double arias_intensity_mps(const FloorMotion& motion);

// Cumulative absolute velocity, the integral of |a| [m/s]. It grows in proportion to the scale.
double cumulative_absolute_velocity_mps(const FloorMotion& motion);

// Significant duration [s]: from the instant at which the share `from` of the Arias intensity is reached to that of the share
// `to` (Trifunac & Brady 1975: 0.05 and 0.95). No scale changes it. Needs 0 <= from < to <= 1.
double significant_duration_s(const FloorMotion& motion, double from, double to);

// Bracketed duration [s]: from the first instant with |a| >= threshold to the last (Bolt 1973: 0.05 g). The threshold must
// be above zero.
double bracketed_duration_s(const FloorMotion& motion, double threshold_mps2);

}  // namespace freestand::motion
