// What freestand has written into a folder, a hash and a name a line, in a file of its own there. So a table that was changed
// since is known from one that may be replaced, and the results of an earlier run from files of the user.
//
// Of each file the hash of what is there stands beside that of what is about to be written: a run that is killed between the
// two leaves no file that it does not know again. Files that hold their own signature (own_files.hpp), and HDF5, stand in no line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace freestand::io {

inline constexpr const char* written_name = "freestand.files";

std::string hash_text(std::string_view content);

enum class Written { unknown, unchanged, changed };

// As the list in the file's folder has it; unknown: it does not name it.
Written written(const std::filesystem::path& file);

// The names in the folder's list.
std::vector<std::string> written_names(const std::filesystem::path& folder);

// Writes a result, listed (durable_file.hpp). One process at a time.
void write_result(const std::filesystem::path& file, std::string_view text);

}  // namespace freestand::io
