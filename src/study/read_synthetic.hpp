// Synthetic motions of a study: the key synthetic, or a file of its own.
#pragma once

#include <filesystem>
#include <string>

#include "study/section.hpp"

namespace freestand::study {

// synthetic: a mapping, or the path of a file (from `folder`) that holds one.
void read_synthetic(Section& section, MotionSource& source, const std::filesystem::path& folder, Files look);

// What only the whole study tells: sets of the same name, and realisations that cannot be made.
void check_synthetic(Section& file, const Study&);

// The set of a file. Throws Error (Exit::usage) with all its problems.
SyntheticPart read_synthetic_file(const std::filesystem::path& file);

// As a mapping that reads back to the same set.
std::string synthetic_text(const SyntheticPart&);

}  // namespace freestand::study
