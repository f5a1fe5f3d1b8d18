#include "base/units.hpp"
#include "intensity/intensity.hpp"

namespace freestand::intensity {

// At mu_k = 0 there is no such number: +inf.
const Register report{{
    .name = "report",
    .unit = "1",
    .symbol = "PTA/(μg) − 1",
    .summary = "how far the peak floor acceleration exceeds the friction, PTA/(mu_k g) - 1",
    .source = "[KM05 5.6]",
    .value = [](const Input& in) { return in.peaks().pga_mps2 / (in.mu_k * standard_gravity_mps2) - 1; },
}};

}  // namespace freestand::intensity
