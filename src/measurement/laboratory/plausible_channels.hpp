// A channel of one test that cannot be what its column says, found without a model of friction: by the noise that every
// sensor has, by what a block at rest does, and by what the floor does to a block that rocks.
#pragma once

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

// Longest time [s] for which a channel stays at one value within its range though its sensor's noise cannot let it, other than at its beginning; 0: none.
// Rounded to steps of d, white noise of deviation s repeats a reading with probability q <= d/(2 sqrt(pi) s), and a run of L
// readings is expected n q^(L-1) times among n: it is told where that is below 1e-6.
double frozen_s(const Bench&, std::size_t test, Channel);

// Are the histories of a channel in two tests one and the same, sample by sample, where something moves?
bool same_history(const Bench&, std::size_t test, std::size_t other, Channel);

// Are the floors of two tests one and the same, sample by sample, though the data set states a noise of the floor's channel? What was
// measured never comes twice. (Without such noise it may be the motion that was commanded.)
bool same_floor(const Bench&, std::size_t test, std::size_t other);

// Do two tests say the same peak slip or rotation, and all else alike, under one floor? A repeated test seldom gives it again.
bool same_peaks(const Bench&, std::size_t test, std::size_t other);

// Does the floor turn the block the wrong way? A rectangle that rocks about a corner obeys
//   theta'' + p^2 sgn(theta) sin(alpha - |theta|) = b p^2 (-a/g) cos(alpha - |theta|),   p^2 = 3 g/(4 R),
// with b = 1, and b = -1 if theta is mirrored. Slips of the corner, and loads beside the floor, bring b nearer to 0. True:
// b, by least squares over the stretches within which theta keeps its sign, is below 0 by four of its standard errors.
bool turns_against_floor(const Bench&, std::size_t test);

// What a block that has not moved yet shows of its floor's acceleration, in these tests together: the factor of block_acceleration_mps2 on the
// floor's, by least squares freed of the floor's noise, and its standard error. 1 is right; 0: not told (too little shaking before the first
// motion, or no such channel).
struct FloorShare {
  double value = 0, error = 0;
};
FloorShare share_of_floor(const Bench&, const std::vector<std::size_t>& tests, double floor_without_slip_mps2);

}  // namespace freestand::measurement
