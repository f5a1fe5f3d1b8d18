#include "effects/effects.hpp"

namespace freestand::effects {

const Register wall_impact{{
    .name = "wall_impact",
    .summary = "A wall at a gap on one side, or on both",
    .law =
        "the edge of the side face that reaches it comes back with e times its speed, by a push of the wall at that "
        "edge "
        "(an upright block's whole face touches: it stays upright); what then presses against the wall the wall takes",
    .source = "Newton's law of restitution, impulses on a rigid body, Coulomb's law at the floor",
    .suspect = "slips to one side stop or turn back at once at a certain displacement",
    .parameters =
        {
            {.name = "gap_m",
             .unit = "m",
             .summary = "free displacement; its sign is the side of the wall, unless `side` says it (0: on the right)",
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
            {.name = "side",
             .unit = "1",
             .summary = "side of the wall, whatever the sign of gap_m: above 0 on the right, below on the left; 0: by "
                        "that sign",
             .lower = -1,
             .upper = 1,
             .fallback = 0,
             .low = -1,
             .high = 1,
             .fitted = false},
            {.name = "other_gap_m",
             .unit = "m",
             .summary = "free displacement to a second wall, on the other side; below 0: there is none",
             .lower = -1,
             .upper = 10,
             .fallback = -1,
             .low = 0,
             .high = 0.1,
             .fitted = false},
        },
    .excludes = {"rock", "bouc_wen", "flexible_legs"},
    .twins =
        "slack_tether, where it is stiff: without a dashpot it is a wall that gives back all. Parted by the length of "
        "the rebound, 1/(2 f).",
    .wall =
        [](Walls& walls, const Parameters& p) {
          // A caller of the library may leave the last two out.
          const double side = p.size() > 2 ? p[2] : 0, other = p.size() > 3 ? p[3] : -1;
          const int first = (side != 0 ? side : p[0]) < 0 ? -1 : 1;
          walls.stand(first, std::abs(p[0]), p[1]);
          if (other >= 0) walls.stand(-first, other, p[1]);
        },
}};

}  // namespace freestand::effects
