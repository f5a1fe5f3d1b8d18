// Synthetic floor motions: a stochastic model with a pulse on top.
//
// Filtered white noise of variance 1 (filtered_noise.hpp) times the modulating function q(t) (gamma_envelope.hpp), then a high-pass
// filter: the acceleration z'' of the critically damped oscillator
//   z'' + 2 w_c z' + w_c^2 z = q(t) x(t),   w_c = 2 pi corner,
// whose displacement z and velocity z' come to rest at zero [Rezaeian & Der Kiureghian 2008, eq. 18]. Near a fault a pulse is
// added to it, as by M. Dabaghi and A. Der Kiureghian, "Stochastic model for simulation of near-fault ground motions", Earthquake
// Engineering and Structural Dynamics 46 (2017); here one of the pulses of this folder.
//
// The filter's frequency is a line in time from the instant of 1 % of the expected Arias intensity to that of 99 %, through
// frequency_hz at middle_s, and constant before and after, so that a slope cannot turn it below zero.
#pragma once

#include <freestand/floor_motion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace freestand::motion {

struct SyntheticPulse {
  std::string type = "B";        // of find_pulse()
  double period_s = 1;           // > 0
  double peak_velocity_mps = 0;  // the largest |velocity| of the pulse alone; negative: mirrored
  double middle_s = 5;           // the middle of the pulse
};

struct SyntheticParameters {
  // Expected Arias intensity of q(t) x(t), of which the high-pass filter takes about 3 z corner/frequency; that of one motion scatters.
  double arias_mps = 1;
  double duration_s = 10;           // from 5 to 95 % of it
  double middle_s = 6;              // when 45 % of it are there
  double frequency_hz = 4;          // of the filter at middle_s: half of the zero crossings in a second
  double frequency_slope_hzps = 0;  // how fast it rises; falls where negative
  double bandwidth = 0.3;           // damping ratio of the filter, 0 < z < 1
  double corner_hz = 0.1;           // of the high-pass filter
  double step_s = 0.01;             // between samples
  std::optional<SyntheticPulse> pulse = {};
};

// Why there is no such motion, as "problem (why): what to do"; "" where there is. Each number lies within its own bounds.
std::string refusal(const SyntheticParameters&);

// So many instants at which white noise arrives: up to that of all but 1e-5 of the expected Arias intensity.
std::size_t noise_samples(const SyntheticParameters&);

// The motion of that noise (independent, normal, mean 0, standard deviation 1; noise_samples() of them). The same noise with and
// without a pulse differs by the pulse. Behind the noise it goes on until the filter has come to rest, to a millionth, and the
// pulse is over. A pulse enters each sample as its mean over the two steps around it, weighted as a straight line from sample to
// sample weights it: so that it leaves with its own velocity and displacement, jumps of its acceleration or not. Throws Error
// (Exit::usage) with the refusal.
FloorMotion synthetic_motion(const SyntheticParameters&, const std::vector<double>& white, std::string name);

}  // namespace freestand::motion
