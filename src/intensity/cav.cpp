#include <cmath>

#include "intensity/intensity.hpp"

namespace freestand::intensity {

const Register cav{{
    .name = "cav_mps",
    .unit = "m/s",
    .symbol = "CAV",
    .summary = "cumulative absolute velocity: integral of the absolute acceleration of the floor",
    .source = "EPRI (1988), without a threshold",
    .value = [](const Input& in) { return std::abs(in.scale) * in.stretch * in.motion.cav_mps; },
    .proportional = true,
}};

}  // namespace freestand::intensity
