#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_slip{{
    .name = "peak_slip_m",
    .unit = "m",
    .symbol = "U",
    .summary = "largest displacement of the middle of the base relative to the floor; size of the vector where the "
               "floor moves in "
               "both horizontal directions",
    .source = "[KM05 ch. 5]",
    .still = 1e-4,
    .default_capacities = {0.05, 0.1, 0.2, 0.4},
    .value = [](const Input& in) { return in.response.peak_slip_m; },
}};

}  // namespace freestand::edp
