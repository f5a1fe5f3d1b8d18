// Compiled once per instruction set, as pack/kernels.cpp.
#include "dynamics/pack/law_kernels.hpp"

#include "dynamics/pack/law_march.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

const LawMarch law_marches[2][2] = {{law_march<OnRecords, false, false>, law_march<OnRecords, false, true>},
                                    {law_march<OnRecords, true, false>, law_march<OnRecords, true, true>}};

}  // namespace freestand::dynamics::FREESTAND_ISA
