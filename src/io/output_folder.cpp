#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <system_error>
#include <vector>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "io/folder_lock.hpp"
#include "io/own_files.hpp"
#include "parallel/finished_blocks.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* results[] = {"samples.h5",     "tally.h5",     "fragility.h5", "bins.csv",
                                   "surface.csv",    "summary.json", "history.csv",  "comparison.json",
                                   "diagnosis.json", "report.html",  "reproduce.json", begun_name};

void check(const std::error_code& error, const char* action, const fs::path& path) {
  if (error) throw file_error(action, path, error.value());
}

bool is_used(const fs::path& folder) {
  const std::vector<fs::path> all = paths_in(folder);
  return std::any_of(all.begin(), all.end(), [](const fs::path& path) { return path.filename() != lock_name; });
}

// What a folder that is used holds, and how to go on: an interrupted sweep is worth more than a wrong guess.
std::string used_text(const fs::path& folder) {
  std::error_code error;
  const bool swept = fs::exists(folder / "samples.h5", error);
  const std::int64_t finished = parallel::count_finished_blocks(folder / blocks_name);
  if (finished == 0 && !fs::exists(folder / begun_name, error))
    return fmt::format(
        "{} is not empty (results of another run would mix with this one's): name another folder, or "
        "add --overwrite{}",
        folder.string(), swept ? "; --resume adds what the same study has more" : "");
  const std::string thrown = finished == 0   ? "starts again"
                             : finished == 1 ? "throws 1 finished block away"
                                             : fmt::format("throws {} finished blocks away", finished);
  return fmt::format("{} holds an interrupted sweep (it is not empty): --resume goes on, --overwrite {}",
                     folder.string(), thrown);
}

void remove_results(const fs::path& folder) {
  for (const char* name : results) remove_file(folder / name);
  remove_asides(folder);
  parallel::remove_finished_blocks(folder / blocks_name);
}

}  // namespace

void make_output_folder(const fs::path& folder, Existing existing, const std::vector<std::string>& writes) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Error(fmt::format("{} cannot take results (it is a file): name a folder", folder.string()));
  fs::create_directories(folder, error);
  check(error, "make folder", folder);
  if (existing == Existing::refuse && is_used(folder)) throw Error(used_text(folder));
  refuse_others(folder, writes);
  if (existing == Existing::overwrite) refuse_others(folder, {std::begin(results), std::end(results)});
}

void prepare_output_folder(const fs::path& folder, Existing existing, const std::vector<std::string>& writes) {
  make_output_folder(folder, existing, writes);
  const fs::path probe = folder / "write-test";
  write_durably(aside_name(probe), "freestand\n");
  remove_file(aside_name(probe));
  if (existing == Existing::overwrite) remove_results(folder);
}

void take_output_folder(const fs::path& folder, Existing existing, const std::vector<std::string>& writes) {
  make_output_folder(folder, existing, writes);
  const FolderLock alone(folder);
  prepare_output_folder(folder, existing, writes);
}

void write_text(const fs::path& path, std::string_view text) { write_durably(path, text); }

}  // namespace freestand::io
