#include <cmath>

#include "base/units.hpp"
#include "intensity/intensity.hpp"
#include "motion/spectrum.hpp"

namespace freestand::intensity {

const Register sa{{
    .name = "sa_g",
    .unit = "g",
    .symbol = "Sa(T)",
    .summary = "pseudo-spectral acceleration of a 5 % damped oscillator of period T",
    .source = "w^2 max |u|, closed form for piecewise polynomial floor motion",
    .parameter = Parameter{"period_s", 1.0},
    .damping = motion::usual_damping,
    .value =
        [](const Input& in) {
          return std::abs(in.scale) * motion::spectral_acceleration_mps2(in.motion, in.parameter, in.stretch) /
                 standard_gravity_mps2;
        },
    .proportional = true,
    .spectral = true,
}};

}  // namespace freestand::intensity
