// dataset.yaml, format freestand-measurements/1, and the files that it names.
#pragma once

#include <filesystem>

#include "measurement/dataset.hpp"

namespace freestand::study {

// Throws Error (Exit::data) with every problem of the file, or of the first test that cannot be read.
measurement::Dataset read_measurements(const std::filesystem::path& file);

}  // namespace freestand::study
