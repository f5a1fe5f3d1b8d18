#include <algorithm>
#include <freestand/specimen.hpp>

#include "base/units.hpp"

namespace freestand {

Block Block::rectangular(double width_m, double height_m, double mass_kg) {
  const double b = width_m / 2, h = height_m / 2;
  return {b, b, h, (b * b + h * h) / 3, mass_kg};
}

double Block::alpha_rad() const { return std::atan2(std::min(left_m, right_m), height_m); }

double Block::size_m() const { return std::hypot(std::min(left_m, right_m), height_m); }

double Block::p_radps() const {
  const double R = size_m();
  return std::sqrt(standard_gravity_mps2 * R / (gyration2_m2 + R * R));
}

}  // namespace freestand
