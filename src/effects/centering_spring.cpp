#include "effects/effects.hpp"

namespace freestand::effects {

const Register centering_spring{{
    .name = "centering_spring",
    .summary = "A spring that pulls the block back to where it stood",
    .law = "force -m (2 pi f)^2 u through the centre of mass, u = slip of the base",
    .source = "linear spring of cables, hoses or a dished floor",
    .suspect =
        "residual slips are smaller than they should be and later slips start more easily back towards the middle",
    .parameters =
        {
            {.name = "frequency_hz",
             .unit = "Hz",
             .summary = "f: sqrt(stiffness/mass)/(2 pi)",
             .lower = 0,
             .upper = 1000,
             .neutral = 0,
             .low = 0.15,
             .high = 1.5},
        },
    .twins = "slack_tether with little slack, on data whose slips go one way only.",
    .force =
        [](const At& at, const Parameters& p) {
          const double W = 2 * pi * p[0];
          return -(W * W) * at.u;
        },
}};

}  // namespace freestand::effects
