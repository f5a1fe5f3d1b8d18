#include "effects/effects.hpp"

namespace freestand::effects {

const Register flexible_legs{{
    .name = "flexible_legs",
    .summary = "The foot slips and the block sways over it on flexible legs",
    .law = "force of the legs -m (W^2 y + 2 z W y'), W = 2 pi f, y = deflection; never above friction; slip is "
           "measured over the legs",
    .source = "block on an elastic support in series with Coulomb friction: Iwan, The dynamic response of bilinear "
              "hysteretic systems, Caltech EERL (1961)",
    .suspect = "the block moves a little while it ought to be stuck; after a stop it rings at a frequency of its own",
    .parameters =
        {
            {.name = "frequency_hz",
             .unit = "Hz",
             .summary = "f: sway of the block over a stuck foot",
             .lower = 0.2,
             .upper = 1000,
             .neutral = infinity,
             .low = 1.5,
             .high = 12},
            {.name = "damping",
             .unit = "1",
             .summary =
                 "z: share of critical damping of that sway; the least makes a slipping foot follow its legs at once",
             .lower = 0.005,
             .upper = 1,
             .fallback = 0.02,
             .low = 0.01,
             .high = 0.1},
        },
    .excludes = {"bouc_wen", "rock", "wall_impact"},
    .legs =
        [](Legs& legs, const Parameters& p) {
          legs.frequency_radps = 2 * pi * p[0];
          legs.damping = p[1];
        },
    .settling_s = [](const Parameters& p) { return 1 / p[0]; },
}};

}  // namespace freestand::effects
