#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_leg_deflection{{
    .name = "peak_leg_deflection_m",
    .unit = "m",
    .symbol = "y",
    .summary = "largest sway of the block over its foot",
    .source = "effect flexible_legs: deflection of the legs",
    .wants = Wants::legs,
    .by_default = false,
    .default_capacities = {0.005, 0.01, 0.02},
    .value = [](const Input& in) { return in.response.peak_leg_deflection_m; },
}};

}  // namespace freestand::edp
