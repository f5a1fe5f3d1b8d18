// Steps of samples that slide in the plane, a pack of them at once (plane_rows.hpp).
#pragma once

namespace freestand::dynamics {

struct PlaneRows;

// Steps of all lanes while all of them are regular. Bit l: the next one of lane l is not, or its motion is over.
using PlaneMarch = unsigned (*)(PlaneRows& rows);

}  // namespace freestand::dynamics
