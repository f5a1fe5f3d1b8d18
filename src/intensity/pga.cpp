#include "base/units.hpp"
#include "intensity/intensity.hpp"

namespace freestand::intensity {

const Register pga{{
    .name = "pga_g",
    .unit = "g",
    .symbol = "PGA",
    .summary = "peak acceleration of the floor",
    .source = "max |a(t)|",
    .value = [](const Input& in) { return in.peaks().pga_mps2 / standard_gravity_mps2; },
    .proportional = true,
}};

}  // namespace freestand::intensity
