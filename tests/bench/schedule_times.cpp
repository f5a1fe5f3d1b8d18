// What tests/parallel/schedule_simulation_test.cpp takes from a machine: how long a raise of the counter of blocks, what a node shares, and a
// new file take. On one node the counter lies in shared memory; by messages, as between nodes without remote atomics:
//   mpirun -n 2 --mca osc pt2pt --mca pml ob1 --mca btl tcp,self build/release/schedule_times DIR
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <vector>

#include "base/durable_file.hpp"
#include "base/open_file.hpp"
#include "parallel/communicator.hpp"
#include "parallel/mpi.hpp"
#include "parallel/node_memory.hpp"
#include "parallel/root_counters.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;

// Of one call, the median of seven times so many [s].
double seconds(int calls, const std::function<void(int)>& call) {
  std::vector<double> times;
  for (int repeat = 0; repeat < 7; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) call(repeat * calls + i);
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls);
  }
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  return times[3];
}

// The root answers, and asks too where `together`; what a raise takes the others.
double raise_seconds(const Communicator& world, RootCounters& counter, bool together) {
  world.barrier();
  double took = 0;
  if (!world.is_root() || together) took = seconds(2000, [&](int) { counter.fetch_add(0, 1); });
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Bcast(&took, 1, MPI_DOUBLE, world.size() - 1, MPI_COMM_WORLD);
  return took;
}

void measure(const Communicator& world, const fs::path& folder) {
  if (world.size() > 1) {
    RootCounters counter(world, 1);
    const double alone = raise_seconds(world, counter, false), together = raise_seconds(world, counter, true);
    world.on_root([&] {
      fmt::print("a raise of the counter: {:.2f} us where one rank asks, {:.2f} us where {} ask\n", 1e6 * alone,
                 1e6 * together, world.size());
    });
  }
  NodeMemory memory(world, 2);
  const double taking = seconds(100'000, [&](int) {
    const NodeMemory::Lock lock(memory);
    ++memory.numbers()[0];
  });
  world.on_root([&] {
    const std::vector<std::byte> page(4096);
    const auto path = [&](int i) { return folder / fmt::format("log-{}", i); };
    const double making = seconds(100, [&](int i) {
      OpenFile file(path(i), O_WRONLY | O_CREAT);
      if (!file.write(page, 0) || !file.close()) throw file_error("write", path(i), errno);
    });
    const double durable = seconds(20, [&](int i) { write_durably(path(i), "counts"); });
    for (int i = 0; i < 700; ++i) fs::remove(path(i));
    fmt::print(
        "taking what the node has: {:.3f} us; a new file: {:.3f} ms; written aside, synced, renamed: {:.2f} ms\n",
        1e6 * taking, 1e3 * making, 1e3 * durable);
  });
}

}  // namespace
}  // namespace freestand::parallel

int main(int argc, char** argv) {
  const freestand::parallel::Session session(&argc, &argv);
  if (argc != 2) return 2;
  freestand::parallel::measure(session.world(), argv[1]);
}
