#include "effects/effects.hpp"

namespace freestand::effects {

const Register wall_impact{{
    .name = "wall_impact",
    .summary = "A wall at a gap on one side",
    .law = "reaching the gap: w+ = -e w-, the blow acting through the centre of mass",
    .source = "Newton's law of restitution",
    .suspect = "slips to one side stop or turn back at once at a certain displacement",
    .parameters =
        {
            {.name = "gap_m",
             .unit = "m",
             .summary = "free displacement; its sign is the side of the wall",
             .lower = -10,
             .upper = 10,
             .low = -0.1,
             .high = 0.1},
            {.name = "restitution",
             .unit = "1",
             .summary = "e: share of the speed that comes back",
             .lower = 0,
             .upper = 1,
             .fallback = 0,
             .low = 0,
             .high = 0.8},
        },
    .excludes = {"rock", "bouc_wen", "flexible_legs"},
    .twins =
        "slack_tether, where it is stiff: without a dashpot it is a wall that gives back all. Parted by the length of "
        "the rebound, 1/(2 f).",
    .wall =
        [](Wall& wall, const Parameters& p) {
          wall.gap_m = p[0];
          wall.restitution = p[1];
        },
}};

}  // namespace freestand::effects
