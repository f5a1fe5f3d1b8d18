#include <cmath>

#include "base/units.hpp"
#include "intensity/intensity.hpp"

namespace freestand::intensity {

// Above 1 the block starts to rock (if it does not slide). tan(alpha) is that of the weaker side.
const Register pga_over_g_tan_alpha{{
    .name = "pga_over_g_tan_alpha",
    .unit = "1",
    .symbol = "PGA/(g tan α)",
    .summary = "peak floor acceleration over the acceleration that starts rocking, of the block as it is stated, without effects",
    .source = "[KM05 ch. 6], uplift at a = g tan(alpha)",
    .value = [](const Input& in) { return in.peaks().pga_mps2 / (standard_gravity_mps2 * std::tan(in.alpha_rad)); },
    .proportional = true,
}};

}  // namespace freestand::intensity
