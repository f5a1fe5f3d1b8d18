// Compiled once per instruction set; everything in it has internal linkage but the one name that it gives out.
#include "dynamics/batch.hpp"
#include "dynamics/pack/bouc_wen.hpp"
#include "dynamics/pack/law_kernels.hpp"
#include "dynamics/pack/plane_kernels.hpp"
#include "dynamics/pack/pulled_kernels.hpp"
#include "dynamics/pack/rock.hpp"
#include "dynamics/pack/shaken_kernels.hpp"
#include "dynamics/pack/slide.hpp"
#include "dynamics/pack/slide_rock_pool.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

extern const BatchKernels kernels;
const BatchKernels kernels{FREESTAND_ISA_NAME,
                           slide_samples,
                           rock_samples<6>,
                           rock_samples<8>,
                           slide_rock_samples<6>,
                           slide_rock_samples<8>,
                           slide_rock_samples<6, 8, BySlip>,
                           slide_rock_samples<8, 8, BySlip>,
                           slide_rock_shaken,
                           slide_rock_shaken_coarse,
                           slide_rock_pulled,
                           slide_rock_pulled_coarse,
                           bouc_wen_samples,
                           law_marches,
                           pulse_marches,
                           plane_marches,
                           pack_lanes};

}  // namespace freestand::dynamics::FREESTAND_ISA
