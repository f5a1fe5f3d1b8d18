// The ranks that share a node with this one.
#pragma once

#include "parallel/communicator.hpp"
#include "parallel/mpi.hpp"

namespace freestand::parallel {

class NodeRanks {
 public:
  // Collective, as its end.
  explicit NodeRanks(const Communicator& world) {
    if (world.size() == 1) return;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, world.rank(), MPI_INFO_NULL, &among);
    MPI_Comm_rank(among, &rank);
    MPI_Comm_size(among, &size);
  }
  ~NodeRanks() {
    if (among != MPI_COMM_NULL) MPI_Comm_free(&among);
  }
  NodeRanks(const NodeRanks&) = delete;
  NodeRanks& operator=(const NodeRanks&) = delete;

  MPI_Comm among = MPI_COMM_NULL;  // of them alone; none where there is one rank in all
  int rank = 0, size = 1;
};

}  // namespace freestand::parallel
