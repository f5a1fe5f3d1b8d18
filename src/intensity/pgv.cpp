#include "intensity/intensity.hpp"

namespace freestand::intensity {

const Register pgv{{
    .name = "pgv_mps",
    .unit = "m/s",
    .symbol = "PGV",
    .summary = "peak velocity of the floor, integrated from rest without baseline correction",
    .source = "max |v(t)|",
    .value = [](const Input& in) { return in.peaks().pgv_mps; },
    .proportional = true,
}};

}  // namespace freestand::intensity
