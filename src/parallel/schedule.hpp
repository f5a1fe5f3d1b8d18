// Handing out blocks of samples to ranks.
//
// The counter of blocks handed out lies in a window of rank 0 and is raised by MPI_Fetch_and_op. On one node the window
// is shared memory: a rank takes a block without rank 0 taking part. Between nodes without remote atomics, rank 0
// serves the others each time it calls the beat; so blocks call it between samples.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/progress.hpp"

namespace freestand::parallel {

// To be called between the samples of a block; costs a few nanoseconds when there is nothing to do.
using Beat = std::function<void()>;

// Computes one block and stores it. What it counted goes into the progress report.
using BlockFunction = std::function<Counts(std::int64_t block, const Beat& beat)>;

// Calls compute(block, beat) once for each block of `todo` (the same list on every rank), each on one rank, whichever
// is free, in the order of the list. Returns true when all blocks are done; false when a stop was requested on any rank
// (stop.hpp): open blocks are then finished and no more are taken. The same answer on every rank. Collective.
// `progress`, on rank 0, is shown what is done.
bool for_each_block(const Communicator&, const std::vector<std::int64_t>& todo, const BlockFunction& compute,
                    Progress* progress = nullptr);

}  // namespace freestand::parallel
