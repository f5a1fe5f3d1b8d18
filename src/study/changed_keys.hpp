// In which keys the samples of two studies differ, as a user is told.
#pragma once

#include <string>

#include "study/study.hpp"

namespace freestand::study {

// Does a key change the samples? The name does not, nor the fragility block but for the intensity measure in their rows.
bool changes_samples(const std::string& key);

// "chain.slack_m was 0.05, is 0.07; and 2 more" of the keys that change the samples, or also what is counted of them; "" where
// none does.
enum class Changes { of_samples, of_counts };
std::string changes_told(const Study& now, const Study& before, Changes changes = Changes::of_samples);

}  // namespace freestand::study
