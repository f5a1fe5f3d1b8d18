#include "edp/edp.hpp"

namespace freestand::edp {

// A blow of rigid bodies has no acceleration; what it does to something that is fastened to the block is the jump of its
// velocity.
const Register largest_blow{{
    .name = "largest_blow_mps",
    .unit = "m/s",
    .symbol = "dV_z",
    .summary =
        "largest jump of velocity at acceleration_height_m in a blow of the floor or of a wall; 0 where none came",
    .source = "impacts of [KM05 6.17, 6.32] and walls",
    .wants = Wants::height,
    .by_default = false,
    .default_capacities = {0.1, 0.2, 0.4, 0.8},
    .value = [](const Input& in) { return in.response.largest_blow_mps; },
}};

}  // namespace freestand::edp
