#include "base/units.hpp"
#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_contents_acceleration{{
    .name = "peak_contents_acceleration_g",
    .unit = "g",
    .symbol = "A_contents/g",
    .summary = "largest total acceleration of what hangs inside on a spring",
    .source = "effect moving_contents: what its spring and damper give to its mass",
    .wants = Wants::contents,
    .by_default = false,
    .default_capacities = {0.25, 0.5, 1, 2},
    .value = [](const Input& in) { return in.response.peak_contents_acceleration_mps2 / standard_gravity_mps2; },
}};

}  // namespace freestand::edp
