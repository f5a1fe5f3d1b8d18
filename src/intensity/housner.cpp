#include <cmath>

#include "intensity/intensity.hpp"
#include "motion/spectrum.hpp"

namespace freestand::intensity {

const Register housner{{
    .name = "housner_m",
    .unit = "m",
    .symbol = "SI",
    .summary = "Housner intensity: pseudo-velocity spectrum integrated over periods 0.1 to 2.5 s, 5 % damping",
    .source = "Housner (1952)",
    .damping = motion::usual_damping,
    .value = [](const Input& in) { return std::abs(in.scale) * motion::housner_intensity_m(in.motion, in.stretch); },
    .proportional = true,
    .spectral = true,
}};

}  // namespace freestand::intensity
