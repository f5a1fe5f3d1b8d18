#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "io/folder_lock.hpp"
#include "io/own_files.hpp"
#include "io/written_files.hpp"
#include "parallel/finished_blocks.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

// The usual results: a file of this name that freestand did not write is no reason to leave one out.
constexpr const char* results[] = {"samples.h5",     "tally.h5",     "fragility.h5",   "bins.csv",
                                   "surface.csv",    "summary.json", "history.csv",    "comparison.json",
                                   "diagnosis.json", "report.html",  "reproduce.json", begun_name};
// Others, as far as they do not stand in the folder's list.
constexpr const char* other_results[] = {"ranking.csv",      "study.yaml",        "case.yaml", "fitted.yaml",
                                         "fitted_draws.csv", "proposed_law.yaml", "risk.csv",  "risk.json",
                                         "sensitivity.csv",  "sensitivity.json"};
constexpr const char *certificate = "certificate.json", *database = "database.h5", *figures_name = "figures";

bool is_used(const fs::path& folder) {
  const std::vector<fs::path> all = paths_in(folder);
  return std::any_of(all.begin(), all.end(), [](const fs::path& path) {
    return path.filename() != lock_name && path.filename() != written_name;
  });
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
  if (finished == 0 && !swept)
    return fmt::format(
        "{} is that of a run that has finished nothing (it was stopped, or is at work): --overwrite starts again",
        folder.string());
  const std::string thrown = finished == 0   ? "starts again"
                             : finished == 1 ? "throws 1 finished block away"
                                             : fmt::format("throws {} finished blocks away", finished);
  return fmt::format("{} holds an unfinished run (it was interrupted, or is at work): --resume goes on, --overwrite {}",
                     folder.string(), thrown);
}

// Exported files, as their certificate has them.
std::vector<fs::path> exported(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!is_own(folder / certificate)) return found;
  const auto json = nlohmann::json::parse(read_whole(folder / certificate), nullptr, false);
  if (!json.is_object() || !json.contains("files") || !json["files"].is_object()) return found;
  for (const auto& [name, entry] : json["files"].items()) {
    const fs::path file = folder / fs::path(name).filename();
    std::error_code ignored;
    if (entry.is_object() && fs::is_regular_file(file, ignored) &&
        entry.value("hash", "") == hash_text(read_whole(file)))
      found.push_back(file);
  }
  return found;
}

// Pictures of the results, as the list beside them has them.
std::vector<fs::path> drawn(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const std::string& name : written_names(folder / figures_name))
    if (written(folder / figures_name / name) == Written::unchanged) found.push_back(folder / figures_name / name);
  if (!found.empty()) found.push_back(folder / figures_name / written_name);
  return found;
}

// What freestand wrote here, the list last. Throws Error where one of these was changed since.
std::vector<fs::path> results_in(const fs::path& folder) {
  std::vector<std::string> names = written_names(folder), changed;
  names.insert(names.end(), std::begin(results), std::end(results));
  names.insert(names.end(), std::begin(other_results), std::end(other_results));
  std::vector<fs::path> found = exported(folder);
  for (fs::path& picture : drawn(folder)) found.push_back(std::move(picture));
  names.emplace_back(certificate);
  for (const std::string& name : names) {
    if (was_changed(folder / name)) changed.push_back((folder / name).string());
    if (is_own(folder / name)) found.push_back(folder / name);
  }
  found.push_back(folder / written_name);
  if (changed.empty()) return found;
  throw Error(fmt::format(
      "{} would be removed with the results that are replaced (changed since freestand wrote it, so that it is "
      "yours): name another folder, or move it away",
      fmt::join(changed, ", ")));
}

bool is_among(const fs::path& file, const std::vector<fs::path>& others) {
  std::error_code ignored;
  return std::any_of(others.begin(), others.end(),
                     [&](const fs::path& other) { return fs::equivalent(file, other, ignored); });
}

// Of the results in the folder, those to be removed. Throws Error where the command reads one.
std::vector<fs::path> doomed(const fs::path& folder, const CommandFiles& files) {
  std::vector<fs::path> found = results_in(folder);
  std::erase_if(found, [&](const fs::path& file) {
    if (!is_among(file, files.reads)) return false;
    if (std::find(files.writes.begin(), files.writes.end(), file.filename()) != files.writes.end()) return true;
    throw Error(fmt::format(
        "{} is read, and --overwrite would remove it with the results beside it: name another folder", file.string()));
  });
  return found;
}

}  // namespace

void make_output_folder(const fs::path& folder, Existing existing, const CommandFiles& files) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Error(fmt::format("{} cannot take results (it is a file): name a folder", folder.string()));
  make_folder(folder);
  if (existing == Existing::refuse && is_used(folder)) throw Error(used_text(folder));
  refuse_others(folder, files.writes);
  if (existing != Existing::overwrite) return;
  if (fs::exists(folder / database, error))
    throw Error(fmt::format(
        "{} holds a database of many entries, which no result of another kind replaces: name another folder",
        folder.string()));
  refuse_others(folder, {std::begin(results), std::end(results)});
  doomed(folder, files);
}

void prepare_output_folder(const fs::path& folder, Existing existing, const CommandFiles& files) {
  make_output_folder(folder, existing, files);
  const fs::path probe = folder / "write-test";
  write_durably(aside_name(probe), "freestand\n");
  remove_file(aside_name(probe));
  if (existing != Existing::overwrite) return;
  for (const fs::path& file : doomed(folder, files)) remove_file(file);
  std::error_code ignored;
  fs::remove(folder / figures_name, ignored);  // where nothing is left in it
  remove_asides(folder);
  parallel::remove_finished_blocks(folder / blocks_name);
}

void take_output_folder(const fs::path& folder, Existing existing, const CommandFiles& files) {
  make_output_folder(folder, existing, files);
  const FolderLock alone(folder);
  prepare_output_folder(folder, existing, files);
}

void write_text(const fs::path& path, std::string_view text) { write_durably(path, text); }

}  // namespace freestand::io
