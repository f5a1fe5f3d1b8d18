// Which numbers this program gives to a sample. Blocks carry it, and --resume refuses those of another: a sweep is of one
// kernel.
#pragma once

#include <cstdint>
#include <string>

#include "parallel/communicator.hpp"

namespace freestand::study {

// Hash of the rows of a fixed set of samples (tests/study/kernel_number_test.cpp), the same with any instruction set of the
// packs and on any number of ranks. When draws, motions, the kernel or demands give other bits, that test fails and says what to write here. A
// change that it does not notice wants a sample in its set that does.
inline constexpr std::uint32_t kernel_number = 0x03333f33;

// With the last bits of this machine's mathematical library, which are others on processors without FMA and in some of its versions.
std::uint32_t kernel_here();
std::string kernel_text();

// Throws Error (Exit::usage) where ranks run on machines whose numbers differ. Collective.
void refuse_mixed_machines(const parallel::Communicator&);

}  // namespace freestand::study
