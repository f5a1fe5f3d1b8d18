// Compiled once per instruction set, as pack/kernels.cpp.
#include "dynamics/pack/plane_kernels.hpp"

#include "dynamics/pack/plane_march.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

const PlaneMarch plane_marches[2][2] = {{plane_march<false, false>, plane_march<false, true>},
                                        {plane_march<true, false>, plane_march<true, true>}};

}  // namespace freestand::dynamics::FREESTAND_ISA
