// Which files freestand wrote: a file of anyone else is never replaced.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace freestand::io {

// The text behind a first line, a comment, that holds the text's hash. For files that are made to be read and edited: with
// any change they are the user's.
std::string signed_text(std::string_view text);

// Did freestand write the file, as it is? As the folder's list has it (written_files.hpp); of what is not listed, as far as the
// content tells. HDF5 and JSON: their format is one of freestand's; CSV: the header has the columns of a result, or as any
// other text: its signature holds; HTML: the page names its maker.
bool is_own(const std::filesystem::path&);

// Did freestand write it, and someone else change it since? By the list, or a signature that does not hold any more.
bool was_changed(const std::filesystem::path&);

// Throws Error (Exit::usage) that names those of `names` in the folder that freestand did not write.
void refuse_others(const std::filesystem::path& folder, const std::vector<std::string>& names);

}  // namespace freestand::io
