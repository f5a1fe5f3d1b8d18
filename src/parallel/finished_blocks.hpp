// What lies in the folder of unfinished work, as a whole: the log of samples (block_log.hpp), the sums over them
// (block_sums.hpp), the rounds in which they are made (study/rounds.hpp), the size of blocks (study/block_size.hpp) and the entry of a
// catalogue that they are of (study/build_catalogue.cpp), of whatever study.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "base/folder.hpp"
#include "parallel/block_log.hpp"
#include "parallel/block_sums.hpp"
#include "parallel/run_files.hpp"

namespace freestand::parallel {

// A sweep that keeps its first samples has these in both.
inline std::int64_t count_finished_blocks(const std::filesystem::path& folder) {
  return std::max(count_blocks(folder), count_summed_blocks(folder));
}

// Removes all of it, and the folder if it is then empty.
inline void remove_finished_blocks(const std::filesystem::path& folder) {
  remove_run_files(folder, "log");
  remove_run_files(folder, "sums");
  remove_run_files(folder, "rounds");
  remove_run_files(folder, "size");
  remove_run_files(folder, "entry");
  remove_asides(folder);
  std::error_code error;
  if (std::filesystem::is_empty(folder, error)) std::filesystem::remove(folder, error);
}

}  // namespace freestand::parallel
