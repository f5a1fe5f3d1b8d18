#include "edp/edp.hpp"

namespace freestand::edp {

const Register slid_path{{
    .name = "slid_path_m",
    .unit = "m",
    .symbol = "S",
    .summary = "length of the path that the contact has slid, in the plane of the floor where that moves in both "
               "horizontal directions",
    .source = "integral of |slip speed|",
    .still = 1e-4,
    .default_capacities = {0.1, 0.2, 0.5, 1},
    .value = [](const Input& in) { return in.response.slid_path_m; },
}};

}  // namespace freestand::edp
