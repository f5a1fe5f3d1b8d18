// Relative paths of a study: they start at the folder of its file, or where its key paths_from leads from there.
#pragma once

#include <filesystem>
#include <string>

#include "study/section.hpp"

namespace freestand::study {

// Reads paths_from. `file`: the path of the file that holds the section. Files::ignore: what it leads to need not be there.
std::filesystem::path read_paths_from(Section& section, const std::filesystem::path& file, Files look = Files::look);

// What paths_from must be in a file in folder `from` so that its paths start at folder `to`: relative where it can be;
// empty where they are the same.
std::string way_between(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace freestand::study
