#include "effects/effects.hpp"

namespace freestand::effects {

const Register rate_weakening{{
    .name = "rate_weakening",
    .summary = "Friction falls with slip speed",
    .law = "mu(w) = mu [1 - d (1 - exp(-|w|/c))]",
    .source = "exponential form of the velocity-dependent friction of sliding bearings: Constantinou, Mokha & "
              "Reinhorn, J. Struct. Eng. 116 (1990)",
    .suspect = "friction recovered from the motion falls as the slip gets faster; large slips are underpredicted, "
               "small ones are right",
    .parameters =
        {
            {.name = "drop",
             .unit = "1",
             .summary = "d: largest change of friction as a share of it",
             .lower = 0,
             .upper = 1,
             .neutral = 0,
             .low = 0.1,
             .high = 0.6},
            {.name = "speed_mps",
             .unit = "m/s",
             .summary = "c: slip speed at which 63 % of the change has come",
             .lower = 0,
             .upper = infinity,
             .lower_open = true,
             .low = 0.02,
             .high = 0.5},
        },
    // A foot without mass has no one speed where friction falls faster with the speed than the legs' damping rises.
    .excludes = {"flexible_legs"},
    .twins = "static_friction, where c is small: r = 1/(1 - d). Parted by slow slips.",
    .friction = [](const At& at, const Parameters& p) { return 1.0 - p[0] * (1.0 - exp(-at.speed / p[1])); },
}};

}  // namespace freestand::effects
