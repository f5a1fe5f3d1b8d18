#include <algorithm>
#include <freestand/specimen.hpp>

#include "base/units.hpp"

namespace freestand {

Block Block::rectangular(double width_m, double height_m, double mass_kg) {
  const double b = width_m / 2, h = height_m / 2;
  return {b, b, h, (b * b + h * h) / 3, mass_kg};
}

Block Block::of_outline(double width_m, double height_m, double mass_kg, std::optional<double> centre_height_m,
                        std::optional<double> gyration_radius_m) {
  Block block = rectangular(width_m, height_m, mass_kg);
  if (centre_height_m) block.height_m = *centre_height_m, block.top_m = height_m;
  if (gyration_radius_m) block.gyration2_m2 = *gyration_radius_m * *gyration_radius_m;
  return block;
}

double Block::alpha_rad() const { return std::atan2(std::min(left_m, right_m), height_m); }

double Block::size_m() const { return std::hypot(std::min(left_m, right_m), height_m); }

double Block::p_radps() const {
  const double R = size_m();
  return std::sqrt(standard_gravity_mps2 * R / (gyration2_m2 + R * R));
}

}  // namespace freestand
