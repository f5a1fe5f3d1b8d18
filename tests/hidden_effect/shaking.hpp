// Floors of a shake table, from seeded random numbers alone: no record, no file. Deterministic.
//
//   pulse       one of: a cycle of a sine or of a cosine, a Ricker wavelet, cycles under a raised cosine; after 0.5 s of
//               quiet
//   stochastic  white noise through the filter of Kanai (1957) and Tajimi (1960), its long periods and
//               its highest frequencies (above 15 Hz) taken out by two filters of first order each, under an envelope that rises with t^2, holds and decays
//   both        a pulse somewhere in the strong part of a stochastic motion
#pragma once

#include <vector>

#include "support/keyed_random.hpp"

namespace freestand::test {

enum class Shaking { pulse, stochastic, both };

struct ShakingRange {
  double period_low_s = 0.4, period_high_s = 1.4;  // of pulses
  double ground_low_hz = 0.8, ground_high_hz = 7;  // of the ground that filters the noise
};

// Accelerations at steps of dt_s over about duration_s (stochastic: 0.6 to 1.5 times of it; a pulse: 0.3 to 0.45 times),
// the largest being 1.
std::vector<double> draw_shaking(KeyedRandom& random, Shaking kind, const ShakingRange& range, double dt_s,
                                 double duration_s);

// The vertical companion of a motion: as long, of higher frequency, peak 1.
std::vector<double> draw_vertical(KeyedRandom& random, double dt_s, std::size_t samples);

}  // namespace freestand::test
