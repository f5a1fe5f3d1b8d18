#include "parallel/run_files.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

#include "base/durable_file.hpp"

namespace freestand::parallel {

namespace fs = std::filesystem;

fs::path run_file(const fs::path& folder, std::int64_t run, std::int64_t node, const std::string& extension) {
  return folder / fmt::format("run-{:04}.node-{:06}.{}", run, node, extension);
}

std::vector<RunFile> run_files(const fs::path& folder, const std::string& extension) {
  std::vector<RunFile> files;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    long long run = 0, node = 0;
    const std::string name = i->path().filename().string();
    if (std::sscanf(name.c_str(), "run-%lld.node-%lld.", &run, &node) == 2 &&
        i->path() == run_file(folder, run, node, extension))
      files.push_back({run, node, i->path()});
  }
  if (error && error != std::errc::no_such_file_or_directory) throw file_error("read", folder, error.value());
  return files;
}

void remove_run_files(const fs::path& folder, const std::string& extension) {
  std::error_code error;
  for (const RunFile& file : run_files(folder, extension))
    if (!fs::remove(file.path, error) && error) throw file_error("remove", file.path, error.value());
}

std::uint64_t fnv1a(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211ULL;
  return hash;
}

}  // namespace freestand::parallel
