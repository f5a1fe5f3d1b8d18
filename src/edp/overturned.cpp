#include "edp/edp.hpp"

namespace freestand::edp {

const Register overturned{{
    .name = "overturned",
    .unit = "1",
    .symbol = "overturned",
    .summary = "1 when the block fell over, else 0",
    .source = "|theta| > pi/2",
    .binary = true,
    .censored = false,
    .value = [](const Input& in) { return in.response.outcome == Outcome::overturned ? 1.0 : 0.0; },
}};

}  // namespace freestand::edp
