#include <cmath>

#include "intensity/intensity.hpp"
#include "motion/spectrum.hpp"

namespace freestand::intensity {
namespace {

// Records are integrated once, in their summary; pulses anew for each sample, since each has its own period.
double housner_m(const Input& in) {
  const bool known = in.shaking.stretch == 1 && in.summary.housner_m >= 0;
  const double unscaled =
      known ? in.summary.housner_m : motion::housner_intensity_m(*in.shaking.motion, in.shaking.stretch);
  return std::abs(in.shaking.scale) * unscaled;
}

const Register here{{
    .name = "housner_m",
    .unit = "m",
    .symbol = "SI",
    .summary = "Housner intensity: pseudo-velocity spectrum integrated over periods 0.1 to 2.5 s, 5 % damping",
    .source = "Housner (1952)",
    .needs = [](motion::SummaryRequest& request, double) { request.housner = true; },
    .value = housner_m,
    .proportional = true,
}};

}  // namespace
}  // namespace freestand::intensity
