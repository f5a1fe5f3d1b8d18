// What the measured motion itself says of the forces, without any model of an effect.
//
// While the block slips, mu_eff = -(u'' + a) sigma/g' and the force that the model lacks is
// F = u'' + a + sigma mu_k g' [m/s2], u'' from the smoothed slip within one slip of one direction, so that starts and
// stops stay sharp. Rotating blocks are left out: there f_y is not known without a model.
#pragma once

#include <string>
#include <vector>

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

// Mean over the samples of a bin, each for as long as it stands, with their standard deviation and a band of 95 % for the
// mean: what the sensors' noise makes of it, reading by reading, and what the scatter beyond the noise does, a slip for a unit.
struct RecoveredTable {
  std::string variable, unit;  // speed_mps, path_m, direction, position_m, normal_g, time_s
  std::vector<double> edge, centre, mu, mu_deviation, mu_lower, mu_upper, force_mps2, force_lower_mps2,
      force_upper_mps2;
  std::vector<double> count;
  double share_explained = 0;  // of the variance of mu_eff among its samples, by the bins
  double share_of_force_explained =
      0;  // of that of the force: one that goes by the position cancels in mu_eff, there and back
  double share_by_chance = 0,
         share_of_force_by_chance = 0;  // of the same, where the means of the bins differ by their bands alone
  // The friction that the model `shown` gives at the same samples, mean of each bin (nan: it is more than the motion of
  // the base tells); and whether it changes with this variable while the others stay.
  std::vector<double> law, law_force_mps2;  // as friction, and as the force that the base lacks
  bool law_follows = false;
};

struct Recovered {
  std::size_t samples = 0;
  double mean_mu = 0, sample_noise_mu = 0;  // of single samples, from the sensor's noise
  std::vector<RecoveredTable> tables;
};

// Of the calibration tests. mu_k: of the base model. shown, at x: whose law stands beside what is recovered, and which
// says whether the vertical channel counts in g'.
Recovered recover(const Bench&, double mu_k, const ModelSpec& shown, std::span<const double> x);

}  // namespace freestand::measurement
