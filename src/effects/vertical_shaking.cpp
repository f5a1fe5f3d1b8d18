#include "effects/effects.hpp"

namespace freestand::effects {

const Register vertical_shaking{{
    .name = "vertical_shaking",
    .summary = "The floor shakes up and down as well",
    .law = "g' = g + s v(t), v = vertical acceleration of the floor, up positive",
    .source = "[KM05 6.10 with vertical acceleration]",
    .suspect = "the misfit follows the measured vertical motion of the floor",
    .parameters =
        {
            {.name = "scale",
             .unit = "1",
             .summary = "s: factor on the vertical channel",
             .lower = 0,
             .upper = 10,
             .neutral = 0,
             .fallback = 1,
             .low = 0.3,
             .high = 1.5,
             .fitted = false},
        },
    .floor = [](FloorInput& floor, const Parameters& p) { floor.vertical_scale = p[0]; },
}};

}  // namespace freestand::effects
