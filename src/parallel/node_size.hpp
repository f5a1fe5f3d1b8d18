// How much memory the ranks of a node have among them.
#pragma once

#include <filesystem>

#include "parallel/communicator.hpp"

namespace freestand::parallel {

struct NodeSize {
  int ranks = 1;            // that share the node
  double memory_bytes = 0;  // of all of them together [B]
};

// The node with the least memory for each rank, on the root; on the other ranks their own node. Collective.
NodeSize narrowest_node(const Communicator&);

// What this process may take: the memory of the machine or, where that is less, of its control group or of one above it, as a batch
// system or a container sets it (memory.max of version 2, memory.limit_in_bytes of version 1) [B]. Files are looked for below `root`.
double memory_for_this_process(const std::filesystem::path& root = "/");

}  // namespace freestand::parallel
