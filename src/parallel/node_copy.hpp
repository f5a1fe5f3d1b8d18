// What the root has and every rank reads, once in the memory of each node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "parallel/communicator.hpp"

namespace freestand::parallel {

struct NodeCopy {
  std::shared_ptr<const std::byte>
      first;                    // aligned to a page; stays, also after MPI has ended, as long as somebody holds it
  std::int64_t own_copies = 0;  // ranks of the run that hold a copy of their own, because their node cannot share one
};

// size: the same on every rank. The root writes what it has to the place that `fill` is given; then it can be read, and
// whoever writes to it is stopped by a fault of the memory. Collective.
NodeCopy copy_to_nodes(const Communicator&, std::size_t size, const std::function<void(std::byte*)>& fill);

}  // namespace freestand::parallel
