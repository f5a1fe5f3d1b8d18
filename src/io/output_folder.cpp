#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>
#include <system_error>
#include <vector>

#include "base/durable_file.hpp"
#include "io/own_files.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* results[] = {"samples.h5",  "fragility.h5",    "bins.csv",       "surface.csv", "summary.json",
                                   "history.csv", "comparison.json", "diagnosis.json", "report.html"};

void check(const std::error_code& error, const char* action, const fs::path& path) {
  if (error) throw file_error(action, path, error.value());
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  check(error, "remove", path);
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) paths.push_back(i->path());
  check(error, "read folder", folder);
  return paths;
}

bool is_block(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("block-") && name.ends_with(".bin");
}

void remove_results(const fs::path& folder) {
  for (const char* name : results) remove_file(folder / name);
  for (const fs::path& path : entries(folder))
    if (is_aside_name(path)) remove_file(path);
  const fs::path blocks = folder / blocks_name;
  std::error_code error;
  if (!fs::is_directory(blocks, error)) return;
  for (const fs::path& path : entries(blocks))
    if (is_aside_name(path) || is_block(path)) remove_file(path);
  if (fs::is_empty(blocks, error)) remove_file(blocks);
}

}  // namespace

void prepare_output_folder(const fs::path& folder, Existing existing, const std::vector<std::string>& writes) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Error(fmt::format("{} cannot take results (it is a file): name a folder", folder.string()));
  fs::create_directories(folder, error);
  check(error, "make folder", folder);
  const bool empty = fs::is_empty(folder, error);
  check(error, "read folder", folder);
  if (!empty && existing == Existing::refuse)
    throw Error(
        fmt::format("{} is not empty (results of another run would mix with this one's): name another folder, or "
                    "add --overwrite",
                    folder.string()));
  refuse_others(folder, writes);
  if (existing == Existing::overwrite) refuse_others(folder, {std::begin(results), std::end(results)});
  const fs::path probe = folder / "write-test";
  write_durably(aside_name(probe), "freestand\n");
  remove_file(aside_name(probe));
  if (existing == Existing::overwrite) remove_results(folder);
}

void write_text(const fs::path& path, std::string_view text) { write_durably(path, text); }

}  // namespace freestand::io
