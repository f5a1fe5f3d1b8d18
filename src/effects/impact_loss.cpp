#include "effects/effects.hpp"

namespace freestand::effects {

const Register impact_loss{{
    .name = "impact_loss",
    .summary = "Each rocking impact takes more than Housner's",
    .law = "impact keeps c times Housner's rate",
    .source = "[KM05 6.17]; Housner 1963",
    .suspect = "rocking dies out faster, or more slowly, than it should",
    .parameters =
        {
            {.name = "factor",
             .unit = "1",
             .summary = "c: rate after an impact over Housner's",
             .lower = 0,
             .upper = 1,
             .neutral = 1,
             .low = 0.7,
             .high = 0.99},
        },
    .excludes = {"slide", "bouc_wen"},
    .twins = "reduced_base loses more at each impact as well: parted by when rocking starts.",
    .specimen = [](Specimen& s, const Parameters& p) { s.impact.factor *= p[0]; },
}};

}  // namespace freestand::effects
