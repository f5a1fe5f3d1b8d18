#include "intensity/intensity.hpp"

namespace freestand::intensity {

const Register pgd{{
    .name = "pgd_m",
    .unit = "m",
    .symbol = "PGD",
    .summary = "peak displacement of the floor, integrated from rest without baseline correction",
    .source = "max |u(t)|",
    .value = [](const Input& in) { return in.peaks().pgd_m; },
    .proportional = true,
}};

}  // namespace freestand::intensity
