// What lies in a folder, and taking it away. Throws what file_error() makes.
#pragma once

#include <filesystem>
#include <vector>

namespace freestand {

// In no order; nothing where there is no such folder.
std::vector<std::filesystem::path> paths_in(const std::filesystem::path& folder);

// With those above it; no error where it is there.
void make_folder(const std::filesystem::path& folder);

// No error where it is not there.
void remove_file(const std::filesystem::path& path);

// Removes what programs have left that died while they wrote a file aside (durable_file.hpp).
void remove_asides(const std::filesystem::path& folder);

}  // namespace freestand
