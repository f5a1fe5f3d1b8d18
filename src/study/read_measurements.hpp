// dataset.yaml, format freestand-measurements/1, and the files that it names.
#pragma once

#include <filesystem>

#include "measurement/data/dataset.hpp"
#include "study/section.hpp"

namespace freestand::study {

// Throws Error (Exit::data) with every problem of the file, or of the first test that cannot be read.
measurement::Dataset read_measurements(const std::filesystem::path& file);

// Its parts `specimen` (what it does not give is taken from the fallback), `noise` and `tolerance`.
measurement::Dimensions read_dimensions(Section&, const measurement::Dimensions& fallback);
measurement::Noise read_noise(Section&);
measurement::Tolerance read_tolerance(Section&);

}  // namespace freestand::study
