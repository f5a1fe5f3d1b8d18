// Compiled once per instruction set, as pack/kernels.cpp.
#include "dynamics/pack/law_kernels.hpp"
#include "dynamics/pack/law_march.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

const LawMarch pulse_marches[2][2] = {{law_march<OnPulses, false, false>, law_march<OnPulses, false, true>},
                                      {law_march<OnPulses, true, false>, law_march<OnPulses, true, true>}};

}  // namespace freestand::dynamics::FREESTAND_ISA
