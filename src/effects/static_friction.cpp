#include "effects/effects.hpp"

namespace freestand::effects {

const Register static_friction{{
    .name = "static_friction",
    .summary = "Friction is higher before a slip starts than during it",
    .law = "mu_s = r mu_k, r >= 1",
    .source = "[KM05 ch. 4, slow-pull tests]; Coulomb 1785",
    .suspect =
        "slips start later and with a jerk; the block stays stuck in cycles whose friction would be enough to slip",
    .parameters =
        {
            {.name = "ratio",
             .unit = "1",
             .summary = "static over kinetic friction coefficient",
             .lower = 1,
             .upper = 10,
             .neutral = 1,
             .low = 1.05,
             .high = 1.8},
        },
    .excludes = {"bouc_wen"},
    .twins = "rate_weakening, where its speed_mps is small: r = 1/(1 - d). Parted by slow slips.",
    .specimen = [](Specimen& s, const Parameters& p) { s.friction.mu_s = p[0] * s.friction.mu_k; },
}};

}  // namespace freestand::effects
