#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "intensity/intensity.hpp"
#include "motion/spectrum.hpp"

namespace freestand::intensity {
namespace {

// Sa of motion(t / s) at T is that of motion(t) at T / s.
double spectral_acceleration_g(const Input& in) {
  const double period = in.parameter / in.shaking.stretch;
  const auto& known = in.summary.sa_period_s;
  const auto place = std::lower_bound(known.begin(), known.end(), period);
  const double unscaled = place != known.end() && *place == period
                              ? in.summary.sa_mps2[static_cast<std::size_t>(place - known.begin())]
                              : motion::spectral_acceleration_mps2(*in.shaking.motion, period);
  return std::abs(in.shaking.scale) * unscaled / standard_gravity_mps2;
}

const Register here{{
    .name = "sa_g",
    .unit = "g",
    .symbol = "Sa(T)",
    .summary = "pseudo-spectral acceleration of a 5 % damped oscillator of period T",
    .source = "w^2 max |u|, closed form for piecewise polynomial floor motion",
    .parameter = Parameter{"period_s", 1.0},
    .needs = [](motion::SummaryRequest& request, double period) { request.sa_period_s.push_back(period); },
    .value = spectral_acceleration_g,
    .proportional = true,
}};

}  // namespace
}  // namespace freestand::intensity
