#include "base/units.hpp"
#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_acceleration_at_height{{
    .name = "peak_acceleration_at_height_g",
    .unit = "g",
    .symbol = "PEA_z",
    .summary = "largest total acceleration at acceleration_height_m over the base, above the middle of its width, "
               "vector sum, blows "
               "left out, as is what is brief beside a wall (peak_acceleration_g)",
    .source = "[KM05 ch. 9], at a height",
    .wants = Wants::height,
    .by_default = false,
    .default_capacities = {0.25, 0.5, 1, 2},
    .value = [](const Input& in) { return in.response.peak_acceleration_at_height_mps2 / standard_gravity_mps2; },
}};

}  // namespace freestand::edp
