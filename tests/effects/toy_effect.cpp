// An eighteenth effect, in the test program only: what CONTRIBUTING.md shows, and what catalogue_test.cpp finds everywhere.
#include "effects/effects.hpp"

namespace freestand::effects {

const Register spilt_oil{{
    .name = "spilt_oil",
    .summary = "A slippery patch on the floor",
    .law = "mu (1 - d exp(-(u/l)^2))",
    .source = "made up for this test",
    .suspect = "friction recovered from the motion is low near one place",
    .parameters = {{.name = "drop",
                    .unit = "1",
                    .summary = "d: share of the friction that is lost in the middle of the patch",
                    .lower = 0,
                    .upper = 1,
                    .neutral = 0,
                    .low = 0.1,
                    .high = 0.9},
                   {.name = "reach_m",
                    .unit = "m",
                    .summary = "l: reach of the patch",
                    .lower = 0,
                    .upper = infinity,
                    .lower_open = true,
                    .fallback = 0.1,
                    .low = 0.02,
                    .high = 0.5}},
    .friction =
        [](const At& at, const Parameters& p) {
          const auto [drop, reach] = std::pair(p[0], p[1]);
          return 1.0 - drop * exp(-(at.u * at.u) / (reach * reach));
        },
}};

}  // namespace freestand::effects
