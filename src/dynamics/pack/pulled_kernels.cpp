// The kernels of blocks that a spring and a drag pull along the floor, compiled once per instruction set, and by itself, so that those without
// do not depend on it.
#include "dynamics/pack/pulled_kernels.hpp"

#include "dynamics/pack/slide_rock_pool.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

void slide_rock_pulled(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  slide_rock_samples<6, 6, Coulomb, Pulled>(cases, count, responses, declined);
}

void slide_rock_pulled_coarse(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  slide_rock_samples<8, 8, Coulomb, Pulled>(cases, count, responses, declined);
}

}  // namespace freestand::dynamics::FREESTAND_ISA
