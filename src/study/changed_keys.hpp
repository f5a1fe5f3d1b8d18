// In which keys the samples of two studies differ, as a user is told.
#pragma once

#include <string>

#include "study/study.hpp"

namespace freestand::study {

// Does a key change the samples? The name does not, nor the fragility block but for the intensity measure in their rows.
bool changes_samples(const std::string& key);

// "chain.slack_m was 0.05, is 0.07; and 2 more" of the keys that change the samples; "" where none does.
std::string changes_told(const Study& now, const Study& before);

}  // namespace freestand::study
