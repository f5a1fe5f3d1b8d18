// Slide-rock under vertical shaking, with steps that are short against the block's own time, and longer ones.
#pragma once

#include "dynamics/batch.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

void slide_rock_shaken(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined);
void slide_rock_shaken_coarse(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined);

}  // namespace freestand::dynamics::FREESTAND_ISA
