#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_slip_right{{
    .name = "peak_slip_right_m",
    .unit = "m",
    .symbol = "U_right",
    .summary =
        "largest displacement of the middle of the base to the right, relative to the floor; wants slip_by_side: true",
    .source = "[KM05 ch. 5], by side",
    .wants = Wants::sides,
    .by_default = false,
    .still = 1e-4,
    .default_capacities = {0.05, 0.1, 0.2, 0.4},
    .value = [](const Input& in) { return in.response.peak_slip_right_m; },
}};

}  // namespace freestand::edp
