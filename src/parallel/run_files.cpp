#include "parallel/run_files.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "base/folder.hpp"

namespace freestand::parallel {

namespace fs = std::filesystem;

fs::path run_file(const fs::path& folder, std::int64_t run, std::int64_t node, const std::string& extension) {
  return folder / fmt::format("run-{:04}.node-{:06}.{}", run, node, extension);
}

std::vector<RunFile> run_files(const fs::path& folder, const std::string& extension) {
  std::vector<RunFile> files;
  for (const fs::path& path : paths_in(folder)) {
    long long run = 0, node = 0;
    if (std::sscanf(path.filename().c_str(), "run-%lld.node-%lld.", &run, &node) == 2 &&
        path == run_file(folder, run, node, extension))
      files.push_back({run, node, path});
  }
  return files;
}

void remove_run_files(const fs::path& folder, const std::string& extension, std::int64_t before_run) {
  for (const RunFile& file : run_files(folder, extension))
    if (file.run < before_run) remove_file(file.path);
}

std::uint64_t fnv1a(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211ULL;
  return hash;
}

}  // namespace freestand::parallel
