#include <cmath>

#include "base/units.hpp"
#include "intensity/intensity.hpp"

namespace freestand::intensity {

const Register p_pgv_over_g_tan_alpha{{
    .name = "p_pgv_over_g_tan_alpha",
    .unit = "1",
    .symbol = "p PGV/(g tan α)",
    .summary = "peak floor velocity over the velocity that a block of this size and slenderness needs to rock far",
    .source = "dimensionless velocity of rocking blocks, as in Dimitrakopoulos & Paraskeva (2015)",
    .value =
        [](const Input& in) {
          return in.p_radps * in.peaks().pgv_mps / (standard_gravity_mps2 * std::tan(in.alpha_rad));
        },
    .proportional = true,
}};

}  // namespace freestand::intensity
