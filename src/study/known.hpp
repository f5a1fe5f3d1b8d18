// The names that this program knows, from its registries.
#pragma once

#include "intensity/intensity.hpp"
#include "study/study.hpp"

namespace freestand::study {

// EDPs of src/edp and intensity measures of src/intensity.
Known registries();

KnownIntensity known_intensity(const intensity::Measure&);

}  // namespace freestand::study
