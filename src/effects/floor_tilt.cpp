#include "effects/effects.hpp"

namespace freestand::effects {

const Register floor_tilt{{
    .name = "floor_tilt",
    .summary = "The floor is not level",
    .law = "g sin(beta) is added to the acceleration of the floor along it, g cos(beta) replaces g",
    .source = "statics of the inclined plane",
    .suspect = "the block creeps one way, also under motions without a bias; residual slips share a sign",
    .parameters =
        {
            {.name = "angle_rad",
             .unit = "rad",
             .summary = "beta: positive pushes the block to the left, as a floor that accelerates to the right does",
             .lower = -0.5,
             .upper = 0.5,
             .neutral = 0,
             .low = -0.06,
             .high = 0.06},
        },
    .twins =
        "directional_friction, for a block that only slides without vertical shaking: tan(beta) = mu d is the same "
        "equation. Parted by another mu, by rocking, by a vertical channel, or by static friction.",
    .floor =
        [](FloorInput& floor, const Parameters& p) {
          floor.push_mps2 += standard_gravity_mps2 * std::sin(p[0]);
          floor.gravity_factor *= std::cos(p[0]);
        },
}};

}  // namespace freestand::effects
