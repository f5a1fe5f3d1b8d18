// The floor under a measured test, on the time steps of its histories.
#pragma once

#include <cstddef>
#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

double floor_acceleration_mps2(const Test&, std::size_t sample);

// Values of a motion that is linear between its knots, at these.
std::vector<double> motion_samples(const FloorMotion&, const MotionValues& coefficients);

// Displacement [m], from rest: the measured acceleration integrated twice, linear between samples. Added to the slip it
// gives the block's own, whose second derivative is what friction and other forces do to it.
std::vector<double> floor_displacement(const Test&);

}  // namespace freestand::measurement
