#include "edp/edp.hpp"

namespace freestand::edp {

const Register wall_hit{{
    .name = "wall_hit",
    .unit = "1",
    .symbol = "wall hit",
    .summary = "1 when an edge of the block has struck a wall or a neighbour, else 0",
    .source = "effect wall_impact, the wall behind a chain, and neighbour",
    .binary = true,
    .censored = false,
    .wants = Wants::wall,
    .by_default = false,
    .value = [](const Input& in) { return in.response.wall_hits > 0 ? 1.0 : 0.0; },
}};

}  // namespace freestand::edp
