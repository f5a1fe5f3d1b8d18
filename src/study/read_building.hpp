// A building of a study: keys building and storey of records, or a file of its own.
#pragma once

#include <filesystem>
#include <string>

#include "study/section.hpp"

namespace freestand::study {

// building: a mapping, or the path of a file (from `folder`) that holds one; storey: the floors above the ground on which the
// equipment stands.
void read_building(Section& section, MotionSource& source, const std::filesystem::path& folder, Files look);

// The building of a file. Throws Error (Exit::usage) with all its problems.
BuildingPart read_building_file(const std::filesystem::path& file);

// As a mapping that reads back to the same building.
std::string building_text(const BuildingPart&);

}  // namespace freestand::study
