#include "parallel/node_size.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "parallel/node_ranks.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;

// The least limit of a group and of those above it, whose folders end at `mount`. A container may see its own group there, and none
// of the folders that its name tells of.
double least_limit(const fs::path& mount, const std::string& group, const char* file) {
  double least = std::numeric_limits<double>::infinity();
  for (fs::path name = fs::path(group).relative_path();; name = name.parent_path()) {
    double limit = 0;
    if (std::ifstream(mount / name / file) >> limit) least = std::min(least, limit);  // "max" is no number
    if (name.empty()) return least;
  }
}

}  // namespace

double memory_for_this_process(const fs::path& root) {
  double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const fs::path mount = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // number:controllers:name
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',',
                      name = line.substr(second + 1);
    if (controllers == ",,")
      memory = std::min(memory, least_limit(mount, name, "memory.max"));
    else if (controllers.find(",memory,") != std::string::npos)
      memory = std::min(memory, least_limit(mount / "memory", name, "memory.limit_in_bytes"));
  }
  return memory;
}

NodeSize narrowest_node(const Communicator& world) {
  const NodeSize mine{NodeRanks(world).size, memory_for_this_process()};
  NodeSize narrowest = mine;
  for (const Words& words : world.gather({mine.ranks, static_cast<std::int64_t>(mine.memory_bytes)})) {
    const NodeSize one{static_cast<int>(words[0]), static_cast<double>(words[1])};
    if (one.memory_bytes / one.ranks < narrowest.memory_bytes / narrowest.ranks) narrowest = one;
  }
  return narrowest;
}

}  // namespace freestand::parallel
