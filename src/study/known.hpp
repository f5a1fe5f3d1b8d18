// The names that this program knows, from its registries.
#pragma once

#include "study/study.hpp"

namespace freestand::study {

// EDPs of src/edp and intensity measures of src/intensity.
Known registries();

}  // namespace freestand::study
