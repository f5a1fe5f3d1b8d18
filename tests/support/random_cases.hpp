// Random specimens and floor motions, each a pure function of its number.
#pragma once

#include <cstdint>
#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>
#include <memory>
#include <string>

namespace freestand::test {

struct RandomCase {
  Specimen specimen;
  std::shared_ptr<const FloorMotion> motion;
  Shaking shaking;           // of *motion
  std::string text() const;  // one line that describes the case, for messages
};

// What a family of cases is drawn from. Chances are probabilities in [0, 1].
struct CaseFamily {
  std::uint64_t seed = 1;
  double alpha_low = 0.1, alpha_high = 1.2;  // atan(b/h)
  double size_low_m = 0.3, size_high_m = 4;  // R, log-uniform
  double mu_low = 0.05, mu_high = 1.2;       // mu_s
  double two_coefficients = 0.5;             // chance of mu_k < mu_s (down to mu_s/2)
  double asymmetric = 0.25;                  // chance of unequal half widths and a given inertia
  double vertical = 0.4;                     // chance of vertical shaking
  double vertical_peak_g = 0.8;              // at most
  double coulomb = 0.5;                      // chance of the `coulomb` impact law
  double one_model = 0.15;                   // chance of Model::slide or Model::rock
  double duration_low_s = 5, duration_high_s = 10;
  double excess_low = 0.7, excess_high = 5;  // peak acceleration over the least that moves the block
  double pulse = 0.5;                        // chance that sine pulses are added to the noise
};

// Case number `number` of a family. The motion is piecewise linear: white noise through a damped oscillator under an
// envelope, with or without a sine pulse of 0.3 to 2 s.
RandomCase random_case(const CaseFamily& family, std::uint64_t number);

}  // namespace freestand::test
