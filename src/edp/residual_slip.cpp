#include <cmath>

#include "edp/edp.hpp"

namespace freestand::edp {

const Register residual_slip{{
    .name = "residual_slip_m",
    .unit = "m",
    .symbol = "|u_res|",
    .summary = "displacement of the middle of the base that remains, without its sign; size of the vector where the "
               "floor moves in "
               "both horizontal directions",
    .source = "[KM05 ch. 4]",
    .still = 1e-4,
    .default_capacities = {0.05, 0.1, 0.2, 0.4},
    .value = [](const Input& in) { return std::hypot(in.response.residual_slip_m, in.response.residual_cross_slip_m); },
}};

}  // namespace freestand::edp
