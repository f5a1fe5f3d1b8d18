#include "effects/effects.hpp"

namespace freestand::effects {

namespace {

// Of the spring and its damper, over the mass of the contents.
dynamics::Value pull(const At& at, const Parameters& p) {
  const double W = 2 * pi * p[1];
  return W * W * at.own_state[0] + 2 * p[2] * W * at.own_state[1];
}

}  // namespace

const Register moving_contents{{
    .name = "moving_contents",
    .summary = "A part of the mass hangs inside on a spring",
    .law = "q'' = -(x_c'' + a) - W^2 q - 2 z W q', its force r m (W^2 q + 2 z W q') on the block, W = 2 pi f; friction "
           "keeps the full weight",
    .source = "mass on a spring in a sliding block: Newmark (1965) block with a secondary oscillator",
    .suspect = "the misfit oscillates at a frequency of its own, stronger under motions near it",
    .parameters =
        {
            {.name = "mass_ratio",
             .unit = "1",
             .summary = "r: share of the mass that moves",
             .lower = 0,
             .upper = 0.95,
             .neutral = 0,
             .low = 0.05,
             .high = 0.5},
            {.name = "frequency_hz",
             .unit = "Hz",
             .summary = "f: of the contents, block held still",
             .lower = 0.05,
             .upper = 1000,
             .low = 0.5,
             .high = 6},
            {.name = "damping",
             .unit = "1",
             .summary = "z: share of critical damping of the contents, block held still",
             .lower = 0,
             .upper = 2,
             .fallback = 0.02,
             .low = 0.01,
             .high = 0.2},
        },
    .force = [](const At& at, const Parameters& p) { return p[0] * pull(at, p); },
    .contents = pull,
    .carried_mass = [](const Parameters& p) { return 1 - p[0]; },
    .states = {{.name = "contents_m", .rate = [](const At& at, const Parameters&) { return at.own_state[1]; }},
               {.name = "contents_mps",
                .rate =
                    [](const At& at, const Parameters& p) {
                      const double W = 2 * pi * p[1];
                      return -at.acceleration - W * W * at.own_state[0] - 2 * p[2] * W * at.own_state[1];
                    },
                .relative_velocity = true}},
    .settling_s = [](const Parameters& p) { return 1 / p[1]; },
}};

}  // namespace freestand::effects
