#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_rotation_over_alpha{{
    .name = "peak_rotation_over_alpha",
    .unit = "1",
    .symbol = "θ/α",
    .summary = "largest rotation over the slenderness of the block as it is given; 1: its centre of mass is over the "
               "corner, unless an effect moves either",
    .source = "[KM05 ch. 6]",
    .still = 1e-3,
    .default_capacities = {0.1, 0.25, 0.5, 0.75},
    .value = [](const Input& in) { return in.response.peak_rotation_rad / in.specimen.block.alpha_rad(); },
}};

}  // namespace freestand::edp
