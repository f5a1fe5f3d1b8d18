#include "effects/effects.hpp"

namespace freestand::effects {

const Register slack_tether{{
    .name = "slack_tether",
    .summary = "A tether that holds the block back beyond a slack",
    .law =
        "beyond slack_m of slip: spring m W^2 stretch and dashpot m c, pulling only, through the centre of mass; W = "
        "2 pi f",
    .source = "one-sided spring of a restraint with slack: [KM05 ch. 9]",
    .suspect = "slips to one side stop short of a certain displacement and come back",
    .parameters =
        {
            {.name = "slack_m",
             .unit = "m",
             .summary = "free displacement; its sign is the side that restrains",
             .lower = -10,
             .upper = 10,
             .low = -0.15,
             .high = 0.15},
            {.name = "frequency_hz",
             .unit = "Hz",
             .summary = "f: sqrt(stiffness/mass)/(2 pi)",
             .lower = 0,
             .upper = 1000,
             .neutral = 0,
             .low = 0.5,
             .high = 6},
            {.name = "rate_per_s",
             .unit = "1/s",
             .summary = "c: dashpot per mass",
             .lower = 0,
             .upper = 1000,
             .fallback = 0,
             .low = 0,
             .high = 4},
        },
    .twins = "centering_spring, on data whose slips go one way only; wall_impact, where the tether is stiff.",
    .force =
        [](const At& at, const Parameters& p) {
          const double side = p[0] < 0 ? -1 : 1, W = 2 * pi * p[1];
          const Value stretch = side * at.u - std::abs(p[0]);
          const Value pull = W * W * stretch + p[2] * side * at.v;
          return -side * where(stretch, positive(pull), 0.0 * pull);
        },
    .clear_within_m = [](const Parameters& p) { return std::abs(p[0]); },
}};

}  // namespace freestand::effects
