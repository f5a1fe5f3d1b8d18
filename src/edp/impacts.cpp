#include "edp/edp.hpp"

namespace freestand::edp {

const Register impacts{{
    .name = "impacts",
    .unit = "1",
    .symbol = "impacts",
    .summary = "number of impacts after rotations of at least a thousandth of alpha, and of landings",
    .source = "[KM05 ch. 6]",
    .default_capacities = {1, 5, 10, 20},
    .value = [](const Input& in) { return static_cast<double>(in.response.impacts); },
}};

}  // namespace freestand::edp
