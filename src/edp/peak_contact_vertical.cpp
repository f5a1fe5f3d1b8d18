#include "base/units.hpp"
#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_contact_vertical{{
    .name = "peak_contact_vertical_over_weight",
    .unit = "1",
    .symbol = "F_y/W",
    .summary = "largest force of the block on the floor, across it, over its weight, which it is at rest; blows left "
               "out, as is what is brief beside a wall (peak_acceleration_g)",
    .source = "momentum of the block, f_x and f_y of [KM05 ch. 6]",
    .wants = Wants::forces,
    .by_default = false,
    .still = 1.001,
    .default_capacities = {1.1, 1.25, 1.5, 2},
    .value = [](const Input& in) { return in.response.peak_contact_vertical_mps2 / standard_gravity_mps2; },
}};

}  // namespace freestand::edp
