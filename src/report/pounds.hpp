// The report's unit of weight and force.
#pragma once

#include "base/units.hpp"

namespace freestand::report {

inline constexpr double pound_kg = 0.45359237;
inline constexpr double pound_n = pound_kg * standard_gravity_mps2;

}  // namespace freestand::report
