#include "edp/edp.hpp"

namespace freestand::edp {

const Register wall_speed{{
    .name = "wall_speed_mps",
    .unit = "m/s",
    .symbol = "V_w",
    .summary = "largest speed at which an edge of the block struck a wall, or a neighbour; 0 where none did",
    .source = "effect wall_impact, the wall behind a chain, and neighbour",
    .censored = false,
    .wants = Wants::wall,
    .by_default = false,
    .default_capacities = {0.1, 0.2, 0.4, 0.8},
    .value = [](const Input& in) { return in.response.wall_speed_mps; },
}};

}  // namespace freestand::edp
