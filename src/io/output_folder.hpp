// The folder that results go to.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace freestand::io {

// Where a sweep keeps its finished blocks, inside the output folder.
inline constexpr const char* blocks_name = "blocks";

// Where a run notes how much was finished when it began.
inline constexpr const char* begun_name = "freestand.begun";

enum class Existing {
  refuse,     // a folder with something in it is an Error
  overwrite,  // what freestand wrote into it, by any verb, is removed first; other files are left
  resume      // everything stays
};

// As the options --overwrite and --resume say.
constexpr Existing existing(bool overwrite, bool resume = false) {
  return resume ? Existing::resume : overwrite ? Existing::overwrite : Existing::refuse;
}

// Of a command.
struct CommandFiles {
  std::vector<std::string> writes = {};           // names in the folder, beside the usual results
  std::vector<std::filesystem::path> reads = {};  // never removed: if they are written anew they stay until then
};

// Makes the folder and its parents. Throws Error (Exit::usage): not empty (but for a lock) and `refuse`, not a folder, no
// write permission, a file in it would be replaced that freestand did not write, or one removed that was changed since
// (own_files.hpp), or that the command reads. One rank does it for all.
void make_output_folder(const std::filesystem::path& folder, Existing, const CommandFiles& = {});

// The same, and checks that files can be written there, before long work starts: a full disk is Exit::cure. With
// `overwrite` the results in it are removed.
void prepare_output_folder(const std::filesystem::path& folder, Existing, const CommandFiles& = {});

// Both, of who holds no lock of the folder: refused while another job does (folder_lock.hpp).
void take_output_folder(const std::filesystem::path& folder, Existing, const CommandFiles& = {});

// Text file, whole or not there (durable_file.hpp).
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace freestand::io
