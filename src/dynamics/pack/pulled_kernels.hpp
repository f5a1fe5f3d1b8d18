// Slide-rock with a spring and a drag along the floor, with steps that are short against the block's own time, and longer ones.
#pragma once

#include "dynamics/batch.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

void slide_rock_pulled(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined);
void slide_rock_pulled_coarse(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined);

}  // namespace freestand::dynamics::FREESTAND_ISA
