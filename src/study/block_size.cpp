#include "study/block_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <freestand/error.hpp>
#include <sstream>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "parallel/finished_blocks.hpp"
#include "parallel/progress.hpp"
#include "parallel/run_files.hpp"
#include "study/evaluator.hpp"
#include "study/run_folder.hpp"
#include "study/sample_counts.hpp"
#include "study/sweep.hpp"

namespace freestand::study {
namespace {

// Whoever is asked to stop gives up what takes longer than some seconds (run_folder.hpp): a block should not.
std::int64_t size_by_time(const Study& study, const Evaluator& evaluator, double block_s) {
  constexpr std::int64_t least = 8;
  using Clock = std::chrono::steady_clock;
  const auto samples = static_cast<std::int64_t>(study.samples);
  auto size = static_cast<std::int64_t>(study.block_size);
  const std::int64_t most = std::min(size, samples);
  std::vector<double> rows;
  const auto start = Clock::now();
  std::chrono::duration<double> took{0};
  std::int64_t done = 0;
  while (done < most && took.count() < block_s / 20) {
    const std::int64_t more = std::min(std::max(least, done), most - done);
    evaluator.append(static_cast<std::uint64_t>(done), static_cast<std::size_t>(more), rows);
    done += more;
    took = Clock::now() - start;
  }
  const double each_s = took.count() / static_cast<double>(done);
  const auto block_takes_s = [&] { return each_s * static_cast<double>(size); };
  while (size % 2 == 0 && size / 2 >= least && few_enough_blocks(study, size / 2) && block_takes_s() > block_s)
    size /= 2;
  if (block_takes_s() > patience_s && samples > size)
    parallel::tell(
        fmt::format("doubtful: a block of {} samples takes some {:.2g} s, and no smaller one is made: as much of its "
                    "time a rank may lose at "
                    "a request to stop; ask for limits of many times that\n",
                    size, block_takes_s()));
  return size;
}

std::string size_text(const std::string& fingerprint, std::int64_t size) {
  return fmt::format("{}\n{}\nend\n", fingerprint, size);
}

struct KeptSize {
  std::int64_t size = 0;  // 0: none is told, or it is of another study
  bool damaged = false;   // every copy that is there
};

// The size that earlier runs took. Kept twice, since finished blocks are worth nothing without it.
KeptSize kept_size(const std::vector<std::filesystem::path>& copies, const std::string& fingerprint) {
  std::size_t damaged = 0, there = 0;
  for (const std::filesystem::path& file : copies) {
    if (!is_there(file)) continue;
    const std::string text = read_whole(file);
    std::istringstream words(text);
    std::string whose;
    std::int64_t size = 0;
    words >> whose >> size;
    const bool sound = size > 0 && size_text(whose, size) == text;
    if (sound && whose == fingerprint) return {.size = size};
    damaged += !sound;
    ++there;
  }
  return {.damaged = there > 0 && damaged == there};
}

// On the root.
std::int64_t decided_size(const Study& study, const Evaluator& evaluator, const std::filesystem::path& folder,
                          double block_s) {
  const std::filesystem::path blocks = blocks_path(folder);
  const std::vector<std::filesystem::path> copies = {parallel::run_file(blocks, 0, 0, "size"),
                                                     parallel::run_file(blocks, 0, 1, "size")};
  const std::string fingerprint = samples_fingerprint(study) + evaluator.motions().fingerprint();
  auto [size, damaged] = kept_size(copies, fingerprint);
  if (size == 0 && parallel::count_finished_blocks(blocks) > 0) {
    if (damaged)
      throw Error(
          fmt::format("{} cannot be gone on with (how many samples its blocks hold is not known any more): give "
                      "--overwrite to begin anew",
                      blocks.string()));
    return static_cast<std::int64_t>(study.block_size);  // of another study, which is refused
  }
  if (size == 0) size = size_by_time(study, evaluator, block_s);
  const std::string text = size_text(fingerprint, size);
  for (const std::filesystem::path& file : copies)
    if (!is_there(file) || read_whole(file) != text) write_durably(file, text);
  return size;
}

}  // namespace

bool few_enough_blocks(const Study& study, std::int64_t size) {
  const auto samples = static_cast<std::int64_t>(study.samples);
  return samples / size <= most_blocks && kept_samples(study, samples) / size <= most_kept_blocks;
}

std::int64_t default_block_size(std::int64_t samples) {
  return static_cast<std::int64_t>(
      std::bit_floor(static_cast<std::uint64_t>(std::clamp<std::int64_t>(samples / 1000, 256, 8192))));
}

std::int64_t samples_in_a_block(const parallel::Communicator& world, const Study& study, const Evaluator& evaluator,
                                const std::filesystem::path& folder, double block_s) {
  parallel::Words size{0};
  world.on_root([&] { size[0] = decided_size(study, evaluator, folder, block_s); });
  return world.broadcast(size)[0];
}

}  // namespace freestand::study
