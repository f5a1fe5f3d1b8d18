// Whole numbers that the ranks of one node share, in memory of the node. Where they cannot, each rank has its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "parallel/communicator.hpp"
#include "parallel/node_pages.hpp"

namespace freestand::parallel {

class NodeMemory {
 public:
  // All begin at 0. Collective.
  NodeMemory(const Communicator&, std::size_t numbers);

  // To be read and written by the rank that holds the lock.
  std::span<std::int64_t> numbers();

  // Held by one rank of the node at a time. Throws Error (Exit::resumable) if a rank has died while it held the lock, so
  // that nobody knows what the numbers are.
  class Lock {
   public:
    explicit Lock(NodeMemory&);
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

   private:
    NodeMemory& memory_;
  };

  // Adds to one of the numbers and gives its value before, without the lock: no two ranks of the node get the same while
  // amount is positive.
  std::int64_t fetch_add(std::size_t position, std::int64_t amount);

  // The lowest rank on this node: another number for each memory.
  std::int64_t node() const { return pages_.node; }

 private:
  NodePages pages_;
  std::size_t numbers_ = 0;
};

}  // namespace freestand::parallel
