// Physical constants and unit factors. Inside freestand everything is SI and double.
#pragma once

namespace freestand {

inline constexpr double standard_gravity_mps2 = 9.80665;
inline constexpr double inch_m = 0.0254;
inline constexpr double pi = 3.14159265358979323846;

}  // namespace freestand
