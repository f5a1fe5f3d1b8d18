#include "base/units.hpp"
#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_contact_horizontal{{
    .name = "peak_contact_horizontal_over_weight",
    .unit = "1",
    .symbol = "F_x/W",
    .summary = "largest force of the floor on the block along the floor, over its weight; blows left out, as is what "
               "is brief beside a wall (peak_acceleration_g)",
    .source = "momentum of the block, f_x and f_y of [KM05 ch. 6]",
    .wants = Wants::forces,
    .by_default = false,
    .default_capacities = {0.1, 0.2, 0.4, 0.8},
    .value = [](const Input& in) { return in.response.peak_contact_horizontal_mps2 / standard_gravity_mps2; },
}};

}  // namespace freestand::edp
