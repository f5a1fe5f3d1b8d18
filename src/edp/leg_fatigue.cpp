#include "edp/edp.hpp"

namespace freestand::edp {

const Register leg_fatigue{{
    .name = "leg_fatigue_m",
    .unit = "m",
    .symbol = "y_1",
    .summary = "amplitude of the one cycle of sway that tires the legs as much as all cycles together",
    .source = "rainflow cycles of the legs' deflection (ASTM E1049), damage as the third power of their amplitudes (EN "
              "1993-1-9)",
    .wants = Wants::legs,
    .by_default = false,
    .default_capacities = {0.005, 0.01, 0.02},
    .value = [](const Input& in) { return in.response.leg_fatigue_m; },
}};

}  // namespace freestand::edp
