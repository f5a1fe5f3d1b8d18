#include "effects/effects.hpp"

namespace freestand::effects {

const Register directional_friction{{
    .name = "directional_friction",
    .summary = "Friction differs between slips to the right and to the left",
    .law = "mu (1 + d sigma), sigma = direction of the (impending) slip",
    .source = "anisotropic friction of brushed or worn floors: Zmitrowicz, Int. J. Solids Struct. 25 (1989)",
    .suspect = "residual slips go one way under motions that do not",
    .parameters =
        {
            {.name = "asymmetry",
             .unit = "1",
             .summary = "d: excess of friction against slips to the right, as a share",
             .lower = -0.9,
             .upper = 0.9,
             .neutral = 0,
             .low = -0.3,
             .high = 0.3},
        },
    .twins =
        "floor_tilt, for a block that only slides without vertical shaking: g sin(beta) = mu d g is the same "
        "equation, d = tan(beta)/mu. Parted by another mu, by rocking, by a vertical channel, or by static friction.",
    .friction = [](const At& at, const Parameters& p) { return 1.0 + p[0] * at.sigma; },
}};

}  // namespace freestand::effects
