// Handing out blocks of samples to ranks, on two levels: nodes take ranges of blocks from a counter of all, their ranks share
// what their node has taken.
//
// The counter lies in a window of rank 0 and is raised by MPI_Fetch_and_op; what a node has taken lies in its memory. On one node the
// window is shared memory: a rank takes blocks without rank 0 taking part. Between nodes without remote atomics, rank 0
// serves the others each time it calls the beat; so blocks call it between samples. 10^4 ranks on a hundred nodes ask 8,600 times
// for 1.2 million blocks.
#pragma once

#include <cstdint>
#include <functional>

#include "parallel/block_list.hpp"
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

// Who takes blocks: nodes, and the ranks on all of them.
struct Takers {
  std::int64_t nodes = 1, ranks = 1;

  // So many blocks a node takes at most at a time: one for each of its ranks, or more where the counter would be asked too often.
  std::int64_t most() const;

  // Does a node ask for its next range when so many blocks are left of the last one? When fewer than half of its ranks will find one: a rank
  // alone would wait for the answer anyway.
  bool asks_ahead(std::int64_t left) const;
};

// Which of `total` blocks a node takes at the ticket-th raise of the counter; none beyond the last. In rounds: in each every node takes an
// equal part of half of what is left, in the last ones single blocks (factoring: S. F. Hummel, E. Schonberg and L. E. Flynn,
// Communications of the ACM 35, 1992); but no more than Takers::most(), since blocks may take much longer than others, and nodes too.
struct BlockRange {
  std::int64_t first = 0, end = 0;
  bool empty() const { return first >= end; }
};
BlockRange blocks_of_ticket(std::int64_t ticket, std::int64_t total, const Takers&);

// Calls compute(block, beat) once for each block of `todo` (the same list on every rank), each on one rank, whichever
// is free, about in the order of the list (with one rank, just so). Returns true when all blocks are done; false when a stop was requested on any rank
// (stop.hpp): open blocks are then finished and no more are taken. The same answer on every rank. Collective.
// `progress`, on rank 0, is shown what is done.
bool for_each_block(const Communicator&, const BlockList& todo, const BlockFunction& compute,
                    Progress* progress = nullptr);

}  // namespace freestand::parallel
