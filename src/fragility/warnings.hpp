// What the reader of a result must know, in plain sentences.
#pragma once

#include <string>
#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

std::vector<std::string> warnings(const Tally& tally, const Result& result);

// Which of them says that the motions are few, and so of all that follows from the result; "" where none does.
std::string told_of_motions(const Result& result);

}  // namespace freestand::fragility
