// Files in the folder of unfinished work: one a run and node, such as run-0001.node-000000.log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace freestand::parallel {

struct RunFile {
  std::int64_t run = 0, node = 0;
  std::filesystem::path path;
};

// extension: "log", say.
std::filesystem::path run_file(const std::filesystem::path& folder, std::int64_t run, std::int64_t node,
                               const std::string& extension);
std::vector<RunFile> run_files(const std::filesystem::path& folder, const std::string& extension);

// Those of runs before this one, on any node; without it of all. Throws what file_error() makes.
void remove_run_files(const std::filesystem::path& folder, const std::string& extension,
                      std::int64_t before_run = std::numeric_limits<std::int64_t>::max());

// FNV-1a, for checksums.
std::uint64_t fnv1a(std::span<const std::byte> bytes);

}  // namespace freestand::parallel
