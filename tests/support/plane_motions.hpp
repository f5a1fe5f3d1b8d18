// Floor motions in both horizontal directions, for the tests.
#pragma once

#include <cstdint>
#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>
#include <string>
#include <vector>

namespace freestand::test {

// The two motions have the same knots; the second one's horizontal channel becomes the first one's cross channel.
FloorMotion in_plane(FloorMotion along, const FloorMotion& across);

// Turned by an angle, counterclockwise, from the first direction towards the second one.
FloorMotion turned(const FloorMotion& motion, double angle_rad);

// Random records, each a pure function of its number: noise through a damped oscillator in either direction, and upwards where
// `vertical`.
struct PlaneCase {
  double dt_s = 0;
  std::vector<double> x, y, up;  // [m/s2]
  Specimen specimen;             // slides; mu_s = mu_k or above
  FloorMotion motion() const;
  double vertical_scale() const { return up.empty() ? 0 : 1; }
  std::string text() const;
};
PlaneCase plane_case(std::uint64_t number);

}  // namespace freestand::test
