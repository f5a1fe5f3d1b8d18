#include "edp/edp.hpp"

namespace freestand::edp {

const Register connection_failed{{
    .name = "connection_failed",
    .unit = "1",
    .symbol = "connection failed",
    .summary = "1 when the connection of the chain to the wall failed, else 0",
    .source = "[KM05 ch. 9]",
    .binary = true,
    .censored = false,
    .wants = Wants::chain,
    .by_default = false,
    .value = [](const Input& in) { return in.response.connection_failed ? 1.0 : 0.0; },
}};

}  // namespace freestand::edp
