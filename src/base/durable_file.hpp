// Files that are either whole or not there: written aside, synced, renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <freestand/error.hpp>
#include <span>
#include <string>
#include <string_view>

namespace freestand {

// What went wrong with `path`, from errno, as "cannot ACTION PATH (why): what to do". A full disk, a quota or a file
// size limit, a file system that is read-only and a device that fails are Exit::cure: what was finished is kept, but going
// on before they are cured would fail again. A missing right or folder is Exit::usage. What may go away by itself, a call that
// was interrupted or a file handle that a server no longer knows, is Exit::resumable.
Error file_error(const std::string& action, const std::filesystem::path& path, int error_number);

// PATH with ".HOST.PID.part" behind its name and a dot before it: no other process of the run writes there.
std::filesystem::path aside_name(const std::filesystem::path& path);
bool is_aside_name(const std::filesystem::path& path);

// Writes the pieces one behind the other into aside_name(path), syncs, renames to `path` (replacing it) and syncs the
// folder. Nothing is left behind on failure. Throws what file_error() makes.
void write_durably(const std::filesystem::path& path, std::span<const std::span<const std::byte>> pieces);
void write_durably(const std::filesystem::path& path, std::string_view text);

// Syncs and renames a file that someone else has written, and syncs the folder.
void publish_durably(const std::filesystem::path& aside, const std::filesystem::path& path);

// Whole content of a file; Exit::data if it cannot be read.
std::string read_whole(const std::filesystem::path& path);

}  // namespace freestand
