#include "parallel/run_files.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <system_error>

#include "base/durable_file.hpp"

namespace freestand::parallel {

namespace fs = std::filesystem;

namespace {

// None where there is no such folder.
std::vector<fs::path> paths_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) paths.push_back(i->path());
  if (error && error != std::errc::no_such_file_or_directory) throw file_error("read", folder, error.value());
  return paths;
}

void remove_file(const fs::path& path) {
  std::error_code error;
  if (!fs::remove(path, error) && error) throw file_error("remove", path, error.value());
}

}  // namespace

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

void remove_run_files(const fs::path& folder, const std::string& extension) {
  for (const RunFile& file : run_files(folder, extension)) remove_file(file.path);
}

void remove_asides(const fs::path& folder) {
  for (const fs::path& path : paths_in(folder))
    if (is_aside_name(path)) remove_file(path);
}

std::uint64_t fnv1a(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211ULL;
  return hash;
}

}  // namespace freestand::parallel
