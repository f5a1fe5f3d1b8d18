#include "effects/effects.hpp"

namespace freestand::effects {

const Register friction_wear{{
    .name = "friction_wear",
    .summary = "Friction changes as the contact wears, with the path slid so far",
    .law = "mu(S) = mu [r + (1 - r) exp(-S/l)], S = path slid",
    .source = "exponential form of running-in: Blau, Tribology International 38 (2005)",
    .suspect =
        "early slips of a test fit and later ones do not; friction recovered from the motion drifts with the slid path",
    .parameters =
        {
            {.name = "ratio",
             .unit = "1",
             .summary = "r: friction after a long path over friction at first",
             .lower = 0,
             .upper = 10,
             .neutral = 1,
             .low = 0.5,
             .high = 1.6},
            {.name = "path_m",
             .unit = "m",
             .summary = "l: path over which it changes",
             .lower = 0,
             .upper = infinity,
             .lower_open = true,
             .low = 0.05,
             .high = 2.0},
        },
    .friction = [](const At& at, const Parameters& p) { return p[0] + (1.0 - p[0]) * exp(-at.path / p[1]); },
}};

}  // namespace freestand::effects
