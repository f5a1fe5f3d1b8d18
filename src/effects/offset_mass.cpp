#include "effects/effects.hpp"

namespace freestand::effects {

const Register offset_mass{{
    .name = "offset_mass",
    .summary = "The centre of mass is not over the middle of the base",
    .law = "centre of mass at e b to the right of the middle: b_r = b (1 - e), b_l = b (1 + e)",
    .source = "geometry of the eccentric block: [KM05 ch. 6]",
    .suspect = "the block rocks to one side more easily than to the other",
    .parameters =
        {
            {.name = "eccentricity",
             .unit = "1",
             .summary = "e: offset over the half width, to the right",
             .lower = -0.9,
             .upper = 0.9,
             .neutral = 0,
             .low = -0.3,
             .high = 0.3},
        },
    .excludes = {"slide", "bouc_wen"},
    .specimen =
        [](Specimen& s, const Parameters& p) {
          s.block.right_m *= 1 - p[0];
          s.block.left_m *= 1 + p[0];
        },
}};

}  // namespace freestand::effects
