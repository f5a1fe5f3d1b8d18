// Which numbers this program gives to a sample. Blocks carry it, and --resume refuses those of another: a sweep is of one
// kernel.
#pragma once

#include <cstdint>

namespace freestand::study {

// Hash of the rows of a fixed set of samples (tests/study/kernel_number_test.cpp), the same with any instruction set of the
// packs and on any number of ranks; only on machines without FMA does the mathematical library give other last bits. When
// draws, motions, the kernel or demands give other bits, that test fails and says what to write here. A change
// that it does not notice wants a sample in its set that does.
inline constexpr std::uint32_t kernel_number = 0x4ab88ae1;

}  // namespace freestand::study
