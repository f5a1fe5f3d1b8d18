#include "parallel/root_counters.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace freestand::parallel {

RootCounters::RootCounters(const Communicator& world, int count) : local_(static_cast<std::size_t>(count)) {
  if (world.size() == 1) return;
  std::int64_t* memory = nullptr;
  const MPI_Aint bytes = world.is_root() ? count * static_cast<MPI_Aint>(sizeof(std::int64_t)) : 0;
  MPI_Win_allocate(bytes, sizeof(std::int64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &memory, &window_);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
  if (world.is_root()) std::fill_n(memory, count, 0);
  MPI_Win_sync(window_);
  world.barrier();
  MPI_Win_sync(window_);
}

// While an exception flies the others do not come to free the window: main ends them all.
RootCounters::~RootCounters() {
  if (window_ == MPI_WIN_NULL || std::uncaught_exceptions() > 0) return;
  MPI_Win_unlock_all(window_);
  MPI_Win_free(&window_);
}

std::int64_t RootCounters::fetch_add(int counter, std::int64_t amount) {
  if (window_ == MPI_WIN_NULL) {
    std::int64_t& value = local_[static_cast<std::size_t>(counter)];
    return std::exchange(value, value + amount);
  }
  std::int64_t before = 0;
  MPI_Fetch_and_op(&amount, &before, MPI_INT64_T, 0, counter, MPI_SUM, window_);
  MPI_Win_flush(0, window_);
  return before;
}

void RootCounters::serve() const {
  if (window_ == MPI_WIN_NULL) return;
  int flag = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &flag, MPI_STATUS_IGNORE);
}

}  // namespace freestand::parallel
