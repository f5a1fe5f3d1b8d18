// Whole numbers in memory of rank 0 that every rank can add to without its help; with one rank, plain ones.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/mpi.hpp"

namespace freestand::parallel {

class RootCounters {
 public:
  // All begin at 0. Collective, as is the end.
  RootCounters(const Communicator&, int count);
  ~RootCounters();
  RootCounters(const RootCounters&) = delete;
  RootCounters& operator=(const RootCounters&) = delete;

  // The value before.
  std::int64_t fetch_add(int counter, std::int64_t amount);

  // On rank 0, between nodes without remote atomics, the others are answered in calls into MPI alone: this is one.
  void serve() const;

 private:
  MPI_Win window_ = MPI_WIN_NULL;
  std::vector<std::int64_t> local_;
};

}  // namespace freestand::parallel
