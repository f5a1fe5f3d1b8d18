#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_chain_force{{
    .name = "peak_chain_force_n",
    .unit = "N",
    .symbol = "P",
    .summary = "largest pull of one chain to the wall; 0 where none was taut",
    .source = "[KM05 ch. 9]",
    .wants = Wants::chain_force,
    .by_default = false,
    .default_capacities = {500, 1000, 2000, 4000},
    .value = [](const Input& in) { return in.response.peak_chain_force_mps2 * in.specimen.block.mass_kg; },
}};

}  // namespace freestand::edp
