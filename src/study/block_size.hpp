// How many samples a block of a sweep holds: what a rank takes at a time, and what is lost where it is stopped within one.
#pragma once

#include <cstdint>
#include <filesystem>

#include "parallel/communicator.hpp"
#include "study/study.hpp"

namespace freestand::study {

class Evaluator;

// Into so many blocks at most a sweep is divided: each is a bit in the memory of a rank and in the file of a node, 4 MB in all, and one whose rows
// are kept some 40 bytes more in each rank, 170 MB.
inline constexpr std::int64_t most_blocks = std::int64_t{1} << 25, most_kept_blocks = std::int64_t{1} << 22;

// Blocks of `size` samples are no more than that.
bool few_enough_blocks(const Study&, std::int64_t size);

// Where the study gives none: 1/1000 of the samples, a power of two between 256 and 8192: enough blocks to share among ranks, and whole nets of
// the Sobol sequence.
std::int64_t default_block_size(std::int64_t samples);

// block_size of the study, halved while it is even and a block would take longer than block_s seconds, as some first samples tell that the root
// integrates. Not below 8, which go in packs, nor where that would make too many blocks: it is told where one then takes longer than a stop
// waits for. Earlier runs in the folder have decided it for good. The numbers of a study do not depend on it. Collective.
// Throws Error: a full disk is Exit::cure; blocks are finished, and it cannot be read how many samples they hold: Exit::usage.
std::int64_t samples_in_a_block(const parallel::Communicator&, const Study&, const Evaluator&,
                                const std::filesystem::path& folder, double block_s = 2);

}  // namespace freestand::study
