// Ends in the way its first argument says; run by ending.sh, which looks at exit codes and what is printed.
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "parallel/communicator.hpp"
#include "parallel/schedule.hpp"
#include "parallel/stop.hpp"

using namespace freestand;
using namespace freestand::parallel;

namespace {

int sweep(const Communicator& world) {
  const std::vector<std::int64_t> todo(100000, 0);
  std::printf("ready\n");
  std::fflush(stdout);
  const bool complete = for_each_block(world, todo, [](std::int64_t, const Beat& beat) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    beat();
    return Counts{};
  });
  return complete ? 0 : static_cast<int>(Exit::resumable);
}

int run(const Communicator& world, const std::string& what) {
  const bool last = world.rank() == world.size() - 1;
  if (what == "one" && last) throw Error("trouble on one rank (test): none", Exit::data);
  if (what == "all") throw Error("trouble on every rank (test): none", Exit::data);
  if (what == "shared") world.on_root([] { throw Error("trouble on the root (test): none", Exit::usage); });
  if (what == "block") {
    for_each_block(world, {0, 1, 2, 3, 4, 5, 6, 7}, [&](std::int64_t block, const Beat&) -> Counts {
      if (block == 5) throw Error("trouble in a block (test): none", Exit::resumable);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return {};
    });
  }
  if (what == "sweep") return sweep(world);
  world.barrier();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const StopOnSignal stop_on_signal;
  const Session session(&argc, &argv);
  try {
    return run(session.world(), argc > 1 ? argv[1] : "");
  } catch (const Error& error) {
    return end_run(session.world(), error);
  }
}
