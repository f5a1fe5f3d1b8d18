#include "edp/edp.hpp"

namespace freestand::edp {

const Register delta{{
    .name = "delta",
    .unit = "1",
    .symbol = "Δ",
    .summary = "peak slip over the size of the pulse, U w_p^2/PTA, PTA of the first horizontal direction",
    .source = "[KM05 5.7]",
    .still = 1e-3,
    .default_capacities = {0.5, 1, 2, 3},
    .value =
        [](const Input& in) {
          return in.response.peak_slip_m * in.pulse_frequency_radps * in.pulse_frequency_radps / in.pta_mps2;
        },
}};

}  // namespace freestand::edp
