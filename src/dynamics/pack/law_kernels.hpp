// The steps of samples under laws (pack/law_march.hpp), as pack/law_kernels.cpp and pack/pulse_kernels.cpp give them out: [turns][slips].
#pragma once

#include "dynamics/law_rows.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

extern const LawMarch law_marches[2][2], pulse_marches[2][2];

}  // namespace freestand::dynamics::FREESTAND_ISA
