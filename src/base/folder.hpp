// What lies in a folder, and taking it away. Throws what file_error() makes.
#pragma once

#include <filesystem>
#include <freestand/error.hpp>
#include <fstream>
#include <vector>

namespace freestand {

// What lies at a path: nothing where it cannot be one (a name that is too long).
bool is_there(const std::filesystem::path&);
bool is_file(const std::filesystem::path&);
bool is_folder(const std::filesystem::path&);

// Throws Error with that exit code: it cannot be read, or is a folder.
std::ifstream open_to_read(const std::filesystem::path& file, Exit);

// In no order; nothing where there is no such folder.
std::vector<std::filesystem::path> paths_in(const std::filesystem::path& folder);

// With those above it; no error where it is there.
void make_folder(const std::filesystem::path& folder);

// No error where it is not there.
void remove_file(const std::filesystem::path& path);

// Removes what programs have left that died while they wrote a file aside (durable_file.hpp).
void remove_asides(const std::filesystem::path& folder);

}  // namespace freestand
