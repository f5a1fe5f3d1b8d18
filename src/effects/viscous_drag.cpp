#include "effects/effects.hpp"

namespace freestand::effects {

const Register viscous_drag{{
    .name = "viscous_drag",
    .summary = "A drag in proportion to the slip velocity",
    .law = "force -m c v on the block, v = velocity of its base relative to the floor",
    .source = "linear viscous damping, e.g. of lubricated or rubber feet and of cables",
    .suspect = "fast slips are overpredicted and friction recovered from the motion grows in proportion to the speed",
    .parameters =
        {
            {.name = "rate_per_s",
             .unit = "1/s",
             .summary = "c: drag per mass and velocity",
             .lower = 0,
             .upper = 1000,
             .neutral = 0,
             .low = 0.2,
             .high = 8},
        },
    .twins = "rate_strengthening, where speeds stay well below its speed_mps: mu g d/c is the rate. Parted by fast "
             "slips, or "
             "by a vertical channel.",
    .force = [](const At& at, const Parameters& p) { return -p[0] * at.v; },
}};

}  // namespace freestand::effects
