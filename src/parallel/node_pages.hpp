// Memory that the ranks of one node share. Where they cannot, each rank has its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "parallel/communicator.hpp"

namespace freestand::parallel {

struct NodePages {
  std::shared_ptr<std::byte> first;  // aligned to a page; zeros, until somebody writes
  std::int64_t node = 0;             // the lowest rank that sees it
  bool refused = false;              // this node has other ranks, and no room in /dev/shm to share
};

// `begin` is done to the memory by the lowest rank that sees it, before others do. Throws std::bad_alloc where a rank gets
// no memory of its own. Collective.
NodePages node_pages(const Communicator&, std::size_t bytes, const std::function<void(std::byte*)>& begin);

}  // namespace freestand::parallel
