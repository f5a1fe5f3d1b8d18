#include "parallel/schedule.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <utility>

#include "parallel/requests.hpp"
#include "parallel/stop.hpp"

namespace freestand::parallel {
namespace {

using Clock = std::chrono::steady_clock;

// Integers in a window of rank 0 that every rank can add to; with one rank, plain integers.
class SharedCounters {
 public:
  enum Slot : int { next, samples, overturned, failed, slots };

  explicit SharedCounters(const Communicator& world) {
    if (world.size() == 1) return;
    const MPI_Aint bytes = world.is_root() ? slots * static_cast<MPI_Aint>(sizeof(std::int64_t)) : 0;
    MPI_Win_allocate(bytes, sizeof(std::int64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &memory_, &window_);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
    if (world.is_root()) std::fill_n(memory_, static_cast<int>(slots), 0);
    MPI_Win_sync(window_);
    world.barrier();
    MPI_Win_sync(window_);
  }

  // While an exception flies the others do not come to free the window: main ends them all.
  ~SharedCounters() {
    if (window_ == MPI_WIN_NULL || std::uncaught_exceptions() > 0) return;
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  SharedCounters(const SharedCounters&) = delete;
  SharedCounters& operator=(const SharedCounters&) = delete;

  // The value before.
  std::int64_t fetch_add(Slot slot, std::int64_t amount) {
    if (window_ == MPI_WIN_NULL) return std::exchange(local_[slot], local_[slot] + amount);
    std::int64_t before = 0;
    MPI_Fetch_and_op(&amount, &before, MPI_INT64_T, 0, slot, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return before;
  }

  void add(const Counts& counts) {
    fetch_add(samples, counts.samples);
    if (counts.overturned) fetch_add(overturned, counts.overturned);
    if (counts.failed) fetch_add(failed, counts.failed);
  }

  Counts counts() { return {fetch_add(samples, 0), fetch_add(overturned, 0), fetch_add(failed, 0)}; }

  // Any call into MPI lets it answer the other ranks.
  void serve() const {
    if (window_ == MPI_WIN_NULL) return;
    int flag = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &flag, MPI_STATUS_IGNORE);
  }

 private:
  MPI_Win window_ = MPI_WIN_NULL;
  std::int64_t* memory_ = nullptr;
  std::array<std::int64_t, slots> local_{};
};

}  // namespace

bool for_each_block(const Communicator& world, const std::vector<std::int64_t>& todo, const BlockFunction& compute,
                    Progress* progress) {
  const auto total = static_cast<std::int64_t>(todo.size());
  SharedCounters counters(world);
  auto last = Clock::now();
  const auto look = [&] {
    counters.serve();
    if (progress && progress->due()) progress->show(counters.counts());
  };
  const Beat beat = [&] {
    if (!world.is_root() || Clock::now() - last < std::chrono::milliseconds(1)) return;
    look();
    last = Clock::now();
  };

  Words done{0};
  while (!stop_requested()) {
    const std::int64_t i = counters.fetch_add(SharedCounters::next, 1);
    if (i >= total) break;
    counters.add(compute(todo[static_cast<std::size_t>(i)], beat));
    ++done[0];
    beat();
  }
  if (stop_requested()) counters.fetch_add(SharedCounters::next, total);
  if (world.size() > 1)
    wait([](MPI_Request* request) { return MPI_Ibarrier(MPI_COMM_WORLD, request); },
         [&] {
           if (world.is_root()) look();
         });
  if (progress && world.is_root()) progress->finish(counters.counts());
  world.sum_in_place(done);
  return done[0] == total;
}

}  // namespace freestand::parallel
