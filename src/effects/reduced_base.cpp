#include "effects/effects.hpp"

namespace freestand::effects {

const Register reduced_base{{
    .name = "reduced_base",
    .summary = "The corners are crushed or rounded",
    .law = "b becomes b (1 - r); the inertia about the centre of mass stays",
    .source = "rounded contact: Shenton & Jones, J. Eng. Mech. 117 (1991)",
    .suspect = "rocking starts earlier than b/h says, and is slower",
    .parameters =
        {
            {.name = "ratio",
             .unit = "1",
             .summary = "r: share of the half width that is lost",
             .lower = 0,
             .upper = 0.9,
             .neutral = 0,
             .low = 0.01,
             .high = 0.25},
        },
    .excludes = {"slide", "bouc_wen"},
    .specimen =
        [](Specimen& s, const Parameters& p) {
          s.block.left_m *= 1 - p[0];
          s.block.right_m *= 1 - p[0];
        },
}};

}  // namespace freestand::effects
