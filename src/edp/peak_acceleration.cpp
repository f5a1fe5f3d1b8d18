#include "base/units.hpp"
#include "edp/edp.hpp"

namespace freestand::edp {

const Register peak_acceleration{{
    .name = "peak_acceleration_g",
    .unit = "g",
    .symbol = "PEA",
    .summary = "largest total acceleration of the centre of mass, vector sum, of both horizontal directions where the "
               "floor moves in both; "
               "impacts left out, and beside a wall what lasts less than 1.5e-3/p before or after one; in the air it "
               "is 1 g, however "
               "low the block is thrown by a wall",
    .source = "[KM05 ch. 9]",
    .default_capacities = {0.25, 0.5, 1, 2},
    .value = [](const Input& in) { return in.response.peak_acceleration_mps2 / standard_gravity_mps2; },
}};

}  // namespace freestand::edp
