#include "effects/effects.hpp"

namespace freestand::effects {

const Register pressure_friction{{
    .name = "pressure_friction",
    .summary = "The friction coefficient depends on the normal force",
    .law = "mu (N/(m g))^k",
    .source = "power law of dry friction of polymers: Bowden & Tabor, The Friction and Lubrication of Solids (1950)",
    .suspect = "the misfit follows the vertical motion of the floor; friction recovered from the motion changes with "
               "the normal force",
    .parameters =
        {
            {.name = "exponent",
             .unit = "1",
             .summary = "k: 0 is Coulomb, negative where pressure makes it smoother",
             .lower = -0.9,
             .upper = 3,
             .neutral = 0,
             .low = -0.4,
             .high = 0.5},
        },
    .twins = "invisible where the normal force does not change: a block that only slides on a floor without vertical "
             "shaking.",
    .friction = [](const At& at,
                   const Parameters& p) { return power_of_positive(1e-6 + positive(at.normal - 1e-6), p[0]); },
}};

}  // namespace freestand::effects
