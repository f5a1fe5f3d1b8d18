// The kernels of blocks on a floor that shakes vertically, compiled once per instruction set, and by themselves, so that
// those of steady gravity do not depend on them.
#include "dynamics/pack/shaken_kernels.hpp"

#include "dynamics/pack/slide_rock_pool.hpp"

namespace freestand::dynamics::FREESTAND_ISA {

void slide_rock_shaken(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  slide_rock_samples<6, 6, Coulomb, Shaken>(cases, count, responses, declined);
}

void slide_rock_shaken_coarse(const BatchCase* cases, std::size_t count, Response* responses, std::uint8_t* declined) {
  slide_rock_samples<8, 8, Coulomb, Shaken>(cases, count, responses, declined);
}

}  // namespace freestand::dynamics::FREESTAND_ISA
