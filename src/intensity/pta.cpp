#include "base/units.hpp"
#include "intensity/intensity.hpp"

namespace freestand::intensity {

// The shaking table of the tests is the floor of the sweep: the same number as pga_g under the report's name.
const Register pta{{
    .name = "pta_g",
    .unit = "g",
    .symbol = "PTA",
    .summary = "peak acceleration of the shaking table or floor, as the report calls it; equals pga_g",
    .source = "[KM05 ch. 5]",
    .value = [](const Input& in) { return in.peaks().pga_mps2 / standard_gravity_mps2; },
    .proportional = true,
}};

}  // namespace freestand::intensity
