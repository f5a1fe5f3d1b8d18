// A number that the ranks of one node share, in memory of the node. Where they cannot, each rank has its own.
#pragma once

#include <cstdint>
#include <memory>

#include "parallel/communicator.hpp"

namespace freestand::parallel {

class NodeCounter {
 public:
  // Begins at 0. Collective.
  explicit NodeCounter(const Communicator&);
  ~NodeCounter();
  NodeCounter(NodeCounter&&) noexcept;
  NodeCounter& operator=(NodeCounter&&) noexcept;

  // The value before; no two ranks of the node get the same while amount is positive.
  std::int64_t fetch_add(std::int64_t amount);

  // The lowest rank on this node: another number for each number that is counted.
  std::int64_t node() const { return node_; }

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
  std::int64_t node_ = 0;
};

}  // namespace freestand::parallel
