// The steps of slips in the plane (pack/plane_march.hpp): [elliptic friction][the floor shakes vertically].
#pragma once

#include "dynamics/plane_march.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

extern const PlaneMarch plane_marches[2][2];

}  // namespace freestand::dynamics::FREESTAND_ISA
