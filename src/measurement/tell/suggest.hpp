// The floor motion, and if need be the specimen, that would tell models apart which these tests cannot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

struct Suggestion {
  std::string pulse;
  double period_s = 0, peak_acceleration_g = 0;
  double vertical_share = 0;   // of the horizontal peak, as a vertical pulse of half the period beside it
  double friction_factor = 1;  // another pair of surfaces: mu times this
  double separation =
      0;  // least distance between two of the models, in noise units (rms); of peaks, in the scatter of the measured ones
  std::string sentence;
};

// models: as fitted, two and more. Pulses of several kinds, periods and strengths are tried on the same specimen; where
// none parts all models by 4 noise units, with a vertical component (as far as no model forbids it), and with other
// friction. The best of the simplest kind that does; else the best of all. vertical: the effect that lets vertical
// shaking in; null: none.
Suggestion suggest(const Bench&, const std::vector<ModelFit>& models, const dynamics::Effect* vertical, const Jobs&);

}  // namespace freestand::measurement
