// Random cases of model bouc_wen: those of random_cases.hpp on contacts from 1e-5 in to 1 in, exponents from 1 to 50.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/keyed_random.hpp"
#include "support/random_cases.hpp"

namespace freestand::test {

struct BoucWenFamily {
  std::uint64_t seed = 1;
  double yield_low_m = 2.54e-7, yield_high_m = 2.54e-2;  // log-uniform
  double exponent_high = 50;
  double other_shapes = 0.3;  // chance of gamma and beta other than 1/2
  double vertical = 0.4, vertical_peak_g = 0.8;
  double longest_s = 3;  // the motion is shorter on a stiffer contact, which rings faster
};

inline RandomCase random_bouc_wen_case(const BoucWenFamily& family, std::uint64_t number) {
  KeyedRandom random(family.seed, number);
  BoucWen law;
  law.yield_displacement_m = random.log_uniform(family.yield_low_m, family.yield_high_m);
  law.exponent = random.chance(0.3) ? std::floor(random.uniform(1, 4)) : random.log_uniform(1, family.exponent_high);
  if (random.chance(family.other_shapes)) {
    law.gamma = random.uniform(0.3, 1);
    law.beta = law.gamma * random.uniform(-0.6, 1);
  }
  CaseFamily motions;
  motions.seed = family.seed;
  motions.alpha_low = motions.alpha_high = 1.4;  // friction alone sets the threshold
  motions.vertical = family.vertical;
  motions.vertical_peak_g = family.vertical_peak_g;
  motions.duration_high_s = std::min(family.longest_s, 0.4 + 0.6 * std::sqrt(law.yield_displacement_m / 2.54e-4));
  motions.duration_low_s = 0.6 * motions.duration_high_s;
  motions.excess_low = 0.5;
  RandomCase result = random_case(motions, number);
  result.specimen.model = Model::bouc_wen;
  result.specimen.friction.mu_k = result.specimen.friction.mu_s;
  result.specimen.bouc_wen = law;
  return result;
}

inline std::string text(const BoucWen& law) {
  char line[100];
  std::snprintf(line, sizeof line, "u_y %.3e m, n %.3f, gamma %.3f, beta %.3f; ", law.yield_displacement_m,
                law.exponent, law.gamma, law.beta);
  return line;
}

}  // namespace freestand::test
