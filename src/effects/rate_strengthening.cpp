#include "effects/effects.hpp"

namespace freestand::effects {

const Register rate_strengthening{{
    .name = "rate_strengthening",
    .summary = "Friction grows with slip speed",
    .law = "mu(w) = mu [1 + d (1 - exp(-|w|/c))]",
    .source = "exponential form of the velocity-dependent friction of sliding bearings: Constantinou, Mokha & "
              "Reinhorn, J. Struct. Eng. 116 (1990)",
    .suspect = "friction recovered from the motion grows as the slip gets faster; large slips are overpredicted, small "
               "ones are right",
    .parameters =
        {
            {.name = "rise",
             .unit = "1",
             .summary = "d: largest change of friction as a share of it",
             .lower = 0,
             .upper = 10,
             .neutral = 0,
             .low = 0.1,
             .high = 1.0},
            {.name = "speed_mps",
             .unit = "m/s",
             .summary = "c: slip speed at which 63 % of the change has come",
             .lower = 0,
             .upper = infinity,
             .lower_open = true,
             .low = 0.02,
             .high = 0.5},
        },
    .twins = "viscous_drag, where speeds stay well below c: parted by slips that are fast against c, or by a vertical "
             "channel.",
    .friction = [](const At& at, const Parameters& p) { return 1.0 + p[0] * (1.0 - exp(-at.speed / p[1])); },
}};

}  // namespace freestand::effects
