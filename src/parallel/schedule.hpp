// Handing out blocks of samples to ranks.
//
// The counter of blocks handed out lies in a window of rank 0 and is raised by MPI_Fetch_and_op. On one node the window
// is shared memory: a rank takes blocks without rank 0 taking part. Between nodes without remote atomics, rank 0
// serves the others each time it calls the beat; so blocks call it between samples. Many ranks take many blocks at a time while
// many are left, and single ones at the end, so that 10^4 ranks ask for a million blocks a hundred thousand times.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/progress.hpp"

namespace freestand::parallel {

// To be called between the samples of a block; costs a few nanoseconds when there is nothing to do.
using Beat = std::function<void()>;

// So long at most between two beats of rank 0, as tests/parallel/schedule_simulation_test.cpp assumes.
inline constexpr double beat_s = 0.01;

// How many samples are computed between two beats, of which so many took so long: as many as that time holds, at least as many as fill the
// lanes of a processor again and again, and at most `most`.
std::int64_t samples_to_beat(std::int64_t samples, double seconds, std::int64_t most);

// Computes one block and stores it. What it counted goes into the progress report.
using BlockFunction = std::function<Counts(std::int64_t block, const Beat& beat)>;

// Which of `total` blocks are taken at the ticket-th raise of the counter; none beyond the last. In rounds: in each every rank takes an
// equal part of half of what is left, in the last ones single blocks (factoring: S. F. Hummel, E. Schonberg and L. E. Flynn,
// Communications of the ACM 35, 1992); but no more than keeps the counter from being asked too often, which with fewer than 128
// ranks is one: blocks may take much longer than others, and ranks too.
struct BlockRange {
  std::int64_t first = 0, end = 0;
  bool empty() const { return first >= end; }
};
BlockRange blocks_of_ticket(std::int64_t ticket, std::int64_t total, std::int64_t ranks);

// Calls compute(block, beat) once for each block of `todo` (the same list on every rank), each on one rank, whichever
// is free, about in the order of the list (with one rank, just so). Returns true when all blocks are done; false when a stop was requested on any rank
// (stop.hpp): open blocks are then finished and no more are taken. The same answer on every rank. Collective.
// `progress`, on rank 0, is shown what is done.
bool for_each_block(const Communicator&, const std::vector<std::int64_t>& todo, const BlockFunction& compute,
                    Progress* progress = nullptr);

}  // namespace freestand::parallel
