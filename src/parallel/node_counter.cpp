#include "parallel/node_counter.hpp"

#include <atomic>
#include <exception>
#include <utility>

#include "parallel/requests.hpp"

namespace freestand::parallel {

struct NodeCounter::Shared {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Win window = MPI_WIN_NULL;
  std::int64_t alone = 0;
  std::int64_t* value = &alone;

  // While an exception flies the others do not come to free the window: main ends them all.
  ~Shared() {
    if (window == MPI_WIN_NULL || std::uncaught_exceptions() > 0) return;
    MPI_Win_free(&window);
    MPI_Comm_free(&node);
  }
};

NodeCounter::NodeCounter(const Communicator& world) : shared_(std::make_unique<Shared>()) {
  if (world.size() == 1) return;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, world.rank(), MPI_INFO_NULL, &shared_->node);
  int rank = 0;
  MPI_Comm_rank(shared_->node, &rank);
  void* memory = nullptr;
  MPI_Win_allocate_shared(rank == 0 ? sizeof(std::int64_t) : 0, sizeof(std::int64_t), MPI_INFO_NULL, shared_->node,
                          &memory, &shared_->window);
  MPI_Aint bytes = 0;
  int unit = 0;
  MPI_Win_shared_query(shared_->window, 0, &bytes, &unit, &memory);
  shared_->value = static_cast<std::int64_t*>(memory);
  if (rank == 0) *shared_->value = 0;
  node_ = world.rank();
  wait([&](MPI_Request* request) { return MPI_Ibcast(&node_, 1, MPI_INT64_T, 0, shared_->node, request); });
}

NodeCounter::~NodeCounter() = default;
NodeCounter::NodeCounter(NodeCounter&&) noexcept = default;
NodeCounter& NodeCounter::operator=(NodeCounter&&) noexcept = default;

std::int64_t NodeCounter::fetch_add(std::int64_t amount) {
  return std::atomic_ref<std::int64_t>(*shared_->value).fetch_add(amount);
}

}  // namespace freestand::parallel
