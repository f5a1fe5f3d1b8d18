// Band-pass filter of a record, without shift of phase.
//
// Each frequency f of the samples is multiplied with
//   |H(f)|^2 = 1 / (1 + (low/f)^(2n)) / (1 + (f/high)^(2n)),   n = 4,
// the squared gain of a Butterworth filter of order n: what comes out of that filter run forwards and then backwards. At a
// corner half of the amplitude is left. (Butterworth 1930; acausal filters of records: Boore & Akkar 2003.)
#pragma once

#include <freestand/floor_motion.hpp>

namespace freestand::motion {

struct BandPass {
  double low_hz = 0, high_hz = 0;  // corners, 0 < low < high
};

inline constexpr int band_pass_order = 4;

// |H(f)|^2.
double band_pass_gain(const BandPass& band, double frequency_hz);

// Both channels of a record, by FFTW with zeros at both ends, so many that what leaves at one end does not come in at the other
// (a part of 1e-8). These zeros stay, 7.7 periods of the lower corner at each end: they hold what the filter makes before
// and after the record, without which the floor would drift. Throws Error (Exit::data) where the upper corner is not below
// half the sampling rate, or the record is shorter than a period of the lower one.
FloorMotion band_pass(const FloorMotion& record, const BandPass& band);

}  // namespace freestand::motion
